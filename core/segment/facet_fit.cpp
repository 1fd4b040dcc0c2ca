#include "core/segment/facet_fit.h"

#include <algorithm>

#include "core/fit/gauss_newton.h"
#include "core/fit/initial_guess.h"
#include "core/segment/facet_vertices.h"
#include "core/segment/tangent_planes.h"

namespace hewn {
namespace {

constexpr std::size_t kMaxPoints = 600;
constexpr std::size_t kMaxNormals = 200;
constexpr double kTinyArea = 1e-9;  // shares of the squared diagonal
constexpr double kSolidArea = 1e-7;
constexpr double kTinyNormalError = 0.15;  // radians
constexpr double kSolidNormalError = 0.02;
constexpr std::size_t kPointsPerParameter = 2;
constexpr double kUncutNoise = 1.5;  // times eps
constexpr double kMinStep = 0.005;   // radians; neighbours on one cylinder turn by more

/// Keeps at most `limit` evenly spaced items.
template <class T>
void thin_out(std::vector<T>& items, std::size_t limit) {
  if (items.size() <= limit) return;
  for (std::size_t i = 0; i < limit; ++i) items[i] = items[i * items.size() / limit];
  items.resize(limit);
}

}  // namespace

double unsigned_angle(const Vec3& a, const Vec3& b) {
  const double angle = angle_between(a, b);
  return std::min(angle, kPi - angle);
}

FacetFitter::FacetFitter(const Mesh& mesh, const FacetGraph& graph,
                         const SurfaceTolerance& tolerance)
    : mesh_(mesh),
      graph_(graph),
      tolerance_(tolerance),
      stamp_of_vertex_(mesh.vertices.size(), 0),
      stamp_of_facet_(graph.facets.size(), 0),
      uses_(mesh.vertices.size(), 0) {}

std::vector<int> FacetFitter::corner_indices(std::span<const int> facets) {
  ++stamp_;
  std::vector<int> indices;
  for (const int f : facets) {
    for (const int v : graph_.corners(f)) {
      if (stamp_of_vertex_[v] != stamp_) indices.push_back(v);
      stamp_of_vertex_[v] = stamp_;
    }
  }
  sort_marked(indices, 0, stamp_of_vertex_, stamp_);
  return indices;
}

std::vector<Vec3> FacetFitter::corner_points(std::span<const int> facets, std::size_t limit) {
  std::vector<int> indices = corner_indices(facets);
  thin_out(indices, limit);
  std::vector<Vec3> points;
  points.reserve(indices.size());
  for (const int v : indices) points.push_back(mesh_.vertices[v]);
  return points;
}

std::vector<Surface> FacetFitter::guess(std::span<const int> facets) {
  const std::vector<Vec3> points = corner_points(facets, kMaxPoints);
  std::vector<Vec3> normals, centers;
  for (const int f : facets) {
    normals.push_back(graph_.facets[f].normal);
    centers.push_back(graph_.facets[f].centroid);
  }
  return guess_surfaces({points, normals, centers}, tolerance_.diagonal);
}

bool FacetFitter::refine(Surface& surface, std::span<const int> facets,
                         const FacetFitSettings& settings) {
  const std::vector<Vec3> points = corner_points(facets, kMaxPoints);
  std::vector<Vec3> normals, centers;
  if (settings.normal_weight > 0) {
    std::vector<int> picked(facets.begin(), facets.end());
    thin_out(picked, kMaxNormals);
    for (const int f : picked) {
      normals.push_back(graph_.facets[f].normal);
      centers.push_back(graph_.facets[f].centroid);
    }
  }
  FitSettings fit;
  fit.max_iterations = settings.max_iterations;
  fit.normal_weight = settings.normal_weight;
  fit.robust_scale = settings.is_robust ? 0.1 * tolerance_.eps : 0;
  return refine_surface(surface, {points, normals, centers}, fit);
}

Surface FacetFitter::plane_of(int facet) const {
  Surface s;
  s.axis = graph_.facets[facet].normal;
  double sum = 0;
  for (const int v : graph_.vertices(facet)) sum += s.axis.dot(mesh_.vertices[v]);
  s.offset = sum / static_cast<double>(graph_.vertices(facet).size());
  return s;
}

FitQuality FacetFitter::evaluate(const Surface& surface, std::span<const int> facets) const {
  const SurfaceField field(surface);
  FitQuality q;
  std::size_t count = 0;
  double across2 = 0, along2 = 1;  // of the normal that deviates most; its tangent, squared
  for (const int f : facets) {
    for (const int v : graph_.corners(f)) {
      const double d = std::abs(field.signed_distance(mesh_.vertices[v]));
      q.max_distance = std::max(q.max_distance, d);
      q.rms_distance += d * d;
      ++count;
    }
    const Facet& facet = graph_.facets[f];
    q.sagitta = std::max(q.sagitta, std::abs(field.signed_distance(facet.centroid)));
    const Vec3 gradient = field.gradient(facet.centroid);
    const double own_across2 = gradient.cross(facet.normal).squaredNorm();
    const double cosine = gradient.dot(facet.normal);
    if (own_across2 * along2 > across2 * cosine * cosine) {
      across2 = own_across2;
      along2 = cosine * cosine;
    }
  }
  q.max_angle_rad = std::atan2(std::sqrt(across2), std::sqrt(along2));
  q.rms_distance = std::sqrt(q.rms_distance / static_cast<double>(std::max<std::size_t>(1, count)));
  return q;
}

double FacetFitter::max_distance(const SurfaceField& surface, int facet) const {
  double d = 0;
  for (const int v : graph_.corners(facet)) {
    d = std::max(d, std::abs(surface.signed_distance(mesh_.vertices[v])));
  }
  return d;
}

double FacetFitter::max_depth(const SurfaceField& surface, int facet) const {
  return std::max(max_distance(surface, facet),
                  std::abs(surface.signed_distance(graph_.facets[facet].centroid)));
}

bool FacetFitter::is_tiny(int facet) const {
  return graph_.facets[facet].area < kTinyArea * tolerance_.diagonal * tolerance_.diagonal ||
         graph_.normal_error_rad[facet] > kTinyNormalError;
}

bool FacetFitter::is_solid(int facet) const {
  return graph_.facets[facet].area > kSolidArea * tolerance_.diagonal * tolerance_.diagonal &&
         graph_.normal_error_rad[facet] < kSolidNormalError;
}

double FacetFitter::refine_uncut(Surface& surface, std::span<const int> facets,
                                 const FitQuality& quality) {
  if (has_exact_corners(quality)) return quality.rms_distance;
  switch (surface.kind) {
    case SurfaceKind::Cylinder:
    case SurfaceKind::Cone:
      return refine_on_planes(surface, facets, quality);
    case SurfaceKind::Sphere:
      return refine_on_inner_corners(surface, facets, quality);
    case SurfaceKind::Torus:  // would take strips of the cylinders that it goes on in
    case SurfaceKind::Plane:
      break;
  }
  return kInfinity;
}

double FacetFitter::refine_on_planes(Surface& surface, std::span<const int> facets,
                                     const FitQuality& quality) {
  std::vector<int> solid;
  std::vector<TangentPlane> planes;
  for (const int f : facets) {
    if (!is_solid(f)) continue;
    const Facet& facet = graph_.facets[f];
    const double sign = surface.gradient(facet.centroid).dot(facet.normal) < 0 ? -1 : 1;
    solid.push_back(f);
    planes.push_back({sign * facet.normal, facet.centroid, facet.area, reach(f)});
  }
  if (solid.size() < 4) return kInfinity;
  const std::optional<InscribedFit> fit = inscribed_fit(surface, planes);
  if (!fit) return kInfinity;
  const double error = fit->rms_distance;
  if (quality.rms_distance < 2 * error || error > 0.1 * quality.sagitta) return error;
  const std::optional<double> turn = regular_turn(solid);
  if (!turn) return kInfinity;
  surface = circumscribed(fit->surface, step_about_axis(fit->surface, *turn));
  return error;
}

double FacetFitter::reach(int facet) const {
  double furthest = 0;
  for (const int v : graph_.corners(facet)) {
    furthest =
        std::max(furthest, (mesh_.vertices[v] - graph_.facets[facet].centroid).squaredNorm());
  }
  return std::sqrt(furthest);
}

std::vector<Vec3> FacetFitter::inner_corners(std::span<const int> facets) {
  const std::vector<int> corners = corner_indices(facets);
  for (const int v : corners) uses_[v] = 0;
  for (const int f : facets) {
    for (const int v : graph_.corners(f)) ++uses_[v];
  }
  std::vector<Vec3> inner;
  for (const int v : corners) {
    if (uses_[v] == graph_.corner_uses(v)) inner.push_back(mesh_.vertices[v]);
  }
  thin_out(inner, kMaxPoints);
  return inner;
}

/// Whether the points leave the surface less room than `limit`: those of a single ring do not.
bool FacetFitter::is_determined(const Surface& s, std::span<const Vec3> points,
                                double limit) const {
  const FitDeviation off = fit_deviation(s, points, tolerance_.eps, false);
  return std::max({off.position, off.radius, off.major_radius}) < limit;
}

double FacetFitter::refine_on_inner_corners(Surface& surface, std::span<const int> facets,
                                            const FitQuality& quality) {
  const std::vector<Vec3> inner = inner_corners(facets);
  const auto parameters = static_cast<std::size_t>(parameter_count(surface.kind));
  if (inner.size() < kPointsPerParameter * parameters) return kInfinity;
  Surface s = surface;
  if (!refine_surface(s, {inner}, {})) return kInfinity;
  if (!is_determined(s, inner, quality.sagitta)) return kInfinity;
  const double error = rms_distance(s, inner);
  // The other corners lie on chords, and those within the surface.
  const FitQuality moved = evaluate(s, facets);
  if (error > kUncutNoise * tolerance_.eps || moved.max_distance > kChordSlack * moved.sagitta) {
    return kInfinity;
  }
  surface = s;
  return error;
}

std::optional<double> FacetFitter::regular_turn(std::span<const int> facets) {
  ++stamp_;
  for (const int f : facets) stamp_of_facet_[f] = stamp_;
  std::vector<double> turns;
  for (const int f : facets) {
    for (const FacetNeighbor& n : graph_.neighbors(f)) {
      if (stamp_of_facet_[n.facet] == stamp_ && n.angle_rad > kMinStep) {
        turns.push_back(n.angle_rad);
      }
    }
  }
  if (turns.size() < 3) return std::nullopt;
  std::sort(turns.begin(), turns.end());
  const double turn = turns[turns.size() / 2];
  const double spread = turns[turns.size() * 3 / 4] - turns[turns.size() / 4];
  if (spread > 0.05 * turn) return std::nullopt;
  return turn;
}

}  // namespace hewn
