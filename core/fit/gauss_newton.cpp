#include "core/fit/gauss_newton.h"

#include <algorithm>
#include <vector>

#include "core/compute/compute.h"
#include "core/compute/fit_batch.h"

namespace hewn {
namespace {

constexpr double kMinConeAngle = 0.02;
constexpr double kMaxConeAngle = 0.985 * kPi / 2;
constexpr double kMinTorusRatio = 0.05;

PlainVec plain(const Vec3& v) { return {v.x(), v.y(), v.z()}; }
Vec3 vec(const double* v) { return {v[0], v[1], v[2]}; }

/// Centres and scales the data, so that all parameters are of order one.
struct Frame {
  Vec3 center = Vec3::Zero();
  double scale = 1;

  explicit Frame(std::span<const Vec3> points) {
    for (const Vec3& p : points) center += p;
    center /= static_cast<double>(points.size());
    double reach2 = 0;
    for (const Vec3& p : points) reach2 = std::max(reach2, (p - center).squaredNorm());
    scale = std::sqrt(reach2);
  }
  Vec3 to_local(const Vec3& p) const { return (p - center) / scale; }
  Surface to_local(Surface s) const {
    s.offset = (s.offset - s.axis.dot(center)) / scale;
    s.point = to_local(s.point);
    s.radius /= scale;
    s.major_radius /= scale;
    // Of the points on its axis, the one that the data are around.
    if (s.kind == SurfaceKind::Cylinder) s.point -= s.axis * s.axis.dot(s.point);
    return s;
  }
  Surface to_world(Surface s) const {
    s.offset = s.offset * scale + s.axis.dot(center);
    s.point = s.point * scale + center;
    s.radius *= scale;
    s.major_radius *= scale;
    return s;
  }
};

/// `guess` with the values of `form`.
Surface with_values(Surface guess, const SurfaceForm& form) {
  const SurfaceForm before = guess.form();
  guess.point = vec(form.point);
  guess.axis = vec(form.axis);
  switch (guess.kind) {
    case SurfaceKind::Plane:
      guess.offset = form.first;
      break;
    case SurfaceKind::Sphere:
    case SurfaceKind::Cylinder:
      guess.radius = form.first;
      break;
    case SurfaceKind::Cone:
      // Way and back, an angle loses a bit.
      if (form.first != before.first || form.second != before.second) {
        guess.half_angle_rad = std::atan2(form.second, form.first);
      }
      break;
    case SurfaceKind::Torus:
      guess.radius = form.first;
      guess.major_radius = form.second;
      break;
  }
  return guess;
}

/// Turns a cone that the fit has turned over; false for surfaces that have degenerated.
bool make_sound(Surface& s) {
  switch (s.kind) {
    case SurfaceKind::Plane:
      return true;
    case SurfaceKind::Sphere:
    case SurfaceKind::Cylinder:
      return s.radius > 0;
    case SurfaceKind::Cone:
      if (s.half_angle_rad < 0) {
        s.half_angle_rad = -s.half_angle_rad;
        s.axis = -s.axis;
      }
      return s.half_angle_rad > kMinConeAngle && s.half_angle_rad < kMaxConeAngle;
    case SurfaceKind::Torus:
      return s.radius > 0 && s.major_radius >= s.radius * kMinTorusRatio;
  }
  return false;
}

bool is_determined(SurfaceKind kind, const FitData& data, const FitSettings& settings) {
  const std::size_t equations =
      data.points.size() + (settings.normal_weight > 0 ? 2 * data.normals.size() : 0);
  return !data.points.empty() && equations >= static_cast<std::size_t>(parameters(kind));
}

/// A fit in its own frame.
class LocalFit {
 public:
  LocalFit(const Surface& guess, const FitData& data, const FitSettings& settings)
      : frame_(data.points), guess_(frame_.to_local(guess)) {
    const bool has_normals = settings.normal_weight > 0;
    points_.reserve(data.points.size() + (has_normals ? data.normals.size() : 0));
    for (const Vec3& p : data.points) points_.push_back(plain(frame_.to_local(p)));
    if (has_normals) {
      for (const Vec3& p : data.normal_points) points_.push_back(plain(frame_.to_local(p)));
      for (const Vec3& n : data.normals) normals_.push_back(plain(n));
    }
    target_.kind = guess.kind;
    target_.max_iterations = settings.max_iterations;
    target_.robust_scale = settings.robust_scale / frame_.scale;
    // Absolute distances fall slowly.
    target_.least_decrease = settings.robust_scale > 0 ? 1e-7 : settings.min_decrease;
    target_.normal_weight2 = settings.normal_weight * settings.normal_weight;
    target_.keeps_axis = settings.keep_axis;
  }

  bool is_possible() const { return frame_.scale > 0; }
  const FitTarget& target() const { return target_; }
  SurfaceForm guess() const { return guess_.form(); }
  FitRows rows() const { return {points_, normals_}; }

  /// Whether the fit, which came to `form`, is one; then `surface` is.
  bool take(const SurfaceForm& form, Surface& surface) const {
    Surface s = with_values(guess_, form);
    if (!make_sound(s)) return false;
    s = frame_.to_world(s);
    if (!s.point.allFinite() || !s.axis.allFinite()) return false;
    surface = s;
    return true;
  }

