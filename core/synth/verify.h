#pragma once
/// Fresh points against a candidate solid: how well it agrees, and where it does not.
#include <functional>
#include <vector>

#include "core/csg/tree.h"
#include "core/sample/sample_table.h"
#include "core/synth/decompose/term.h"

namespace hewn {

/// Membership of a candidate solid.
using SolidTest = std::function<bool(const Vec3&)>;

/// Evaluates a decision list point by point. The pointees must outlive it.
class ListSolid {
 public:
  /// With `clip`, nothing outside the frame's box belongs to the solid.
  ListSolid(const DecisionList& list, const std::vector<Halfspace>& halfspaces, const Frame& frame,
            bool clip);
  bool contains(const Vec3& p) const;

 private:
  const DecisionList* list_;
  const std::vector<Halfspace>* halfspaces_;
  const Frame* frame_;
  bool clip_;
};

struct Verification {
  /// Share of the fresh uniform points, away from inexact surfaces, that are classified right.
  double agreement = 1;
  /// The same for the points along lines, which weigh features by their surface, not their volume.
  double line_agreement = 1;
  /// Whether a point far from the mesh is wrong: a piece that sticks out or is missing.
  bool has_stray = false;
  /// Points classified wrong, fit to join the sample table.
  std::vector<LabelledPoint> counterexamples;
};

struct VerifyOptions {
  int uniform_points = 40000;
  int near_points = 16000;
  int around_points = 12000;
  int points_per_literal = 40;  ///< on both sides of the list's own term boundaries
  int lines = 6000;             ///< through the tree, see `Candidate::tree`
  int lines_per_literal = 64;   ///< through what each may reach: few others meet a small feature
};

/// What is verified, in three forms of the same solid.
struct Candidate {
  const DecisionList& list;
  const SolidTest& contains;
  const Tree& tree;  ///< the list lowered, for lines through its surface
};

/// Compares the candidate with the labels on fresh points: uniform, near the mesh's surface, around
/// the box, on the boundaries of the list's own terms, and along random lines, some of them aimed
/// at each literal, on both sides of the tree's surface and midway between its crossings (both find
/// sheets, slots and plugs that are small in volume). `stream` selects the random numbers.
Verification verify_list(const SampleSpace& space, const Candidate& candidate,
                         const VerifyOptions& options, std::uint64_t stream, const RunContext& run);

/// The share of fresh uniform points that `solid` classifies as the labels do.
double measure_agreement(const SampleSpace& space, const SolidTest& solid, int points,
                         std::uint64_t stream, const RunContext& run);

}  // namespace hewn
