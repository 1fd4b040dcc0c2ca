#include "core/segment/curvature/fit_primitive.h"

#include <algorithm>
#include <iterator>
#include <vector>

#include <Eigen/Eigenvalues>

#include "core/fit/gauss_newton.h"
#include "core/fit/initial_guess.h"
#include "core/segment/measure_group.h"

namespace hewn {
namespace {

constexpr std::size_t kMaxFitTriangles = 400;
constexpr std::size_t kMaxFitPoints = 1500;
/// Cylinders are told from cones by normals that lean from the perpendicular by less.
constexpr double kCylinderLeanRad = 0.01;
/// A triangle this small (of the diagonal squared) has no normal to speak of.
constexpr double kSliverArea = 1e-9;
/// Larger curved surfaces, in diagonals, are planes.
constexpr double kMaxRadius = 5;
/// Vertices within this share of the diagonal lie exactly on their surface.
constexpr double kExactRms = 1e-5;
constexpr double kTrimmedDepths = 2;
/// A torus has more parameters than any other kind, so it has to be this much closer.
constexpr double kTorusGain = 0.3;

/// At most `limit` items, evenly picked.
template <class T>
std::vector<T> thinned(std::vector<T> items, std::size_t limit) {
  if (items.size() <= limit) return items;
  std::vector<T> kept;
  kept.reserve(limit);
  for (std::size_t i = 0; i < limit; ++i) kept.push_back(items[i * items.size() / limit]);
  return kept;
}

struct Samples {
  std::vector<Vec3> points, normals, centers;
};

Samples samples_of(const Mesh& mesh, std::span<const int> triangles) {
  Samples samples;
  const std::vector<int> all(triangles.begin(), triangles.end());
  for (const int v : thinned(vertices_of(mesh, all), kMaxFitPoints)) {
    samples.points.push_back(mesh.vertices[v]);
  }
  const double sliver = kSliverArea * mesh.diagonal() * mesh.diagonal();
  std::vector<int> solid;
  for (const int t : all) {
    if (mesh.areas[t] > sliver) solid.push_back(t);
  }
  for (const int t : thinned(std::move(solid), kMaxFitTriangles)) {
    samples.normals.push_back(mesh.normals[t]);
    samples.centers.push_back(mesh.centroid(t));
  }
  return samples;
}

double unsigned_angle(const Vec3& a, const Vec3& b) {
  const double angle = angle_between(a, b);
  return std::min(angle, kPi - angle);
}

bool keeps_limits(const Mesh& mesh, std::span<const int> triangles, const Surface& surface,
                  const FitLimits& limits) {
  double area = 0;
  double angle = 0;
  for (const int t : triangles) {
    for (int k = 0; k < 3; ++k) {
      if (!(std::abs(surface.signed_distance(mesh.corner(t, k))) <= limits.distance)) return false;
    }
    area += mesh.areas[t];
    angle += mesh.areas[t] * unsigned_angle(surface.gradient(mesh.centroid(t)), mesh.normals[t]);
  }
  return angle <= limits.angle_rad * area;
}

/// For triangles that lie in one plane although their curvature says otherwise.
FitLimits flat_limits(const FitLimits& limits) {
  return {limits.diagonal, kExactRms * limits.diagonal, limits.angle_rad * 0.1};
}

bool are_normals_across_an_axis(const std::vector<Vec3>& normals) {
  Mat3 moment = Mat3::Zero();
  for (const Vec3& n : normals) moment += n * n.transpose();
  const Vec3 axis = Eigen::SelfAdjointEigenSolver<Mat3>(moment).eigenvectors().col(0);
  return std::all_of(normals.begin(), normals.end(),
                     [&](const Vec3& n) { return std::abs(n.dot(axis)) < kCylinderLeanRad; });
}

/// Kinds to try in turn until one fits.
std::vector<SurfaceKind> kinds_for(CurvatureClass curvature, const Samples& samples) {
  switch (curvature) {
    case CurvatureClass::Spherical:
    case CurvatureClass::SphericalInverted:
      return {SurfaceKind::Sphere};
    case CurvatureClass::Conic:
    case CurvatureClass::ConicInverted:
      // With few or noisy triangles the test errs, so the other kind follows.
      if (are_normals_across_an_axis(samples.normals)) {
        return {SurfaceKind::Cylinder, SurfaceKind::Cone};
      }
      return {SurfaceKind::Cone, SurfaceKind::Cylinder};
    case CurvatureClass::Planar:
      return {};
    case CurvatureClass::Other:
    case CurvatureClass::None:
      break;
  }
  return {SurfaceKind::Cylinder, SurfaceKind::Cone, SurfaceKind::Sphere};
}

/// The primitive of one set of triangles, found kind by kind: whoever asks refines the guesses.
class PrimitiveSearch {
 public:
  PrimitiveSearch(const Mesh& mesh, std::span<const int> triangles, CurvatureClass curvature,
                  const FitLimits& limits)
      : mesh_(&mesh), triangles_(triangles), limits_(limits) {
    const Surface plane = mean_plane(mesh, triangles);
    const bool wants_plane = curvature == CurvatureClass::Planar;
    const bool is_plane = (wants_plane && keeps_limits(mesh, triangles, plane, limits)) ||
                          is_flat(mesh, triangles, limits);
    if (is_plane) best_ = plane;
    if (is_plane || wants_plane) return;
    samples_ = samples_of(mesh, triangles);
    if (samples_.normals.size() < 2 || samples_.points.size() < 4) return;
    all_guesses_ =
        guess_surfaces({samples_.points, samples_.normals, samples_.centers}, limits.diagonal);
    kinds_ = kinds_for(curvature, samples_);
    kinds_.push_back(SurfaceKind::Torus);
  }