 private:
  Frame frame_;
  Surface guess_;
  FitTarget target_;
  std::vector<PlainVec> points_, normals_;
};

/// Takes the tilt out of the normal equations.
template <SurfaceKind K, class Square>
void lock_tilt(Square& hessian) {
  if constexpr (first_tilt(K) >= 0) {
    for (int j = first_tilt(K); j < first_tilt(K) + 2; ++j) {
      hessian.row(j).setZero();
      hessian.col(j).setZero();
      hessian(j, j) = 1;
    }
  }
}

template <SurfaceKind K>
FitDeviation deviation(const Surface& surface, std::span<const Vec3> points, double sigma,
                       bool keep_axis) {
  constexpr int kSize = parameters(K);
  const Frame frame(points);
  const RowFrame f = row_frame(frame.to_local(surface).form());
  Eigen::Matrix<double, kSize, kSize> hessian = Eigen::Matrix<double, kSize, kSize>::Zero();
  Eigen::Matrix<double, kSize, 1> row;
  for (const Vec3& p : points) {
    distance_row<K>(f, plain(frame.to_local(p)), row.data());
    hessian += row * row.transpose();
  }
  if (keep_axis) lock_tilt<K>(hessian);
  hessian.diagonal().array() += 1e-14 * hessian.diagonal().maxCoeff();
  const Eigen::Matrix<double, kSize, 1> variance =
      hessian.inverse().diagonal().cwiseMax(0) * (sigma / frame.scale) * (sigma / frame.scale);
  FitDeviation d;
  const int tilt = first_tilt(K);
  if (!keep_axis && tilt >= 0) d.axis_rad = std::sqrt(variance[tilt] + variance[tilt + 1]);
  const int moves = K == SurfaceKind::Plane ? 0 : K == SurfaceKind::Cylinder ? 2 : 3;
  d.position = std::sqrt(variance.head(moves).sum()) * frame.scale;
  const double last = std::sqrt(variance[kSize - 1]);
  const double before_last = std::sqrt(variance[kSize - 2]);
  if (K == SurfaceKind::Plane) d.offset = last * frame.scale;
  if (K == SurfaceKind::Sphere || K == SurfaceKind::Cylinder) d.radius = last * frame.scale;
  if (K == SurfaceKind::Cone) d.half_angle_rad = last;
  if (K == SurfaceKind::Torus) {
    d.radius = before_last * frame.scale;
    d.major_radius = last * frame.scale;
  }
  return d;
}

}  // namespace

FitDeviation fit_deviation(const Surface& surface, std::span<const Vec3> points, double sigma,
                           bool keep_axis) {
  switch (surface.kind) {
    case SurfaceKind::Plane:
      return deviation<SurfaceKind::Plane>(surface, points, sigma, keep_axis);
    case SurfaceKind::Sphere:
      return deviation<SurfaceKind::Sphere>(surface, points, sigma, keep_axis);
    case SurfaceKind::Cylinder:
      return deviation<SurfaceKind::Cylinder>(surface, points, sigma, keep_axis);
    case SurfaceKind::Cone:
      return deviation<SurfaceKind::Cone>(surface, points, sigma, keep_axis);
    case SurfaceKind::Torus:
      return deviation<SurfaceKind::Torus>(surface, points, sigma, keep_axis);
  }
  return {};
}

bool refine_surface(Surface& surface, const FitData& data, const FitSettings& settings) {
  if (!is_determined(surface.kind, data, settings)) return false;
  const LocalFit fit(surface, data, settings);
  return fit.is_possible() && fit.take(fit_alone(fit.target(), fit.guess(), fit.rows()), surface);
}

Result<void> refine_surfaces(std::span<FitTask> tasks, const RunContext& run) {
  FitBatch batch;
  std::vector<LocalFit> fits;
  std::vector<FitTask*> owners;
  for (FitTask& task : tasks) {
    task.is_fitted = false;
    if (!is_determined(task.surface.kind, task.data, task.settings)) continue;
    LocalFit fit(task.surface, task.data, task.settings);
    if (!fit.is_possible()) continue;
    batch.add(fit.target(), fit.guess(), fit.rows());
    fits.push_back(std::move(fit));
    owners.push_back(&task);
  }
  const auto solve = [&](Device& device) { return batch.solve(device, run); };
  Result<void> done = compute_of(run)->run(batch.seconds(), run, solve);
  if (!done) return done;
  for (std::size_t i = 0; i < fits.size(); ++i) {
    owners[i]->is_fitted = fits[i].take(batch.surface(i), owners[i]->surface);
  }
  return {};
}

double rms_distance(const Surface& surface, std::span<const Vec3> points) {
  if (points.empty()) return 0;
  double sum = 0;
  const SurfaceField field(surface);
  for (const Vec3& p : points) {
    const double d = field.signed_distance(p);
    sum += d * d;
  }
  return std::sqrt(sum / static_cast<double>(points.size()));
}

}  // namespace hewn
