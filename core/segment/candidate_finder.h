#pragma once
/// One curved surface out of one seed facet: patches around it, fits, growth and judgement.
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "core/base/run_context.h"
#include "core/segment/facet_fit.h"
#include "core/segment/segment.h"

namespace hewn {

/// A surface with the facets that it explains.
struct Candidate {
  Surface surface;
  std::vector<int> facets;  ///< ascending
  double score = 0;         ///< the larger the better; 0: none was found
  double looseness = 0;     ///< corners' deviation against what the sagitta lets one tell
};

/// How coarsely a curved surface may be divided into facets. Angles in radians.
struct FacetSteps {
  double smooth_rad = 0;  ///< rims that turn by less join facets of one surface
  double growth_rad = 0;  ///< so do these once the surface is known
  /// How deep the middles of most facets, and of each, may lie, as shares of the radius.
  double sagitta_share = 0, sagitta_outlier = 0;
  /// The same in model units, of cylinders and of other surfaces.
  double max_cylinder_depth = kInfinity, max_depth = kInfinity;
  bool only_exact = false;        ///< corners lie on the surface, or sides touch it all alike
  double least_slack_rad = 0.06;  ///< of a facet's normal, from the surface's at its middle
  int least_sides = 4;            ///< of a cylinder
};

/// What growth works on. Everything outlives the finder.
struct GrowthInput {
  const Mesh& mesh;
  const FacetGraph& graph;
  const SurfaceTolerance& tolerance;
  const SegmentOptions& options;
  FacetSteps steps;
  const std::vector<int>& component_of;  ///< per facet: its smooth component, or -1
};

/// Has scratch memory: one for each worker. Reads `group_of_facet` (-1: free), which may change
/// between calls.
class CandidateFinder {
 public:
  CandidateFinder(const GrowthInput& input, const std::vector<int>& group_of_facet);

  /// Large enough to tell anything.
  bool is_seed(int facet) const;

  /// The best surface from patches around a free facet. Cost: O(patches x facets of the surface).
  Candidate best_from(int seed);

  /// Takes a cylinder instead of a cone or torus, or a sphere instead of a torus, when that
  /// explains the facets' corners as well: F-test of the parameters that it saves. Small pieces of
  /// a cylinder with inexact corners pass for tori of any size.
  void simplify(Surface& surface, const std::vector<int>& facets);

  /// Forgets `foreign_facets()`.
  void begin_component(int component);
  /// Facets of other components that took part in a surface since `begin_component`, because they
  /// were free. In no order.
  std::span<const int> foreign_facets() const { return foreign_; }

 private:
  struct Limits {
    double distance = 0;      // of corners
    double sagitta = 0;       // of facet centres
    double angle_rad = 0;     // of facet normals
    double least_cosine = 1;  // of `angle_rad`
  };

  int least_facets(SurfaceKind kind) const;
  bool is_free(int facet) const;
  void search(int seed, Candidate& best);
  std::vector<int> smoothest_neighborhood(int seed, int size);
  std::vector<int> neighborhood(int seed, int size);
  bool try_patch(const std::vector<int>& patch, Candidate& best);
  std::optional<Candidate> develop(Surface s, const std::vector<int>& patch);
  bool has_fine_facets(const Surface& s, const std::vector<int>& facets) const;
  double depth_about_axis(const Surface& s, int facet) const;
  bool are_sides_of_polygon(const Surface& s, const std::vector<int>& facets) const;
  bool is_ring_of_torus(const Surface& s, const std::vector<int>& facets) const;
  bool fit_core(Surface& s, std::vector<int>& core);
  bool refine_uncut(Surface& s, const std::vector<int>& facets, FitQuality& q);
  void allow_chords(const Surface& s, const std::vector<int>& facets, double sagitta,
                    Limits& limits) const;
  double widening(const Surface& cone, const std::vector<int>& facets) const;
  void refine_while_growing(Surface& s, const std::vector<int>& core, Limits limits,
                            std::vector<int>& facets);
  std::vector<int> grow(const Surface& s, const std::vector<int>& seeds, const Limits& limits);
  void take(int facet, std::vector<int>& queue);
  bool lies_on(const SurfaceField& s, int facet, double side, const Limits& limits) const;
  std::optional<Candidate> judge(Surface s, std::vector<int> facets);
  int distinct_normals(const std::vector<int>& facets) const;
  bool normals_agree(const Surface& s, const std::vector<int>& facets, bool is_exact);
  bool is_flat(const std::vector<int>& facets) const;

  const Mesh& mesh_;
  const FacetGraph& graph_;
  SurfaceTolerance tolerance_;
  const SegmentOptions& options_;
  const std::vector<int>& component_of_;
  const std::vector<int>& group_of_;
  FacetSteps steps_;
  FacetFitter fitter_;
  std::vector<std::uint32_t> stamp_of_, foreign_stamp_of_;
  std::uint32_t stamp_ = 0, foreign_stamp_ = 0;
  std::vector<int> foreign_;
  int component_ = -1;
};

}  // namespace hewn
