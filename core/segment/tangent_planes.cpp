#include "core/segment/tangent_planes.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Eigenvalues>

namespace hewn {
namespace {

/// Radians: fits know no narrower cone, but take a cylinder.
constexpr double kMinHalfAngle = 0.02;

/// The direction in which the matrix is smallest, on the side of `near`.
Vec3 least_direction(const Mat3& m, const Vec3& near) {
  const Vec3 axis = Eigen::SelfAdjointEigenSolver<Mat3>(m).eigenvectors().col(0);
  return axis.dot(near) < 0 ? Vec3(-axis) : axis;
}

double total_weight(std::span<const TangentPlane> planes) {
  double total = 0;
  for (const TangentPlane& p : planes) total += p.weight;
  return total;
}

/// By a plane that lies this far off at its point, and leans by this sine too much.
double square_missed(const TangentPlane& p, double distance, double lean) {
  return p.weight * (distance * distance + p.reach * p.reach * lean * lean);
}

/// Each plane: n . (point + u x + w y) + inscribed radius = n . its point.
InscribedFit cylinder_fit(const Surface& near, std::span<const TangentPlane> planes) {
  Mat3 moment = Mat3::Zero();
  for (const TangentPlane& p : planes) moment += p.weight * p.normal * p.normal.transpose();
  Surface s = near;
  s.axis = least_direction(moment, near.axis);
  const Tangents t = tangents(s.axis);
  const auto row = [&](const TangentPlane& p) {
    return Vec3(p.normal.dot(t.u), p.normal.dot(t.w), 1);
  };
  const auto value = [&](const TangentPlane& p) { return p.normal.dot(p.point - near.point); };
  Mat3 a = Mat3::Zero();
  Vec3 b = Vec3::Zero();
  for (const TangentPlane& p : planes) {
    a += p.weight * row(p) * row(p).transpose();
    b += p.weight * row(p) * value(p);
  }
  const Vec3 x = a.ldlt().solve(b);
  double squares = 0;
  for (const TangentPlane& p : planes) {
    squares += square_missed(p, row(p).dot(x) - value(p), p.normal.dot(s.axis));
  }
  s.point += t.u * x[0] + t.w * x[1];
  s.radius = x[2];
  return {s, std::sqrt(squares / total_weight(planes))};
}

/// All planes meet in the apex, and their normals lean back from the axis by the same angle.
std::optional<InscribedFit> cone_fit(const Surface& near, std::span<const TangentPlane> planes) {
  const double total = total_weight(planes);
  Mat3 moment = Mat3::Zero();
  Vec3 mean = Vec3::Zero(), b = Vec3::Zero();
  for (const TangentPlane& p : planes) {
    moment += p.weight * p.normal * p.normal.transpose();
    mean += p.weight / total * p.normal;
    b += p.weight * p.normal * p.normal.dot(p.point - near.point);
  }
  Surface s = near;
  s.axis = least_direction(moment / total - mean * mean.transpose(), near.axis);
  s.point += Vec3(moment.ldlt().solve(b));
  const double sine = -mean.dot(s.axis);
  if (!(sine > std::sin(kMinHalfAngle) && sine < 1)) return std::nullopt;
  s.half_angle_rad = std::asin(sine);
  double squares = 0;
  for (const TangentPlane& p : planes) {
    squares += square_missed(p, p.normal.dot(p.point - s.point), p.normal.dot(s.axis) + sine);
  }
  return InscribedFit{s, std::sqrt(squares / total)};
}

}  // namespace

std::optional<InscribedFit> inscribed_fit(const Surface& near,
                                          std::span<const TangentPlane> planes) {
  if (planes.empty()) return std::nullopt;
  if (near.kind == SurfaceKind::Cylinder) return cylinder_fit(near, planes);
  if (near.kind == SurfaceKind::Cone) return cone_fit(near, planes);
  return std::nullopt;
}

double step_about_axis(const Surface& inscribed, double turn_rad) {
  if (inscribed.kind != SurfaceKind::Cone) return turn_rad;
  const double sine = std::sin(inscribed.half_angle_rad);
  const double cosine = (std::cos(turn_rad) - sine * sine) / (1 - sine * sine);
  return std::acos(std::clamp(cosine, -1.0, 1.0));
}

Surface circumscribed(const Surface& inscribed, double step_rad) {
  Surface s = inscribed;
  s.radius /= std::cos(step_rad / 2);
  s.half_angle_rad = std::atan(std::tan(s.half_angle_rad) / std::cos(step_rad / 2));
  return s;
}

}  // namespace hewn
