#include "core/segment/facets.h"

#include <algorithm>
#include <cstdint>
#include <numeric>

#include <Eigen/Eigenvalues>

#include "core/compute/parallel.h"
#include "core/mesh/edge_use.h"

namespace hewn {
namespace {

// Shares of the diagonal. Real parts written with six digits hold coplanar triangles to 1e-5.
constexpr double kSliverHeight = 4e-6;  // no usable normal: never the seed of a facet
constexpr double kNarrowHeight = 2e-5;  // a normal that only hints
constexpr double kNormalSlack = 2e-6;   // of a triangle's tilt, times its height
constexpr double kFreeAngle = 0.01;     // radians; tilt that is always allowed
constexpr double kHintCosine = 0.3;
constexpr int kPasses = 3;
constexpr std::size_t kGrain = 4096;  // triangles or facets a worker takes at a time

double longest_side(const Mesh& mesh, int t) {
  double longest = 0;
  for (int k = 0; k < 3; ++k) {
    longest = std::max(longest, (mesh.corner(t, k) - mesh.corner(t, (k + 1) % 3)).squaredNorm());
  }
  return std::sqrt(longest);
}

struct Plane {
  Vec3 normal;
  double offset;
};

/// Grows one facet after the other over the triangles that are left.
class FacetMerger {
 public:
  FacetMerger(const Mesh& mesh, const std::vector<std::array<int, 3>>& neighbors,
              const FacetTolerance& tolerance, const RunContext& run)
      : mesh_(mesh), neighbors_(neighbors), tolerance_(tolerance), diagonal_(mesh.diagonal()) {
    const int n = static_cast<int>(mesh.triangles.size());
    height_.resize(n);
    least_cosine_.resize(n);
    for_each_chunk(run.threads, height_.size(), kGrain, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) {
        const int t = static_cast<int>(i);
        height_[t] = 2 * mesh.areas[t] / std::max(longest_side(mesh, t), 1e-300);
        least_cosine_[t] = least_cosine(height_[t]);
      }
    });
    facet_of_.assign(n, -1);
    visited_.assign(n, -1);
  }

  std::vector<int> merge(std::vector<Facet>& facets, const RunContext& run) {
    // Largest first, then in their own order.
    std::vector<std::pair<double, int>> order(mesh_.triangles.size());
    for (int t = 0; t < static_cast<int>(order.size()); ++t) order[t] = {-mesh_.areas[t], t};
    std::sort(order.begin(), order.end());
    for (const auto& [negative_area, seed] : order) {
      if (facet_of_[seed] >= 0) continue;
      if (run.is_cancelled()) break;
      Facet facet = grow(seed);
      for (const int t : facet.triangles) facet_of_[t] = static_cast<int>(facets.size());
      std::sort(facet.triangles.begin(), facet.triangles.end());
      facets.push_back(std::move(facet));
    }
    return std::move(facet_of_);
  }

