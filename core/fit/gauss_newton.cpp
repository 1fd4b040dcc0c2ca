#include "core/fit/gauss_newton.h"

#include <algorithm>
#include <vector>

#include "core/fit/surface_rows.h"

namespace hewn {
namespace {

constexpr double kMinConeAngle = 0.02;
constexpr double kMaxConeAngle = 0.985 * kPi / 2;
constexpr double kMinTorusRatio = 0.05;

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
class Refiner {
 public:
  static constexpr int kSize = parameters(K);
  using Row = Eigen::Matrix<double, kSize, 1>;
  using Square = Eigen::Matrix<double, kSize, kSize>;

  Refiner(const Frame& frame, const FitData& data, const FitSettings& settings)
      : settings_(settings), given_(data.weights), normals_(data.normals) {
    points_.reserve(data.points.size());
    for (const Vec3& p : data.points) points_.push_back(frame.to_local(p));
    if (settings.normal_weight <= 0) normals_ = {};
    for (std::size_t i = 0; i < normals_.size(); ++i) {
      normal_points_.push_back(frame.to_local(data.normal_points[i]));
    }
    robust_scale_ = settings.robust_scale / frame.scale;
    weights_.assign(points_.size(), 1.0);
    std::copy(given_.begin(), given_.end(), weights_.begin());
  }

  bool run(Surface& s) {
    if (K == SurfaceKind::Cylinder) s.point -= s.axis * s.axis.dot(s.point);
    double damping = 1e-6;
    for (int iteration = 0; iteration < settings_.max_iterations; ++iteration) {
      update_weights(s);
      assemble(s);
      const double before = cost_;
      if (before <= 1e-32) break;
      if (!take_step(s, damping)) break;
      const double decrease = (before - cost_) / before;
      if (decrease < (robust_scale_ > 0 ? 1e-7 : settings_.min_decrease)) break;
    }
    return is_sound(s);
  }

 private:
  void update_weights(const Surface& s) {
    if (robust_scale_ <= 0) return;
    const SurfaceField field(s);
    for (std::size_t i = 0; i < points_.size(); ++i) {
      weights_[i] = given_.empty() ? 1.0 : given_[i];
      weights_[i] *=
          robust_scale_ / std::max(std::abs(field.signed_distance<K>(points_[i])), robust_scale_);
    }
  }

  void assemble(const Surface& s) {
    const RowFrame frame(s);
    frame_ = frame.tilt;
    hessian_.setZero();
    slope_.setZero();
    cost_ = 0;
    Row row;
    for (std::size_t i = 0; i < points_.size(); ++i) {
      const double r = distance_row<K>(frame, points_[i], row);
      add_square(row, weights_[i]);
      slope_ += row * (weights_[i] * r);
      cost_ += weights_[i] * r * r;
    }
    hessian_ = hessian_.template selfadjointView<Eigen::Lower>();
    if (!normals_.empty()) assemble_normals(frame);
    if (settings_.keep_axis && first_tilt(K) >= 0) {
      lock_tilt<K>(hessian_);
      slope_.template segment<2>(std::max(0, first_tilt(K))).setZero();
    }
  }

  /// Adds weight row row^T to the lower half. In full sight of the compiler, unlike Eigen's own.
  void add_square(const Row& row, double weight) {
    for (int j = 0; j < kSize; ++j) {
      const double factor = weight * row[j];
      for (int i = j; i < kSize; ++i) hessian_(i, j) += factor * row[i];
    }
  }

  void assemble_normals(const RowFrame& frame) {
    const SurfaceField field(frame.surface);
    Variation variations[kSize];
    for (int j = 0; j < kSize; ++j) variations[j] = variation<K>(frame_, j);
    const double w2 = settings_.normal_weight * settings_.normal_weight;
    Eigen::Matrix<double, 3, kSize> block;
    for (std::size_t i = 0; i < normals_.size(); ++i) {
      const Vec3 g = field.gradient(normal_points_[i]);
      const LocalPoint p = localise(frame.surface, normal_points_[i]);
      for (int j = 0; j < kSize; ++j) {
        block.col(j) = gradient_change<K>(frame, p, g, variations[j]);
      }
      const Vec3 r = g - (g.dot(normals_[i]) < 0 ? -1.0 : 1.0) * normals_[i];
      hessian_ += w2 * block.transpose() * block;
      slope_ += w2 * block.transpose() * r;
      cost_ += w2 * r.squaredNorm();
    }
  }

