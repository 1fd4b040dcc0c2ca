#pragma once
/// How well a tree over solids fits a surface: distances and normals at points of it (Fayolle and
/// Pasko 2016).
#include <memory>
#include <span>
#include <vector>

#include "core/compute/compute.h"
#include "core/compute/surface_scores.h"
#include "core/fit/bounded.h"
#include "core/synth/evolve/genome.h"

namespace hewn {

/// A point of the wanted surface with the outward unit normal.
struct SurfaceSample {
  Vec3 position = Vec3::Zero();
  Vec3 normal = Vec3::UnitZ();
};

/// How far off still counts: the score of a point falls to 1 / e at these.
struct SurfaceReach {
  double distance = 1;   ///< model units
  double angle_rad = 1;  ///< between the normals
};

/// Distances and normals of every primitive at every sample, computed once; trees then only choose
/// among them, a whole generation at a time, on the device that suits. For one thread.
class SurfaceFitness {
 public:
  /// Scores on `compute_of(run)`. Cost: O(samples x primitives) distances, shared by all workers.
  SurfaceFitness(std::span<const BoundedPrimitive> primitives,
                 std::span<const SurfaceSample> samples, const SurfaceReach& reach,
                 const RunContext& run);

  int primitives() const { return static_cast<int>(scores_.primitives()); }
  std::size_t samples() const { return scores_.samples(); }

  /// What trees are scored with: tokens are indices of primitives. A tree's total is the sum over
  /// the samples of exp(-(distance / reach)^2) and the same of the angle, in shares of
  /// `perfect_total`; the same on every device.
  SurfaceScores& scores() { return scores_; }
  /// Of a surface that passes through all samples with their normals.
  double perfect_total() const;

  Compute& compute() { return *compute_; }

 private:
  std::shared_ptr<Compute> compute_;
  SurfaceScores scores_;
};

}  // namespace hewn