 private:
  Facet grow(int seed) {
    Facet facet;
    facet.triangles = {seed};
    summarise(facet, seed);
    if (height_[seed] < kSliverHeight * diagonal_) return facet;
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
      for (const int u : neighbors_[triangles[i]]) {
        if (u < 0 || facet_of_[u] >= 0 || visited_[u] == stamp_ || !fits(u, plane)) continue;
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

  bool fits(int t, const Plane& plane) const {
    if (mesh_.normals[t].dot(plane.normal) < least_cosine_[t]) return false;
    for (int k = 0; k < 3; ++k) {
      const double d = plane.normal.dot(mesh_.corner(t, k)) - plane.offset;
      if (std::abs(d) > tolerance_.plane) return false;
    }
    return true;
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
  const std::vector<std::array<int, 3>>& neighbors_;
  FacetTolerance tolerance_;
  double diagonal_;
  std::vector<double> height_, least_cosine_;
  std::vector<int> facet_of_, visited_;
  int stamp_ = 0;
};

/// Facets around each vertex: 0, 1, 2 or 3 (three and more).
std::vector<unsigned char> count_facets(const Mesh& mesh, const std::vector<int>& facet_of) {
  std::vector<std::array<int, 2>> seen(mesh.vertices.size(), {-1, -1});
  std::vector<unsigned char> count(mesh.vertices.size(), 0);
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    for (const int v : mesh.triangles[t]) {
      const int f = facet_of[t];
      if (seen[v][0] == f || seen[v][1] == f || count[v] == 3) continue;
      if (count[v] < 2) seen[v][count[v]] = f;
      ++count[v];
    }
  }
  return count;
}

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

std::vector<std::array<int, 3>> triangle_neighbors(const Mesh& mesh) {
  std::vector<std::array<int, 3>> neighbors(mesh.triangles.size(), {-1, -1, -1});
  const std::vector<EdgeSide> sides = sorted_sides(mesh.triangles);
  for_each_edge(sides, [&](std::span<const EdgeSide> edge) {
    if (edge.size() != 2) return;
    neighbors[edge[0].triangle()][edge[0].corner()] = edge[1].triangle();
    neighbors[edge[1].triangle()][edge[1].corner()] = edge[0].triangle();
  });
  return neighbors;
}

void FacetGraph::collect_vertices(const Mesh& mesh) {
  std::vector<int> last(mesh.vertices.size(), -1);
  vertex_begin_.assign(1, 0);
  for (int f = 0; f < size(); ++f) {
    const std::size_t begin = vertices_.size();
    for (const int t : facets[f].triangles) {
      for (const int v : mesh.triangles[t]) {
        if (last[v] != f) vertices_.push_back(v);
        last[v] = f;
      }
    }
    std::sort(vertices_.begin() + static_cast<std::ptrdiff_t>(begin), vertices_.end());
    vertex_begin_.push_back(static_cast<int>(vertices_.size()));
  }
}

void FacetGraph::collect_corners(const Mesh& mesh,
                                 const std::vector<std::array<int, 3>>& neighbors) {
  const std::vector<unsigned char> count = count_facets(mesh, facet_of_triangle);
  std::vector<bool> is_open(mesh.vertices.size(), false);
  for (std::size_t t = 0; t < neighbors.size(); ++t) {
    for (int k = 0; k < 3; ++k) {
      if (neighbors[t][k] >= 0) continue;
      is_open[mesh.triangles[t][k]] = is_open[mesh.triangles[t][(k + 1) % 3]] = true;
    }
  }
  std::size_t interior = 0;
  for (std::size_t v = 0; v < count.size(); ++v) interior += count[v] == 1 && !is_open[v];
  interior_share = static_cast<double>(interior) / static_cast<double>(count.size());
  corner_begin_.assign(1, 0);
  for (int f = 0; f < size(); ++f) {
    const std::size_t begin = corners_.size();
    for (const int v : vertices(f)) {
      if (count[v] >= 3 || is_open[v]) corners_.push_back(v);
    }
    if (corners_.size() < begin + 3) {
      corners_.resize(begin);
      corners_.insert(corners_.end(), vertices(f).begin(), vertices(f).end());
    }
    corner_begin_.push_back(static_cast<int>(corners_.size()));
  }
  corner_uses_.assign(mesh.vertices.size(), 0);
  for (const int v : corners_) ++corner_uses_[v];
}

void FacetGraph::collect_neighbors(const Mesh& mesh,
                                   const std::vector<std::array<int, 3>>& neighbors) {
  neighbor_begin_.assign(1, 0);
  std::vector<int> slot(facets.size(), -1);
  for (int f = 0; f < size(); ++f) {
    const int begin = static_cast<int>(neighbors_.size());
    for (const int t : facets[f].triangles) {
      for (int k = 0; k < 3; ++k) {
        const int u = neighbors[t][k];
        const int g = u < 0 ? -1 : facet_of_triangle[u];
        if (g < 0 || g == f) continue;
        if (slot[g] < begin) {
          slot[g] = static_cast<int>(neighbors_.size());
          const bool has_normals = !facets[f].normal.isZero() && !facets[g].normal.isZero();
          const double angle =
              has_normals ? angle_between(facets[f].normal, facets[g].normal) : kPi / 2;
          neighbors_.push_back({g, angle, 0});
        }
        neighbors_[slot[g]].length += (mesh.corner(t, k) - mesh.corner(t, (k + 1) % 3)).norm();
      }
    }
    std::sort(neighbors_.begin() + begin, neighbors_.end(),
              [](const FacetNeighbor& a, const FacetNeighbor& b) { return a.facet < b.facet; });
    neighbor_begin_.push_back(static_cast<int>(neighbors_.size()));
    for (int i = begin; i < neighbor_begin_.back(); ++i) slot[neighbors_[i].facet] = -1;
  }
}

FacetGraph build_facets(const Mesh& mesh, const std::vector<std::array<int, 3>>& neighbors,
                        const FacetTolerance& tolerance, const RunContext& run) {
  FacetGraph graph;
  graph.facet_of_triangle = FacetMerger(mesh, neighbors, tolerance, run).merge(graph.facets, run);
  graph.collect_vertices(mesh);
  graph.collect_corners(mesh, neighbors);
  graph.collect_neighbors(mesh, neighbors);
  for (int f = 0; f < graph.size(); ++f) {
    Box3 box;
    for (const int v : graph.corners(f)) box.extend(mesh.vertices[v]);
    const double width = graph.facets[f].area / std::max(box.diagonal(), 1e-300);
    graph.normal_error_rad.push_back(2 * tolerance.noise / std::max(width, 1e-300));
  }
  return graph;
}

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

double estimate_noise(const Mesh& mesh, const std::vector<std::array<int, 3>>& neighbors,
                      const RunContext& run) {
  constexpr double kLoosePlane = 6e-5;  // jitter of 1e-5 stays within
  constexpr double kLooseNoise = 1e-5;
  constexpr double kRounding = 2e-8;
  const double diagonal = mesh.diagonal();
  const FacetGraph graph =
      build_facets(mesh, neighbors, {kLoosePlane * diagonal, kLooseNoise * diagonal}, run);
  std::vector<Residual> residuals(graph.facets.size());
  for_each_chunk(run.threads, residuals.size(), kGrain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t f = begin; f < end && !run.is_cancelled(); ++f) {
      residuals[f] = plane_residual(mesh, graph.vertices(static_cast<int>(f)));
    }
  });
  std::erase_if(residuals, [](const Residual& r) { return r.freedom <= 0; });
  return std::max({kRounding * diagonal, coordinate_rounding(mesh), pooled_deviation(residuals)});
}

}  // namespace hewn