  double cost_of(const Surface& s) const {
    double cost = 0;
    const SurfaceField field(s);
    for (std::size_t i = 0; i < points_.size(); ++i) {
      const double r = field.signed_distance<K>(points_[i]);
      cost += weights_[i] * r * r;
    }
    const double w2 = settings_.normal_weight * settings_.normal_weight;
    for (std::size_t i = 0; i < normals_.size(); ++i) {
      const Vec3 g = field.gradient(normal_points_[i]);
      cost += w2 * (g - (g.dot(normals_[i]) < 0 ? -1.0 : 1.0) * normals_[i]).squaredNorm();
    }
    return cost;
  }

  /// Tries the damped step, damping harder until the cost falls.
  bool take_step(Surface& s, double& damping) {
    for (int attempt = 0; attempt < 6; ++attempt) {
      Square damped = hessian_;
      damped.diagonal() *= 1 + damping;
      damped.diagonal().array() += 1e-14 * hessian_.diagonal().maxCoeff();
      const Row step = damped.ldlt().solve(-slope_);
      if (!step.allFinite()) return false;
      const Surface candidate = stepped<K>(s, frame_, step);
      const double cost = cost_of(candidate);
      if (cost < cost_) {
        s = candidate;
        cost_ = cost;
        damping = std::max(1e-12, damping / 10);
        return true;
      }
      damping = std::max(damping * 10, 1e-4);
    }
    return false;
  }

  static bool is_sound(Surface& s) {
    if constexpr (K == SurfaceKind::Plane) return true;
    if constexpr (K == SurfaceKind::Cone) {
      if (s.half_angle_rad < 0) {
        s.half_angle_rad = -s.half_angle_rad;
        s.axis = -s.axis;
      }
      return s.half_angle_rad > kMinConeAngle && s.half_angle_rad < kMaxConeAngle;
    }
    if constexpr (K == SurfaceKind::Torus) {
      if (s.major_radius < s.radius * kMinTorusRatio) return false;
    }
    return s.radius > 0;
  }

  FitSettings settings_;
  std::span<const double> given_;
  std::span<const Vec3> normals_;
  std::vector<Vec3> points_, normal_points_;
  std::vector<double> weights_;
  double robust_scale_ = 0;
  Tangents frame_;
  Square hessian_;
  Row slope_;
  double cost_ = 0;
};

template <SurfaceKind K>
bool refine(Surface& surface, const FitData& data, const FitSettings& settings) {
  const Frame frame(data.points);
  if (!(frame.scale > 0)) return false;
  Surface s = frame.to_local(surface);
  if (!Refiner<K>(frame, data, settings).run(s)) return false;
  s = frame.to_world(s);
  if (!s.point.allFinite() || !s.axis.allFinite()) return false;
  surface = s;
  return true;
}

template <SurfaceKind K>
FitDeviation deviation(const Surface& surface, std::span<const Vec3> points, double sigma,
                       bool keep_axis) {
  constexpr int kSize = parameters(K);
  const Frame frame(points);
  Surface s = frame.to_local(surface);
  if (K == SurfaceKind::Cylinder) s.point -= s.axis * s.axis.dot(s.point);
  const RowFrame f(s);
  Eigen::Matrix<double, kSize, kSize> hessian = Eigen::Matrix<double, kSize, kSize>::Zero();
  Eigen::Matrix<double, kSize, 1> row;
  for (const Vec3& p : points) {
    distance_row<K>(f, frame.to_local(p), row);
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
  const std::size_t equations =
      data.points.size() + (settings.normal_weight > 0 ? 2 * data.normals.size() : 0);
  if (data.points.empty() || equations < static_cast<std::size_t>(parameter_count(surface.kind))) {
    return false;
  }
  switch (surface.kind) {
    case SurfaceKind::Plane:
      return refine<SurfaceKind::Plane>(surface, data, settings);
    case SurfaceKind::Sphere:
      return refine<SurfaceKind::Sphere>(surface, data, settings);
    case SurfaceKind::Cylinder:
      return refine<SurfaceKind::Cylinder>(surface, data, settings);
    case SurfaceKind::Cone:
      return refine<SurfaceKind::Cone>(surface, data, settings);
    case SurfaceKind::Torus:
      return refine<SurfaceKind::Torus>(surface, data, settings);
  }
  return false;
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
