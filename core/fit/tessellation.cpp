#include "core/fit/tessellation.h"

#include <algorithm>

#include "core/fit/directions.h"

namespace hewn {
namespace {

constexpr double kMinArea = 1e-7;   // of the squared diagonal: normals of smaller facets scatter
constexpr double kMinStep = 0.008;  // radians between neighbouring facets
constexpr double kMinCoherence = 0.995;
constexpr int kMinSides = 3;
constexpr int kMaxSides = 720;

/// The period of a set of angles: `sides` steps around the circle, facets centred at `center_rad`.
struct Period {
  int sides = 0;
  double center_rad = 0;
};

/// How well the angles agree with `sides` equal steps, [0, 1], and where the steps' centres are.
double coherence(const std::vector<double>& angles, int sides, double& center_rad) {
  double c = 0, s = 0;
  for (const double a : angles) {
    c += std::cos(a * sides);
    s += std::sin(a * sides);
  }
  center_rad = std::atan2(s, c) / sides;
  return std::hypot(c, s) / static_cast<double>(angles.size());
}

/// Finds the number of steps from the median gap between distinct angles.
Period find_period(std::vector<double> angles) {
  if (angles.size() < 3) return {};
  std::sort(angles.begin(), angles.end());
  std::vector<double> gaps;
  for (std::size_t i = 1; i < angles.size(); ++i) {
    if (angles[i] - angles[i - 1] > kMinStep) gaps.push_back(angles[i] - angles[i - 1]);
  }
  if (gaps.size() < 2) return {};
  std::nth_element(gaps.begin(), gaps.begin() + static_cast<std::ptrdiff_t>(gaps.size() / 2),
                   gaps.end());
  const int guess = static_cast<int>(std::lround(2 * kPi / gaps[gaps.size() / 2]));
  Period best;
  double best_coherence = kMinCoherence;
  for (int n = std::max(kMinSides, guess - 2); n <= std::min(kMaxSides, guess + 2); ++n) {
    double center = 0;
    const double c = coherence(angles, n, center);
    if (c > best_coherence + 1e-9) {
      best_coherence = c;
      best = {n, center};
    }
  }
  return best;
}

/// A vertex lies half a step from the facet's centre.
double vertex_phase(const Period& period) {
  const double step = 2 * kPi / period.sides;
  double phase = std::fmod(period.center_rad + step / 2, step);
  if (phase < 0) phase += step;
  const bool is_zero = std::min(phase, step - phase) < 2e-3 * step;
  return is_zero ? 0 : phase;
}

std::vector<int> facets_of(const std::vector<int>& groups, const Mesh& mesh,
                           const Segmentation& segmentation) {
  std::vector<int> facets;
  for (const int g : groups) {
    for (const int t : segmentation.groups[g].triangles) {
      facets.push_back(segmentation.facet_of_triangle[t]);
    }
  }
  std::sort(facets.begin(), facets.end());
  facets.erase(std::unique(facets.begin(), facets.end()), facets.end());
  const double min_area = kMinArea * mesh.diagonal() * mesh.diagonal();
  std::erase_if(facets, [&](int f) { return f < 0 || segmentation.facets[f].area < min_area; });
  return facets;
}

}  // namespace

Facets detect_tessellation(const Surface& surface, const std::vector<int>& groups, const Mesh& mesh,
                           const Segmentation& segmentation) {
  if (surface.kind == SurfaceKind::Plane || segmentation.facets.empty()) return {};
  const Tangents frame = reference_frame(surface.axis);
  const bool is_tube = surface.kind == SurfaceKind::Torus;
  std::vector<double> azimuths, tube_angles;
  for (const int f : facets_of(groups, mesh, segmentation)) {
    const Facet& facet = segmentation.facets[f];
    const Vec3 d = facet.centroid - surface.point;
    const double height = surface.axis.dot(d);
    const Vec3 outward = d - surface.axis * height;
    const bool flipped = surface.gradient(facet.centroid).dot(facet.normal) < 0;
    // Trimming shifts a facet's centre along a torus' or sphere's ring less than its normal tilts.
    const Vec3 n = is_tube ? outward : Vec3(flipped ? -facet.normal : facet.normal);
    const double x = frame.u.dot(n);
    const double y = frame.w.dot(n);
    if (std::hypot(x, y) > 1e-6) azimuths.push_back(std::atan2(y, x));
    if (is_tube) {
      tube_angles.push_back(std::atan2(height, outward.norm() - surface.major_radius));
    }
  }
  Facets result;
  const Period around = find_period(azimuths);
  if (around.sides == 0) return result;
  result.sides = around.sides;
  result.phase_rad = vertex_phase(around);
  const Period tube = find_period(tube_angles);
  if (tube.sides > 0) {
    result.tube_sides = tube.sides;
    result.tube_phase_rad = vertex_phase(tube);
  }
  return result;
}

SphereTessellation detect_sphere_tessellation(const Surface& sphere, const std::vector<int>& groups,
                                              const Mesh& mesh, const Segmentation& segmentation) {
  constexpr double kOnSphere = 2e-5;  // share of the diagonal
  constexpr double kMinShare = 0.85;  // of the vertices that must be explained
  constexpr double kBetter = 1.05;    // against a tessellation with fewer sides
  constexpr double kLatitude = 0.08 * kPi / 180;
  constexpr double kLongitude = 0.1 * kPi / 180;
  constexpr int kMaxSphereSides = 150;
  std::vector<Vec3> directions;
  for (const int g : groups) {
    for (const int t : segmentation.groups[g].triangles) {
      for (const int v : mesh.triangles[t]) {
        const double d = sphere.signed_distance(mesh.vertices[v]);
        if (std::abs(d) > kOnSphere * mesh.diagonal()) continue;
        directions.emplace_back((mesh.vertices[v] - sphere.point) / sphere.radius);
      }
    }
  }
  SphereTessellation best;
  if (directions.size() < 24) return best;
  double most = kMinShare * static_cast<double>(directions.size());
  for (int axis = 2; axis >= 0; --axis) {
    for (int n = 8; n <= kMaxSphereSides; ++n) {
      const int rings = (n + 1) / 2;
      int hits = 0;
      for (const Vec3& d : directions) {
        const double polar = std::acos(std::clamp(d[axis], -1.0, 1.0));
        const double ring = polar * rings / kPi - 0.5;
        const double side = std::atan2(d[(axis + 2) % 3], d[(axis + 1) % 3]) * n / (2 * kPi);
        const double off_ring = std::abs(ring - std::round(ring)) * kPi / rings;
        const double off_side = std::abs(side - std::round(side)) * 2 * kPi / n * std::sin(polar);
        hits += off_ring < kLatitude && off_side < kLongitude;
      }
      if (hits <= most) continue;
      most = hits * kBetter;
      best.axis = Vec3::Unit(axis);
      best.facets.sides = n;
      best.facets.tube_sides = rings;
    }
  }
  return best;
}

}  // namespace hewn
