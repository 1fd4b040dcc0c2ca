#include "core/segment/facet_fit.h"

#include <algorithm>

#include <Eigen/Eigenvalues>

#include "core/fit/gauss_newton.h"
#include "core/fit/initial_guess.h"

namespace hewn {
namespace {

constexpr std::size_t kMaxPoints = 600;
constexpr std::size_t kMaxNormals = 200;
constexpr double kTinyArea = 1e-9;  // shares of the squared diagonal
constexpr double kSolidArea = 1e-7;
constexpr double kTinyNormalError = 0.15;  // radians
constexpr double kSolidNormalError = 0.02;
constexpr double kMinStep = 0.005;  // radians; facets of one cylinder turn by more

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
      stamp_of_facet_(graph.facets.size(), 0) {}

std::vector<int> FacetFitter::corner_indices(std::span<const int> facets) {
  ++stamp_;
  std::vector<int> indices;
  for (const int f : facets) {
    for (const int v : graph_.corners(f)) {
      if (stamp_of_vertex_[v] != stamp_) indices.push_back(v);
      stamp_of_vertex_[v] = stamp_;
    }
  }
  std::sort(indices.begin(), indices.end());
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
  return refine_surface(surface, {points, {}, normals, centers}, fit);
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
  for (const int f : facets) {
    for (const int v : graph_.corners(f)) {
      const double d = std::abs(field.signed_distance(mesh_.vertices[v]));
      q.max_distance = std::max(q.max_distance, d);
      q.rms_distance += d * d;
      ++count;
    }
    const Facet& facet = graph_.facets[f];
    q.sagitta = std::max(q.sagitta, std::abs(field.signed_distance(facet.centroid)));
    q.max_angle_rad =
        std::max(q.max_angle_rad, unsigned_angle(field.gradient(facet.centroid), facet.normal));
  }
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

double FacetFitter::refine_on_planes(Surface& cylinder, std::span<const int> facets,
                                     const FitQuality& quality) {
  std::vector<int> solid;
  Mat3 moment = Mat3::Zero();
  for (const int f : facets) {
    if (!is_solid(f)) continue;
    solid.push_back(f);
    moment += graph_.facets[f].normal * graph_.facets[f].normal.transpose();
  }
  if (solid.size() < 4) return kInfinity;
  Vec3 axis = Eigen::SelfAdjointEigenSolver<Mat3>(moment).eigenvectors().col(0);
  if (axis.dot(cylinder.axis) < 0) axis = -axis;
  const Tangents t = tangents(axis);
  // Each plane: n . (point + u x + w y) + inscribed radius = n . centroid.
  Mat3 a = Mat3::Zero();
  Vec3 b = Vec3::Zero();
  std::vector<std::pair<Vec3, double>> rows;
  for (const int f : solid) {
    const Facet& facet = graph_.facets[f];
    const double sign = cylinder.gradient(facet.centroid).dot(facet.normal) < 0 ? -1 : 1;
    const Vec3 row(sign * facet.normal.dot(t.u), sign * facet.normal.dot(t.w), 1);
    const double value = sign * facet.normal.dot(facet.centroid - cylinder.point);
    a += row * row.transpose();
    b += row * value;
    rows.emplace_back(row, value);
  }
  const Vec3 x = a.ldlt().solve(b);
  double error = 0;
  for (const auto& [row, value] : rows) error += (row.dot(x) - value) * (row.dot(x) - value);
  error = std::sqrt(error / static_cast<double>(rows.size()));
  if (quality.rms_distance < 2 * error || quality.rms_distance < 0.5 * tolerance_.eps) return error;
  if (error > 0.1 * quality.sagitta) return error;

  ++stamp_;
  for (const int f : solid) stamp_of_facet_[f] = stamp_;
  std::vector<double> steps;
  for (const int f : solid) {
    for (const FacetNeighbor& n : graph_.neighbors(f)) {
      if (stamp_of_facet_[n.facet] == stamp_ && n.angle_rad > kMinStep) {
        steps.push_back(n.angle_rad);
      }
    }
  }
  if (steps.size() < 3) return kInfinity;
  std::sort(steps.begin(), steps.end());
  const double step = steps[steps.size() / 2];
  const double spread = steps[steps.size() * 3 / 4] - steps[steps.size() / 4];
  if (spread > 0.05 * step) return kInfinity;
  cylinder.point += t.u * x[0] + t.w * x[1];
  cylinder.axis = axis;
  cylinder.radius = x[2] / std::cos(step / 2);
  return error;
}

}  // namespace hewn
