#include "core/fit/initial_guess.h"

#include <algorithm>
#include <optional>

#include <Eigen/Eigenvalues>

namespace hewn {
namespace {

constexpr double kMinRadius = 1e-5;  // shares of the mesh's diagonal
constexpr double kMaxRadius = 5;
constexpr std::size_t kMinSphereFacets = 5;
constexpr std::size_t kMinTorusFacets = 7;

struct Circle {
  Vec2 center;
  double radius;
};

/// Algebraic least-squares circle (Kasa) of 2D points given by `at`.
template <class At>
Circle fit_circle(std::span<const Vec3> points, const At& at) {
  Mat3 a = Mat3::Zero();
  Vec3 b = Vec3::Zero();
  for (const Vec3& p : points) {
    const Vec2 q = at(p);
    const Vec3 row(q.x(), q.y(), 1);
    a += row * row.transpose();
    b += row * q.squaredNorm();
  }
  const Vec3 x = a.ldlt().solve(b);
  const Vec2 center = x.head<2>() / 2;
  return {center, std::sqrt(std::max(0.0, x[2] + center.squaredNorm()))};
}

bool is_plausible(double radius, double size) {
  return radius > kMinRadius * size && radius < kMaxRadius * size;
}

struct PatchFrame {
  Vec3 center = Vec3::Zero();
  double scale = 0;
  Mat3 normal_moment = Mat3::Zero();
  Vec3 mean_normal = Vec3::Zero();
};

PatchFrame frame_of(const Patch& patch) {
  PatchFrame f;
  for (const Vec3& p : patch.points) f.center += p;
  f.center /= static_cast<double>(patch.points.size());
  for (const Vec3& p : patch.points) f.scale = std::max(f.scale, (p - f.center).norm());
  for (const Vec3& n : patch.normals) {
    f.normal_moment += n * n.transpose();
    f.mean_normal += n;
  }
  const auto count = static_cast<double>(patch.normals.size());
  f.normal_moment /= count;
  f.mean_normal /= count;
  return f;
}

Vec3 smallest_eigenvector(const Mat3& m) {
  return Eigen::SelfAdjointEigenSolver<Mat3>(m).eigenvectors().col(0);
}

std::optional<Surface> guess_cylinder(const Patch& patch, const PatchFrame& f, double size) {
  Surface s;
  s.kind = SurfaceKind::Cylinder;
  s.axis = smallest_eigenvector(f.normal_moment);
  const Tangents t = tangents(s.axis);
  const Circle c = fit_circle(patch.points, [&](const Vec3& p) {
    const Vec3 d = (p - f.center) / f.scale;
    return Vec2(t.u.dot(d), t.w.dot(d));
  });
  s.point = f.center + (t.u * c.center.x() + t.w * c.center.y()) * f.scale;
  s.radius = c.radius * f.scale;
  if (!is_plausible(s.radius, size)) return std::nullopt;
  return s;
}

std::optional<Surface> guess_sphere(const Patch& patch, const PatchFrame& f, double size) {
  if (patch.normals.size() < kMinSphereFacets) return std::nullopt;
  Eigen::Matrix4d a = Eigen::Matrix4d::Zero();
  Eigen::Vector4d b = Eigen::Vector4d::Zero();
  for (const Vec3& p : patch.points) {
    const Vec3 d = (p - f.center) / f.scale;
    const Eigen::Vector4d row(d.x(), d.y(), d.z(), 1);
    a += row * row.transpose();
    b += row * d.squaredNorm();
  }
  const Eigen::Vector4d x = a.ldlt().solve(b);
  const Vec3 c = x.head<3>() / 2;
  Surface s;
  s.kind = SurfaceKind::Sphere;
  s.point = f.center + c * f.scale;
  s.radius = std::sqrt(std::max(0.0, x[3] + c.squaredNorm())) * f.scale;
  if (!is_plausible(s.radius, size)) return std::nullopt;
  return s;
}

std::optional<Surface> guess_cone(const Patch& patch, const PatchFrame& f, double size) {
  const Mat3 spread = f.normal_moment - f.mean_normal * f.mean_normal.transpose();
  Surface s;
  s.kind = SurfaceKind::Cone;
  s.axis = smallest_eigenvector(spread);
  const double lean = std::abs(f.mean_normal.dot(s.axis));
  if (lean < 0.02 || lean > 0.995) return std::nullopt;
  Mat3 a = Mat3::Zero();
  Vec3 b = Vec3::Zero();
  for (std::size_t i = 0; i < patch.normals.size(); ++i) {
    const Vec3& n = patch.normals[i];
    a += n * n.transpose();
    b += n * n.dot(patch.centers[i] - f.center);
  }
  s.point = f.center + Vec3(a.ldlt().solve(b));
  if (s.axis.dot(f.center - s.point) < 0) s.axis = -s.axis;
  double sum = 0;
  int count = 0;
  for (const Vec3& p : patch.points) {
    const Vec3 d = p - s.point;
    if (d.norm() < 1e-4 * size) continue;
    const double h = s.axis.dot(d);
    sum += std::atan2((d - s.axis * h).norm(), h);
    ++count;
  }
  if (count == 0) return std::nullopt;
  s.half_angle_rad = sum / count;
  if (s.half_angle_rad < 0.01 || s.half_angle_rad > 1.56) return std::nullopt;
  return s;
}

/// The torus about a given axis whose profile circle fits the points best.
std::optional<Surface> torus_about(const Patch& patch, const PatchFrame& f, const Vec3& point,
                                   const Vec3& axis, double size) {
  const double level = axis.dot(f.center - point);
  const Circle c = fit_circle(patch.points, [&](const Vec3& p) {
    const Vec3 d = p - point;
    const double h = axis.dot(d);
    return Vec2((d - axis * h).norm() / f.scale, (h - level) / f.scale);
  });
  Surface s;
  s.kind = SurfaceKind::Torus;
  s.axis = axis;
  s.point = point + axis * (c.center.y() * f.scale + level);
  s.radius = c.radius * f.scale;
  s.major_radius = c.center.x() * f.scale;
  if (s.major_radius <= 0 || s.major_radius > kMaxRadius * size) return std::nullopt;
  if (!is_plausible(s.radius, size)) return std::nullopt;
  return s;
}

/// Every normal line of a surface of revolution meets its axis: m . n + a . (x cross n) = 0 for the
/// axis' Pluecker coordinates (a, m). Minimised over m for unit a.
void guess_tori(const Patch& patch, const PatchFrame& f, double size, std::vector<Surface>& out) {
  if (patch.normals.size() < kMinTorusFacets) return;
  Mat3 nn = Mat3::Identity() * 1e-9, nx = Mat3::Zero(), xx = Mat3::Zero();
  for (std::size_t i = 0; i < patch.normals.size(); ++i) {
    const Vec3& n = patch.normals[i];
    const Vec3 moment = ((patch.centers[i] - f.center) / f.scale).cross(n);
    nn += n * n.transpose();
    nx += n * moment.transpose();
    xx += moment * moment.transpose();
  }
  const Mat3 inverse = nn.inverse();
  const Mat3 schur = xx - nx.transpose() * inverse * nx;
  const Eigen::SelfAdjointEigenSolver<Mat3> solver(schur);
  for (int column = 0; column < 2; ++column) {
    const Vec3 axis = solver.eigenvectors().col(column);
    const Vec3 moment = -inverse * nx * axis;
    const Vec3 point = f.center + axis.cross(moment) * f.scale;
    if (const auto s = torus_about(patch, f, point, axis, size)) out.push_back(*s);
  }
}

}  // namespace

std::vector<Surface> guess_surfaces(const Patch& patch, double size) {
  std::vector<Surface> out;
  if (patch.points.size() < 4 || patch.normals.size() < 2) return out;
  const PatchFrame f = frame_of(patch);
  if (!(f.scale > 0)) return out;
  if (const auto s = guess_cylinder(patch, f, size)) out.push_back(*s);
  if (const auto s = guess_sphere(patch, f, size)) out.push_back(*s);
  if (const auto s = guess_cone(patch, f, size)) out.push_back(*s);
  guess_tori(patch, f, size, out);
  return out;
}

}  // namespace hewn
