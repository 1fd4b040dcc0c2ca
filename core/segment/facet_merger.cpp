#include "core/segment/facet_merger.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/compute/parallel.h"

namespace hewn {
namespace {

// Shares of the diagonal. Real parts written with six digits hold coplanar triangles to 1e-5.
constexpr double kSliverHeight = 4e-6;  // no usable normal: never the seed of a facet
constexpr double kNarrowHeight = 2e-5;  // a normal that only hints
constexpr double kNormalSlack = 2e-6;   // of a triangle's tilt, times its height
constexpr double kFreeAngle = 0.01;     // radians; tilt that is always allowed
constexpr double kHintCosine = 0.3;
constexpr int kPasses = 3;
constexpr std::size_t kGrain = 4096;  // triangles a worker takes at a time

double longest_side(const Mesh& mesh, int t) {
  double longest = 0;
  for (int k = 0; k < 3; ++k) {
    longest = std::max(longest, (mesh.corner(t, k) - mesh.corner(t, (k + 1) % 3)).squaredNorm());
  }
  return std::sqrt(longest);
}

std::vector<int> largest_first(const Mesh& mesh) {
  std::vector<std::pair<double, int>> by_area(mesh.triangles.size());
  for (int t = 0; t < static_cast<int>(by_area.size()); ++t) by_area[t] = {-mesh.areas[t], t};
  std::sort(by_area.begin(), by_area.end());
  std::vector<int> order;
  order.reserve(by_area.size());
  for (const auto& [negative_area, t] : by_area) order.push_back(t);
  return order;
}

struct Plane {
  Vec3 normal;
  double offset;
};

}  // namespace

/// Grows one facet after the other over the triangles that are left.
class FacetMerger::Growth {
 public:
  Growth(const FacetMerger& all, const FacetTolerance& tolerance, const RunContext& run)
      : mesh_(all.mesh_), all_(all), tolerance_(tolerance), diagonal_(mesh_.diagonal()) {
    const std::size_t n = mesh_.triangles.size();
    least_cosine_.resize(n);
    for_each_chunk(run.threads, n, kGrain, [&](std::size_t begin, std::size_t end) {
      for (std::size_t t = begin; t < end; ++t) least_cosine_[t] = least_cosine(all_.height_[t]);
    });
    facet_of_.assign(n, -1);
    visited_.assign(n, -1);
  }

  MergedFacets run(const RunContext& run) {
    std::vector<Facet> facets;
    for (const int seed : all_.order_) {
      if (facet_of_[seed] >= 0) continue;
      if (run.is_cancelled()) break;
      Facet facet = grow(seed);
      for (const int t : facet.triangles) facet_of_[t] = static_cast<int>(facets.size());
      facet.triangles.clear();
      facets.push_back(std::move(facet));
    }
    for (int t = 0; t < static_cast<int>(facet_of_.size()); ++t) {
      if (facet_of_[t] >= 0) facets[facet_of_[t]].triangles.push_back(t);
    }
    return {std::move(facets), std::move(facet_of_)};
  }

 private:
  Facet grow(int seed) {
    Facet facet;
    facet.triangles = {seed};
    summarise(facet, seed);
    if (all_.height_[seed] < kSliverHeight * diagonal_) return facet;
    Plane plane{facet.normal, facet.normal.dot(facet.centroid)};
    std::size_t before = 1;
    for (int pass = 0; pass < kPasses; ++pass) {
      flood(seed, plane, facet.triangles);
      summarise(facet, seed);
      if (facet.triangles.size() <= before) break;
      before = facet.triangles.size();
      plane = {facet.normal, facet.normal.dot(facet.centroid)};
    }
    return facet;
  }

  void flood(int seed, const Plane& plane, std::vector<int>& triangles) {
    ++stamp_;
    triangles.assign(1, seed);
    visited_[seed] = stamp_;
    for (std::size_t i = 0; i < triangles.size(); ++i) {
      const int t = triangles[i];
      for (const int u : all_.neighbors_[t]) {
        if (u < 0 || facet_of_[u] >= 0 || visited_[u] == stamp_ || !turns_with(u, plane)) continue;
        // The seed belongs to its facet unseen; the corners of all others have been looked at.
        if (!(i == 0 ? lies_on(u, plane) : is_near(opposite(u, t), plane))) continue;
        visited_[u] = stamp_;
        triangles.push_back(u);
      }
    }
  }

  /// Of the angle by which a triangle of this height may turn from the plane.
  double least_cosine(double height) const {
    if (!(height >= kNarrowHeight * diagonal_)) {
      return height > kSliverHeight * diagonal_ ? kHintCosine : -kInfinity;
    }
    const double slack = (kNormalSlack * diagonal_ + 4 * tolerance_.noise) / height;
    return std::cos(std::min(std::max(kFreeAngle, slack), 1.2));
  }

  bool turns_with(int t, const Plane& plane) const {
    return mesh_.normals[t].dot(plane.normal) >= least_cosine_[t];
  }
  bool is_near(int vertex, const Plane& plane) const {
    return std::abs(plane.normal.dot(mesh_.vertices[vertex]) - plane.offset) <= tolerance_.plane;
  }
  bool lies_on(int t, const Plane& plane) const {
    const auto& [a, b, c] = mesh_.triangles[t];
    return is_near(a, plane) && is_near(b, plane) && is_near(c, plane);
  }
  /// The vertex of triangle t that its neighbour does not have.
  int opposite(int t, int neighbor) const {
    const std::array<int, 3>& across = all_.neighbors_[t];
    const int side = across[0] == neighbor ? 0 : across[1] == neighbor ? 1 : 2;
    return mesh_.triangles[t][(side + 2) % 3];
  }

  void summarise(Facet& facet, int seed) const {
    facet.area = 0;
    Vec3 normal = Vec3::Zero(), center = Vec3::Zero();
    for (const int t : facet.triangles) {
      facet.area += mesh_.areas[t];
      normal += mesh_.areas[t] * mesh_.normals[t];
      center += mesh_.areas[t] * mesh_.centroid(t);
    }
    facet.centroid = facet.area > 0 ? Vec3(center / facet.area) : mesh_.centroid(seed);
    facet.normal = normal.norm() > 0 ? Vec3(normal.normalized()) : Vec3(Vec3::Zero());
  }

  const Mesh& mesh_;
  const FacetMerger& all_;
  FacetTolerance tolerance_;
  double diagonal_;
  std::vector<double> least_cosine_;  ///< of each triangle's normal and the plane's
  std::vector<int> facet_of_, visited_;
  int stamp_ = 0;
};

FacetMerger::FacetMerger(const Mesh& mesh, const std::vector<std::array<int, 3>>& neighbors,
                         const RunContext& run)
    : mesh_(mesh), neighbors_(neighbors), height_(mesh.triangles.size()) {
  for_each_chunk(run.threads, height_.size(), kGrain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const int t = static_cast<int>(i);
      height_[t] = 2 * mesh.areas[t] / std::max(longest_side(mesh, t), 1e-300);
    }
  });
  order_ = largest_first(mesh);
}

MergedFacets FacetMerger::merge(const FacetTolerance& tolerance, const RunContext& run) const {
  return Growth(*this, tolerance, run).run(run);
}

}  // namespace hewn
