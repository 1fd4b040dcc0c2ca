#pragma once
/// How well a tree over solids fits a surface: distances and normals at points of it (Fayolle and
/// Pasko 2016).
#include <cstdint>
#include <span>
#include <vector>

#include "core/base/run_context.h"
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
/// among them. Thread-safe.
class SurfaceFitness {
 public:
  /// Scratch memory of one thread.
  struct Scratch {
    std::vector<float> distances;
    std::vector<std::int16_t> sources;
  };

  /// Cost: O(samples x primitives) distances, shared by all workers.
  SurfaceFitness(std::span<const BoundedPrimitive> primitives,
                 std::span<const SurfaceSample> samples, const SurfaceReach& reach,
                 const RunContext& run);

  int primitives() const { return static_cast<int>(primitives_); }
  std::size_t samples() const { return samples_; }

  /// The mean over the samples of exp(-(distance / reach)^2) and the same of the angle, in [0, 1].
  /// Tokens are indices of primitives. Cost: O(nodes x samples).
  double score(const Genome& genome, Scratch& scratch) const;

 private:
  std::size_t at(std::size_t primitive, std::size_t sample) const {
    return primitive * samples_ + sample;
  }

  std::size_t primitives_, samples_;
  double reach_;
  std::vector<float> distances_;     ///< by primitive, then by sample
  std::vector<float> angle_score_;   ///< of the primitive's own normal
  std::vector<float> turned_score_;  ///< of the opposite normal
};

}  // namespace hewn
