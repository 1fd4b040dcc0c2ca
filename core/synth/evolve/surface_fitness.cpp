#include "core/synth/evolve/surface_fitness.h"

#include <algorithm>
#include <cmath>

#include "core/compute/parallel.h"

namespace hewn {
namespace {

/// A perfect distance, or a perfect normal, in the integers of `SurfaceScores`.
constexpr double kPerfect = SurfaceScoreKernel::kLargestScore / 2.0;

double bell(double x) { return std::exp(-x * x); }

Vec3 gradient_of(const BoundedPrimitive& primitive, const Vec3& p, double step) {
  Vec3 g;
  for (int k = 0; k < 3; ++k) {
    const Vec3 shift = Vec3::Unit(k) * step;
    g[k] = primitive.signed_distance(p + shift) - primitive.signed_distance(p - shift);
  }
  return g.norm() > 0 ? Vec3(g.normalized()) : Vec3::Zero();
}

/// A tree's distance is plus or minus the one of the primitive that decides, so that the score of
/// the distance is known beforehand, like that of the normal.
SampleScore score_of(const BoundedPrimitive& primitive, const SurfaceSample& sample,
                     const SurfaceReach& reach) {
  const double distance = primitive.signed_distance(sample.position);
  const Vec3 normal = gradient_of(primitive, sample.position, 1e-3 * reach.distance);
  const double angle = std::acos(std::clamp(normal.dot(sample.normal), -1.0, 1.0));
  const double of_distance = bell(distance / reach.distance);
  const auto total = [&](double deviation_rad) {
    const double sum = of_distance + bell(deviation_rad / reach.angle_rad);
    return static_cast<std::uint32_t>(std::lround(kPerfect * sum));
  };
  return {static_cast<float>(distance), total(angle), total(kPi - angle)};
}

}  // namespace

SurfaceFitness::SurfaceFitness(std::span<const BoundedPrimitive> primitives,
                               std::span<const SurfaceSample> samples, const SurfaceReach& reach,
                               const RunContext& run)
    : compute_(compute_of(run)), scores_(primitives.size(), samples.size()) {
  for_each_index(run.threads, primitives.size(), [&](std::size_t k) {
    if (run.is_cancelled()) return;
    for (std::size_t i = 0; i < samples.size(); ++i) {
      scores_.set(k, i, score_of(primitives[k], samples[i], reach));
    }
  });
}

double SurfaceFitness::perfect_total() const {
  return 2 * kPerfect * static_cast<double>(std::max<std::size_t>(1, samples()));
}

}  // namespace hewn
