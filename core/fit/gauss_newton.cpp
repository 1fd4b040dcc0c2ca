#include "core/fit/gauss_newton.h"

#include <algorithm>
#include <vector>

namespace hewn {
namespace {

// Parameters of each kind, in this order; the axis tilts within its tangent plane (u, w):
//   plane    tilt u, tilt w, offset
//   sphere   centre xyz, radius
//   cylinder axis point u, axis point w, tilt u, tilt w, radius
//   cone     apex xyz, tilt u, tilt w, half angle
//   torus    centre xyz, tilt u, tilt w, tube radius, major radius
constexpr double kMinConeAngle = 0.02;
constexpr double kMaxConeAngle = 0.985 * kPi / 2;
constexpr double kMinTorusRatio = 0.05;

constexpr int parameters(SurfaceKind kind) {
  switch (kind) {
    case SurfaceKind::Plane:
      return 3;
    case SurfaceKind::Sphere:
      return 4;
    case SurfaceKind::Cylinder:
      return 5;
    case SurfaceKind::Cone:
      return 6;
    case SurfaceKind::Torus:
      return 7;
  }
  return 0;
}

/// A point in the surface's own frame.
struct LocalPoint {
  Vec3 d;         // from the surface's point
  double height;  // along the axis
  double radial;  // from the axis
  Vec3 outward;   // unit, from the axis
};

LocalPoint localise(const Surface& s, const Vec3& x) {
  LocalPoint p;
  p.d = x - s.point;
  p.height = s.axis.dot(p.d);
  const Vec3 q = p.d - s.axis * p.height;
  p.radial = q.norm();
  p.outward = p.radial > 1e-14 ? Vec3(q / p.radial) : tangents(s.axis).u;
  return p;
}

/// Distance and its derivatives by the parameters.
template <SurfaceKind K>
double distance_row(const Surface& s, const Tangents& f, const Vec3& x,
                    Eigen::Matrix<double, parameters(K), 1>& row) {
  if constexpr (K == SurfaceKind::Plane) {
    row << f.u.dot(x), f.w.dot(x), -1;
    return s.axis.dot(x) - s.offset;
  } else if constexpr (K == SurfaceKind::Sphere) {
    const Vec3 d = x - s.point;
    const double length = d.norm();
    row << -d / std::max(length, 1e-14), -1;
    return length - s.radius;
  } else {
    const LocalPoint p = localise(s, x);
    const double eu = p.outward.dot(f.u);
    const double ew = p.outward.dot(f.w);
    if constexpr (K == SurfaceKind::Cylinder) {
      row << -eu, -ew, -p.height * eu, -p.height * ew, -1;
      return p.radial - s.radius;
    } else if constexpr (K == SurfaceKind::Cone) {
      const double c = std::cos(s.half_angle_rad);
      const double n = std::sin(s.half_angle_rad);
      const double along = p.height * c + p.radial * n;
      row << -(p.outward * c - s.axis * n), -eu * along, -ew * along, -along;
      return p.radial * c - p.height * n;
    } else {
      const double dr = p.radial - s.major_radius;
      const double tube = std::max(std::hypot(dr, p.height), 1e-14);
      const double tilt = p.height * s.major_radius / tube;
      row << -(p.outward * dr + s.axis * p.height) / tube, tilt * eu, tilt * ew, -1, -dr / tube;
      return tube - s.radius;
    }
  }
}

/// A direction in parameter space, as changes of the surface's own values.
struct Variation {
  Vec3 point = Vec3::Zero(), axis = Vec3::Zero();
  double angle = 0, major = 0;
};

template <SurfaceKind K>
Variation variation(const Tangents& f, int j) {
  Variation v;
  if constexpr (K == SurfaceKind::Plane) {
    if (j < 2) v.axis = j == 0 ? f.u : f.w;
  } else if constexpr (K == SurfaceKind::Sphere) {
    if (j < 3) v.point = Vec3::Unit(j);
  } else if constexpr (K == SurfaceKind::Cylinder) {
    if (j < 2) v.point = j == 0 ? f.u : f.w;
    if (j == 2 || j == 3) v.axis = j == 2 ? f.u : f.w;
  } else {
    if (j < 3) v.point = Vec3::Unit(j);
    if (j == 3 || j == 4) v.axis = j == 3 ? f.u : f.w;
    if (j == 5 && K == SurfaceKind::Cone) v.angle = 1;
    if (j == 6) v.major = 1;
  }
  return v;
}

/// Change of the surface's gradient at `x` under a variation.
template <SurfaceKind K>
Vec3 gradient_change(const Surface& s, const LocalPoint& p, const Vec3& gradient,
                     const Variation& v) {
  if constexpr (K == SurfaceKind::Plane) return v.axis;
  if constexpr (K == SurfaceKind::Sphere) {
    return -(v.point - gradient * gradient.dot(v.point)) / std::max(p.d.norm(), 1e-14);
  }
  const Vec3 t = s.axis.cross(p.outward);
  const double radial = std::max(p.radial, 1e-14);
  const double dh = v.axis.dot(p.d) - s.axis.dot(v.point);
  const double dradial = -p.outward.dot(v.point) - p.height * p.outward.dot(v.axis);
  const Vec3 de =
      -t * (t.dot(v.point) + p.height * t.dot(v.axis)) / radial - s.axis * p.outward.dot(v.axis);
  if constexpr (K == SurfaceKind::Cylinder) return de;
  if constexpr (K == SurfaceKind::Cone) {
    const double c = std::cos(s.half_angle_rad);
    const double n = std::sin(s.half_angle_rad);
    return de * c - v.axis * n - (p.outward * n + s.axis * c) * v.angle;
  }
  const double dr = p.radial - s.major_radius;
  const double tube2 = std::max(dr * dr + p.height * p.height, 1e-28);
  const double tube = std::sqrt(tube2);
  const double c = dr / tube;
  const double n = p.height / tube;
  const double turn = (dh * dr - p.height * (dradial - v.major)) / tube2;
  return de * c + v.axis * n + (s.axis * c - p.outward * n) * turn;
}

/// The axis after a tilt; unchanged to the bit by no tilt.
Vec3 tilted(const Vec3& axis, const Tangents& f, double u, double w) {
  return u == 0 && w == 0 ? axis : Vec3((axis + f.u * u + f.w * w).normalized());
}

template <SurfaceKind K>
Surface stepped(const Surface& s, const Tangents& f,
                const Eigen::Matrix<double, parameters(K), 1>& x) {
  Surface r = s;
  if constexpr (K == SurfaceKind::Plane) {
    r.axis = tilted(s.axis, f, x[0], x[1]);
    r.offset += x[2];
  } else if constexpr (K == SurfaceKind::Sphere) {
    r.point += Vec3(x[0], x[1], x[2]);
    r.radius += x[3];
  } else if constexpr (K == SurfaceKind::Cylinder) {
    r.point += f.u * x[0] + f.w * x[1];
    r.axis = tilted(s.axis, f, x[2], x[3]);
    r.point -= r.axis * r.axis.dot(r.point);  // the point nearest to the data's centre
    r.radius += x[4];
  } else {
    r.point += Vec3(x[0], x[1], x[2]);
    r.axis = tilted(s.axis, f, x[3], x[4]);
    if constexpr (K == SurfaceKind::Cone) r.half_angle_rad += x[5];
    if constexpr (K == SurfaceKind::Torus) {
      r.radius += x[5];
      r.major_radius += x[6];
    }
  }
  return r;
}

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

/// Index of the first tilt parameter; the second follows. -1 for spheres.
constexpr int first_tilt(SurfaceKind kind) {
  switch (kind) {
    case SurfaceKind::Plane:
      return 0;
    case SurfaceKind::Sphere:
      return -1;
    case SurfaceKind::Cylinder:
      return 2;
    default:
      return 3;
  }
}

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
    for (std::size_t i = 0; i < points_.size(); ++i) {
      weights_[i] = given_.empty() ? 1.0 : given_[i];
      if (robust_scale_ <= 0) continue;
      weights_[i] *=
          robust_scale_ / std::max(std::abs(s.signed_distance(points_[i])), robust_scale_);
    }
  }