  /// Goes on to the next kind that is worth a try; false: there is none, and `result` stands.
  bool begin_next_kind() {
    guesses_.clear();
    while (guesses_.empty() && next_ < kinds_.size()) {
      const SurfaceKind kind = kinds_[next_++];
      if (!is_wanted(kind)) continue;
      std::copy_if(all_guesses_.begin(), all_guesses_.end(), std::back_inserter(guesses_),
                   [kind](const Surface& guess) { return guess.kind == kind; });
    }
    return !guesses_.empty();
  }
  const std::vector<Surface>& guesses() const { return guesses_; }
  std::span<const Vec3> points() const { return samples_.points; }

  /// Offers a refined guess; true: it will do, and the others of its kind are not needed.
  bool take(const Surface& refined) {
    if (refined.radius > limits_.diagonal * kMaxRadius) return false;
    if (!keeps_limits(*mesh_, triangles_, refined, limits_)) return false;
    const bool is_rival = refined.kind == SurfaceKind::Torus;
    if (!is_rival || rms_distance(refined, samples_.points) < kTorusGain * rms_of_best()) {
      best_ = refined;
    }
    return true;
  }
  const std::optional<Surface>& result() const { return best_; }

 private:
  double rms_of_best() const { return best_ ? rms_distance(*best_, samples_.points) : kInfinity; }

  /// A surface is determined only by more vertices than it has parameters. Once one fits, no other
  /// is tried, but a torus beside one that is not exact.
  bool is_wanted(SurfaceKind kind) const {
    if (static_cast<int>(samples_.points.size()) <= parameter_count(kind)) return false;
    if (kind != SurfaceKind::Torus) return !best_;
    return rms_of_best() > kExactRms * limits_.diagonal;
  }

