#include "core/segment/developable.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "core/segment/same_axis.h"

namespace hewn {
namespace {

/// As exact as before but for this factor, or exact enough anyway.
constexpr double kAsExact = 1.5;

/// The simplest developable surface that explains the facets as well as `quality`.
std::optional<Surface> developable_fit(FacetFitter& fitter, std::span<const int> facets,
                                       const FitQuality& quality, double eps) {
  std::optional<Surface> best;
  for (Surface surface : fitter.guess(facets)) {
    if (!is_ruled(surface.kind)) continue;
    if (best && (best->kind == SurfaceKind::Cylinder || surface.kind == best->kind)) continue;
    if (!fitter.refine(surface, facets, {.max_iterations = 30})) continue;
    const FitQuality q = fitter.evaluate(surface, facets);
    const bool is_exact = q.max_distance <= std::max(kAsExact * quality.max_distance, eps);
    const bool is_smooth = q.max_angle_rad <= quality.angle_as_smooth();
    if (is_exact && is_smooth) best = surface;
  }
  return best;
}

/// The ring and the flat faces at its ends, in the place of a sphere: any two circles about one
/// axis lie on one. Empty when the sphere is more than that.
std::vector<GrownGroup> split_sphere(const GrownGroup& sphere, const FacetGraph& graph,
                                     FacetFitter& fitter, double eps) {
  constexpr std::size_t kCornersOfSide = 4;
  GrownGroup ring;
  std::vector<GrownGroup> pieces;
  for (const int f : sphere.facets) {
    if (graph.corners(f).size() > kCornersOfSide) {
      pieces.push_back({fitter.plane_of(f), {f}});
    } else {
      ring.facets.push_back(f);
    }
  }
  if (pieces.empty() || ring.facets.empty()) return {};
  const FitQuality quality = fitter.evaluate(sphere.surface, ring.facets);
  const auto surface = developable_fit(fitter, ring.facets, quality, eps);
  if (!surface) return {};
  ring.surface = *surface;
  pieces.push_back(std::move(ring));
  return pieces;
}

/// A ring of facets around an axis: all are inclined alike.
struct Ring {
  std::vector<int> facets;
  double width = 0;  ///< along its slope
};

class RingFinder {
 public:
  RingFinder(const Mesh& mesh, const FacetGraph& graph, const FacetFitter& fitter)
      : mesh_(mesh), graph_(graph), fitter_(fitter) {}

  /// The facets divided by their inclination to the torus's axis; empty when one is too small to
  /// tell.
  std::vector<Ring> rings(const Surface& torus, const std::vector<int>& facets) const {
    std::vector<std::pair<double, int>> by_inclination;
    for (const int f : facets) {
      if (!fitter_.is_solid(f)) return {};
      by_inclination.emplace_back(inclination(torus, f), f);
    }
    std::sort(by_inclination.begin(), by_inclination.end());
    std::vector<Ring> rings;
    double last = -kInfinity;
    for (const auto& [angle, f] : by_inclination) {
      if (angle - last > kSameInclination) rings.emplace_back();
      rings.back().facets.push_back(f);
      last = angle;
    }
    for (Ring& ring : rings) ring.width = width(torus, ring.facets);
    return rings;
  }

 private:
  static constexpr double kSameInclination = 0.017;  // radians

  /// Of a facet's normal against the axis, in the plane through both.
  double inclination(const Surface& torus, int facet) const {
    const Facet& f = graph_.facets[facet];
    const Vec3 d = f.centroid - torus.point;
    const Vec3 outward = d - torus.axis * torus.axis.dot(d);
    return std::atan2(f.normal.dot(torus.axis), f.normal.dot(outward.normalized()));
  }

  double width(const Surface& torus, const std::vector<int>& facets) const {
    Vec3 lo = Vec3::Constant(kInfinity);
    Vec3 hi = -lo;
    for (const int f : facets) {
      for (const int v : graph_.corners(f)) {
        const Vec3 d = mesh_.vertices[v] - torus.point;
        const double height = torus.axis.dot(d);
        const Vec3 profile((d - torus.axis * height).norm(), height, 0);
        lo = lo.cwiseMin(profile);
        hi = hi.cwiseMax(profile);
      }
    }
    return (hi - lo).norm();
  }

  const Mesh& mesh_;
  const FacetGraph& graph_;
  const FacetFitter& fitter_;
};

/// The steps of a tessellation are equally wide but for this share.
constexpr double kSameWidth = 0.05;

/// Two groups in the place of a torus that only says that they follow each other.
std::vector<GrownGroup> split_torus(const GrownGroup& torus, const RingFinder& finder,
                                    FacetFitter& fitter, double eps) {
  const std::vector<Ring> rings = finder.rings(torus.surface, torus.facets);
  if (rings.size() != 2) return {};
  const double wider = std::max(rings[0].width, rings[1].width);
  if (std::abs(rings[0].width - rings[1].width) < kSameWidth * wider) return {};
  std::vector<GrownGroup> pieces;
  for (const Ring& ring : rings) {
    const FitQuality quality = fitter.evaluate(torus.surface, ring.facets);
    const auto surface = developable_fit(fitter, ring.facets, quality, eps);
    if (!surface) return {};
    GrownGroup piece;
    piece.surface = *surface;
    piece.facets = ring.facets;
    std::sort(piece.facets.begin(), piece.facets.end());
    pieces.push_back(std::move(piece));
  }
  return pieces;
}

}  // namespace

void prefer_developable(const Mesh& mesh, const FacetGraph& graph,
                        const SurfaceTolerance& tolerance, FacetGroups& found) {
  FacetFitter fitter(mesh, graph, tolerance);
  const RingFinder finder(mesh, graph, fitter);
  std::vector<GrownGroup>& groups = found.groups;
  const std::size_t count = groups.size();
  for (std::size_t g = 0; g < count; ++g) {
    const SurfaceKind kind = groups[g].surface.kind;
    if (kind != SurfaceKind::Sphere && kind != SurfaceKind::Torus) continue;
    const FitQuality quality = fitter.evaluate(groups[g].surface, groups[g].facets);
    if (const auto simpler = developable_fit(fitter, groups[g].facets, quality, tolerance.eps)) {
      groups[g].surface = *simpler;
      continue;
    }
    std::vector<GrownGroup> pieces = kind == SurfaceKind::Torus
                                         ? split_torus(groups[g], finder, fitter, tolerance.eps)
                                         : split_sphere(groups[g], graph, fitter, tolerance.eps);
    if (pieces.empty()) continue;
    groups[g] = std::move(pieces.back());
    pieces.pop_back();
    for (GrownGroup& piece : pieces) found.add(std::move(piece));
  }
}

}  // namespace hewn