  void assemble(const Surface& s) {
    frame_ = tangents(s.axis);
    hessian_.setZero();
    slope_.setZero();
    cost_ = 0;
    Row row;
    for (std::size_t i = 0; i < points_.size(); ++i) {
      const double r = distance_row<K>(s, frame_, points_[i], row);
      hessian_.template selfadjointView<Eigen::Lower>().rankUpdate(row, weights_[i]);
      slope_ += row * (weights_[i] * r);
      cost_ += weights_[i] * r * r;
    }
    hessian_ = hessian_.template selfadjointView<Eigen::Lower>();
    if (!normals_.empty()) assemble_normals(s);
    if (settings_.keep_axis && first_tilt(K) >= 0) {
      lock_tilt<K>(hessian_);
      slope_.template segment<2>(std::max(0, first_tilt(K))).setZero();
    }
  }

  void assemble_normals(const Surface& s) {
    Variation variations[kSize];
    for (int j = 0; j < kSize; ++j) variations[j] = variation<K>(frame_, j);
    const double w2 = settings_.normal_weight * settings_.normal_weight;
    Eigen::Matrix<double, 3, kSize> block;
    for (std::size_t i = 0; i < normals_.size(); ++i) {
      const Vec3 g = s.gradient(normal_points_[i]);
      const LocalPoint p = localise(s, normal_points_[i]);
      for (int j = 0; j < kSize; ++j) {
        block.col(j) = gradient_change<K>(s, p, g, variations[j]);
      }
      const Vec3 r = g - (g.dot(normals_[i]) < 0 ? -1.0 : 1.0) * normals_[i];
      hessian_ += w2 * block.transpose() * block;
      slope_ += w2 * block.transpose() * r;
      cost_ += w2 * r.squaredNorm();
    }
  }

  double cost_of(const Surface& s) const {
    double cost = 0;
    for (std::size_t i = 0; i < points_.size(); ++i) {
      const double r = s.signed_distance(points_[i]);
      cost += weights_[i] * r * r;
    }
    const double w2 = settings_.normal_weight * settings_.normal_weight;
    for (std::size_t i = 0; i < normals_.size(); ++i) {
      const Vec3 g = s.gradient(normal_points_[i]);
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
  const Tangents f = tangents(s.axis);
  Eigen::Matrix<double, kSize, kSize> hessian = Eigen::Matrix<double, kSize, kSize>::Zero();
  Eigen::Matrix<double, kSize, 1> row;
  for (const Vec3& p : points) {
    distance_row<K>(s, f, frame.to_local(p), row);
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
  for (const Vec3& p : points) {
    const double d = surface.signed_distance(p);
    sum += d * d;
  }
  return std::sqrt(sum / static_cast<double>(points.size()));
}

}  // namespace hewn
