#include "core/synth/evolve/surface_fitness.h"

#include <algorithm>
#include <cmath>

#include "core/compute/parallel.h"

namespace hewn {
namespace {

double bell(double x) { return std::exp(-x * x); }

Vec3 gradient_of(const BoundedPrimitive& primitive, const Vec3& p, double step) {
  Vec3 g;
  for (int k = 0; k < 3; ++k) {
    const Vec3 shift = Vec3::Unit(k) * step;
    g[k] = primitive.signed_distance(p + shift) - primitive.signed_distance(p - shift);
  }
  return g.norm() > 0 ? Vec3(g.normalized()) : Vec3::Zero();
}

/// What decides at a sample: twice the primitive's index, plus one where it is turned inside out.
std::int16_t source_of(Token primitive) { return static_cast<std::int16_t>(2 * primitive); }

/// Where `b` is nearer the union's surface it takes the place of `a`.
void unite(float* a, std::int16_t* from_a, const float* b, const std::int16_t* from_b,
           std::size_t n) {
  for (std::size_t i = 0; i < n; ++i) {
    from_a[i] = b[i] < a[i] ? from_b[i] : from_a[i];
    a[i] = b[i] < a[i] ? b[i] : a[i];
  }
}

void intersect(float* a, std::int16_t* from_a, const float* b, const std::int16_t* from_b,
               std::size_t n) {
  for (std::size_t i = 0; i < n; ++i) {
    from_a[i] = b[i] > a[i] ? from_b[i] : from_a[i];
    a[i] = b[i] > a[i] ? b[i] : a[i];
  }
}

void turn(float* a, std::int16_t* from_a, std::size_t n) {
  for (std::size_t i = 0; i < n; ++i) {
    a[i] = -a[i];
    from_a[i] = static_cast<std::int16_t>(from_a[i] ^ 1);
  }
}

}  // namespace

SurfaceFitness::SurfaceFitness(std::span<const BoundedPrimitive> primitives,
                               std::span<const SurfaceSample> samples, const SurfaceReach& reach,
                               const RunContext& run)
    : primitives_(primitives.size()),
      samples_(samples.size()),
      reach_(reach.distance),
      distances_(primitives_ * samples_),
      angle_score_(distances_.size()),
      turned_score_(distances_.size()) {
  for_each_index(run.threads, primitives_, [&](std::size_t k) {
    if (run.is_cancelled()) return;
    for (std::size_t i = 0; i < samples_; ++i) {
      const SurfaceSample& s = samples[i];
      distances_[at(k, i)] = static_cast<float>(primitives[k].signed_distance(s.position));
      const Vec3 normal = gradient_of(primitives[k], s.position, 1e-3 * reach.distance);
      const double angle = std::acos(std::clamp(normal.dot(s.normal), -1.0, 1.0));
      angle_score_[at(k, i)] = static_cast<float>(bell(angle / reach.angle_rad));
      turned_score_[at(k, i)] = static_cast<float>(bell((kPi - angle) / reach.angle_rad));
    }
  });
}

double SurfaceFitness::score(const Genome& genome, Scratch& scratch) const {
  const std::size_t n = samples_;
  std::size_t depth = 0;
  const auto distances = [&](std::size_t level) { return scratch.distances.data() + level * n; };
  const auto sources = [&](std::size_t level) { return scratch.sources.data() + level * n; };
  for (const Token token : genome) {
    if (token >= 0) {
      scratch.distances.resize(std::max(scratch.distances.size(), (depth + 1) * n));
      scratch.sources.resize(scratch.distances.size());
      std::copy_n(distances_.begin() + static_cast<std::ptrdiff_t>(at(token, 0)), n,
                  distances(depth));
      std::fill_n(sources(depth), n, source_of(token));
      ++depth;
      continue;
    }
    if (token == kComplementToken || token == kDifferenceToken) {
      turn(distances(depth - 1), sources(depth - 1), n);
    }
    if (token == kComplementToken) continue;
    --depth;
    const auto combine = token == kUnionToken ? unite : intersect;
    combine(distances(depth - 1), sources(depth - 1), distances(depth), sources(depth), n);
  }
  double sum = 0;
  for (std::size_t i = 0; i < n; ++i) {
    const std::int16_t source = sources(0)[i];
    const std::size_t entry = at(static_cast<std::size_t>(source >> 1), i);
    sum += bell(distances(0)[i] / reach_) +
           static_cast<double>((source & 1) != 0 ? turned_score_[entry] : angle_score_[entry]);
  }
  return n == 0 ? 0 : sum / (2 * static_cast<double>(n));
}

}  // namespace hewn
