#include "core/segment/facet_noise.h"

#include <algorithm>
#include <cmath>
#include <span>

#include <Eigen/Eigenvalues>

#include "core/compute/parallel.h"
#include "core/segment/facet_vertices.h"

namespace hewn {
namespace {

constexpr std::size_t kGrain = 1024;  // facets a worker takes at a time

/// The plane's residual at a facet's vertices: sum of squares and degrees of freedom.
struct Residual {
  double squares = 0;
  int freedom = 0;
  double variance() const { return squares / freedom; }
};

Residual plane_residual(const Mesh& mesh, std::span<const int> vertices) {
  Residual r;
  r.freedom = static_cast<int>(vertices.size()) - 3;
  if (r.freedom <= 0) return r;
  Vec3 center = Vec3::Zero();
  for (const int v : vertices) center += mesh.vertices[v];
  center /= static_cast<double>(vertices.size());
  Mat3 moment = Mat3::Zero();
  for (const int v : vertices) {
    const Vec3 d = mesh.vertices[v] - center;
    moment += d * d.transpose();
  }
  const Vec3 normal = Eigen::SelfAdjointEigenSolver<Mat3>(moment).eigenvectors().col(0);
  for (const int v : vertices) {
    const double d = normal.dot(mesh.vertices[v] - center);
    r.squares += d * d;
  }
  return r;
}

/// Pools residuals, leaving out those that are not noise (runs of a curved surface).
double pooled_deviation(std::vector<Residual>& residuals) {
  constexpr double kQuantile = 0.4;
  constexpr double kClip = 6;
  std::stable_sort(residuals.begin(), residuals.end(), [](const Residual& a, const Residual& b) {
    return a.variance() < b.variance();
  });
  long total = 0;
  for (const Residual& r : residuals) total += r.freedom;
  double variance = 0;
  long seen = 0;
  for (const Residual& r : residuals) {
    seen += r.freedom;
    variance = r.variance();
    if (static_cast<double>(seen) >= kQuantile * static_cast<double>(total)) break;
  }
  for (int round = 0; round < 10; ++round) {
    double squares = 0;
    long freedom = 0;
    for (const Residual& r : residuals) {
      if (r.variance() > kClip * variance) break;
      squares += r.squares;
      freedom += r.freedom;
    }
    if (freedom == 0) break;
    const double next = squares / static_cast<double>(freedom);
    if (next <= variance * 1.01) return std::sqrt(next);
    variance = next;
  }
  return std::sqrt(variance);
}

}  // namespace

double coordinate_rounding(const Mesh& mesh) {
  constexpr std::size_t kSample = 2000;
  constexpr int kMaxDigits = 7;
  const std::size_t step = std::max<std::size_t>(1, mesh.vertices.size() / kSample);
  double largest = 0;
  bool is_single = true;
  int digits = 0;
  for (std::size_t i = 0; i < mesh.vertices.size(); i += step) {
    for (const double x : mesh.vertices[i]) {
      if (x == 0 || !std::isfinite(x)) continue;
      largest = std::max(largest, std::abs(x));
      is_single = is_single && static_cast<double>(static_cast<float>(x)) == x;
      for (; digits <= kMaxDigits; ++digits) {
        const int shift = digits - 1 - static_cast<int>(std::floor(std::log10(std::abs(x))));
        const double scaled = x * std::pow(10.0, shift);
        if (std::abs(scaled - std::round(scaled)) < 1e-6) break;
      }
    }
  }
  if (!(largest > 0)) return 0;
  const double uniform = 1 / std::sqrt(12.0);
  if (digits >= 1 && digits <= kMaxDigits) {
    return uniform * std::pow(10.0, std::floor(std::log10(largest)) - digits + 1);
  }
  return is_single ? uniform * std::ldexp(1.0, std::ilogb(largest) - 23) : 0;
}

double estimate_noise(const FacetMerger& merger, const RunContext& run) {
  constexpr double kLoosePlane = 6e-5;  // jitter of 1e-5 stays within
  constexpr double kLooseNoise = 1e-5;
  constexpr double kRounding = 2e-8;
  const Mesh& mesh = merger.mesh();
  const double diagonal = mesh.diagonal();
  const std::vector<Facet> facets =
      merger.merge({kLoosePlane * diagonal, kLooseNoise * diagonal}, run).facets;
  const FacetVertices vertices(mesh, facets);
  std::vector<Residual> residuals(facets.size());
  for_each_chunk(run.threads, residuals.size(), kGrain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t f = begin; f < end && !run.is_cancelled(); ++f) {
      residuals[f] = plane_residual(mesh, vertices.of(f));
    }
  });
  std::erase_if(residuals, [](const Residual& r) { return r.freedom <= 0; });
  return std::max({kRounding * diagonal, coordinate_rounding(mesh), pooled_deviation(residuals)});
}

}  // namespace hewn
