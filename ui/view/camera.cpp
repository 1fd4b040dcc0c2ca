#include "ui/view/camera.h"

#include <algorithm>
#include <cmath>

#include <glm/gtc/matrix_transform.hpp>

namespace hewn {
namespace {

constexpr double kHalfView = 0.28;  // tangent of half the vertical angle: about 31 degrees in all

glm::vec3 single(const Vec3& v) {
  return {static_cast<float>(v.x()), static_cast<float>(v.y()), static_cast<float>(v.z())};
}

}  // namespace

void Camera::fit(const Vec3& center, double radius_of_part) {
  target = center;
  radius = std::max(radius_of_part, 1e-12);
  distance = 1.08 * radius / std::sin(std::atan(kHalfView));
}

void Camera::look(StandardView view) {
  struct Direction {
    double yaw, pitch;
  };
  const double quarter = kPi / 2;
  const Direction directions[] = {{-quarter, 0},       {quarter, 0},         {kPi, 0},   {0, 0},
                                  {-quarter, quarter}, {-quarter, -quarter}, {-1.0, 0.5}};
  const Direction d = directions[static_cast<int>(view)];
  yaw_rad = d.yaw;
  pitch_rad = d.pitch;
}

void Camera::orbit(double dx, double dy) {
  constexpr double kPerPixel = 0.008;
  yaw_rad -= kPerPixel * dx;
  pitch_rad = std::clamp(pitch_rad + kPerPixel * dy, -kPi / 2, kPi / 2);
}

void Camera::pan(double dx, double dy, double height) {
  const double unit = unit_per_pixel(height);
  target += (-dx * right() + dy * up()) * unit;
}

void Camera::zoom(double steps, double x, double y, double aspect) {
  const double factor = std::clamp(std::pow(0.86, steps), 0.1, 10.0);
  const double least = 1e-4 * radius;
  const double most = 200 * radius;
  const double next = std::clamp(distance * factor, least, most);
  const double half = kHalfView * (distance - next);
  target += right() * (x * aspect * half) + up() * (y * half);
  distance = next;
}

ViewRay Camera::ray(double x, double y, double aspect) const {
  if (is_perspective) {
    const Vec3 d = right() * (x * aspect * kHalfView) + up() * (y * kHalfView) - back();
    return {eye(), d.normalized()};
  }
  const double half = kHalfView * distance;
  const Vec3 start = eye() + right() * (x * aspect * half) + up() * (y * half);
  return {start, -back()};
}

Vec3 Camera::project(const Vec3& p, double aspect) const {
  const Vec3 r = p - eye();
  const double depth = -r.dot(back());
  const double half = kHalfView * (is_perspective ? std::max(depth, 1e-12) : distance);
  return {r.dot(right()) / (half * aspect), r.dot(up()) / half, depth};
}

glm::mat4 Camera::view() const { return glm::lookAt(single(eye()), single(target), single(up())); }

glm::mat4 Camera::projection(double aspect) const {
  const double reach = 2.5 * radius + target.norm();
  const double near = std::max({distance - reach, 0.002 * distance, 1e-4 * radius});
  const double far = distance + reach;
  const auto a = static_cast<float>(aspect);
  if (is_perspective) {
    return glm::perspective(static_cast<float>(2 * std::atan(kHalfView)), a,
                            static_cast<float>(near), static_cast<float>(far));
  }
  const auto half = static_cast<float>(kHalfView * distance);
  return glm::ortho(-half * a, half * a, -half, half, static_cast<float>(distance - reach),
                    static_cast<float>(far));
}

Vec3 Camera::back() const {
  return {std::cos(pitch_rad) * std::cos(yaw_rad), std::cos(pitch_rad) * std::sin(yaw_rad),
          std::sin(pitch_rad)};
}

Vec3 Camera::right() const { return {-std::sin(yaw_rad), std::cos(yaw_rad), 0}; }

Vec3 Camera::up() const { return back().cross(right()); }

double Camera::unit_per_pixel(double height) const { return 2 * kHalfView * distance / height; }

}  // namespace hewn