  const Mesh* mesh_;
  std::span<const int> triangles_;
  FitLimits limits_;
  Samples samples_;
  std::vector<Surface> all_guesses_, guesses_;
  std::vector<SurfaceKind> kinds_;
  std::size_t next_ = 0;  ///< of the kinds
  std::optional<Surface> best_;
};

}  // namespace

FitLimits fit_limits(const Mesh& mesh, const CurvatureOptions& options) {
  return {mesh.diagonal(), options.fit_distance * mesh.diagonal(),
          options.fit_normal_deg * kPi / 180};
}

bool is_flat(const Mesh& mesh, std::span<const int> triangles, const FitLimits& limits) {
  return keeps_limits(mesh, triangles, mean_plane(mesh, triangles), flat_limits(limits));
}

Surface mean_plane(const Mesh& mesh, std::span<const int> triangles) {
  Vec3 normal = Vec3::Zero();
  for (const int t : triangles) normal += mesh.areas[t] * mesh.normals[t];
  const std::vector<int> all(triangles.begin(), triangles.end());
  Vec3 mean = Vec3::Zero();
  const std::vector<int> vertices = vertices_of(mesh, all);
  for (const int v : vertices) mean += mesh.vertices[v] / static_cast<double>(vertices.size());
  Surface plane;
  plane.axis = normal.norm() > 0 ? Vec3(normal.normalized()) : Vec3(Vec3::UnitZ());
  plane.offset = plane.axis.dot(mean);
  return plane;
}

std::optional<Surface> fit_primitive(const Mesh& mesh, std::span<const int> triangles,
                                     CurvatureClass curvature, const FitLimits& limits) {
  PrimitiveSearch search(mesh, triangles, curvature, limits);
  while (search.begin_next_kind()) {
    for (Surface guess : search.guesses()) {
      if (refine_surface(guess, {.points = search.points()}) && search.take(guess)) break;
    }
  }
  return search.result();
}

Result<std::vector<std::optional<Surface>>> fit_primitives(const Mesh& mesh,
                                                           std::span<const FitRegion> regions,
                                                           const FitLimits& limits,
                                                           const RunContext& run) {
  std::vector<PrimitiveSearch> searches;
  searches.reserve(regions.size());
  for (const FitRegion& region : regions) {
    if (run.is_cancelled()) return RunContext::cancelled();
    searches.emplace_back(mesh, region.triangles, region.curvature, limits);
  }
  std::vector<PrimitiveSearch*> open;
  for (PrimitiveSearch& search : searches) open.push_back(&search);
  for (;;) {
    std::erase_if(open, [](PrimitiveSearch* search) { return !search->begin_next_kind(); });
    if (open.empty()) break;
    std::vector<FitTask> tasks;
    for (const PrimitiveSearch* search : open) {
      for (const Surface& guess : search->guesses()) {
        tasks.push_back({guess, {.points = search->points()}});
      }
    }
    Result<void> done = refine_surfaces(tasks, run);
    if (!done) return done.error();
    auto task = tasks.cbegin();
    for (PrimitiveSearch* search : open) {
      const auto end = task + static_cast<std::ptrdiff_t>(search->guesses().size());
      while (task != end && !(task->is_fitted && search->take(task->surface))) ++task;
      task = end;
    }
  }
  std::vector<std::optional<Surface>> results;
  for (const PrimitiveSearch& search : searches) results.push_back(search.result());
  return results;
}

double rms_of(const Mesh& mesh, std::span<const int> triangles, const Surface& surface) {
  const std::vector<int> all(triangles.begin(), triangles.end());
  double sum = 0;
  const std::vector<int> vertices = vertices_of(mesh, all);
  for (const int v : vertices) {
    const double distance = surface.signed_distance(mesh.vertices[v]);
    sum += distance * distance;
  }
  return vertices.empty() ? 0 : std::sqrt(sum / static_cast<double>(vertices.size()));
}

double misfit(const Mesh& mesh, int triangle, const Surface& surface, const FitLimits& limits) {
  double distance = 0;
  for (int k = 0; k < 3; ++k) {
    distance = std::max(distance, std::abs(surface.signed_distance(mesh.corner(triangle, k))));
  }
  const Vec3 gradient = surface.gradient(mesh.centroid(triangle));
  return distance / limits.distance +
         unsigned_angle(gradient, mesh.normals[triangle]) / limits.angle_rad;
}

bool is_exact(double rms, const FitLimits& limits) { return rms <= kExactRms * limits.diagonal; }

FitLimits trimmed_limits(const Mesh& mesh, std::span<const int> triangles, const Surface& surface,
                         const FitLimits& limits) {
  FitLimits trimmed = limits;
  if (surface.kind == SurfaceKind::Plane) return trimmed;
  double depth = 0;
  for (const int t : triangles) {
    depth = std::max(depth, std::abs(surface.signed_distance(mesh.centroid(t))));
  }
  trimmed.distance = std::max(limits.distance, kTrimmedDepths * depth);
  return trimmed;
}

void refit(const Mesh& mesh, std::span<const int> triangles, Surface& surface) {
  std::vector<Vec3> points = samples_of(mesh, triangles).points;
  std::vector<Vec3> exact;
  const double tolerance = 3 * kExactRms * mesh.diagonal();
  for (const Vec3& p : points) {
    if (std::abs(surface.signed_distance(p)) <= tolerance) exact.push_back(p);
  }
  const std::size_t enough = std::max<std::size_t>(
      2 * static_cast<std::size_t>(parameter_count(surface.kind)), points.size() / 4);
  if (exact.size() >= enough) points = std::move(exact);
  Surface fitted = surface;
  FitSettings settings;
  settings.max_iterations = 20;
  settings.min_decrease = 1e-9;
  if (!refine_surface(fitted, {.points = points}, settings)) return;
  if (fitted.radius > mesh.diagonal() * kMaxRadius) return;
  if (rms_distance(fitted, points) < rms_distance(surface, points)) surface = fitted;
}

}  // namespace hewn
