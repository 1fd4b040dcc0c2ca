#include "ui/view/camera.h"

#include <doctest/doctest.h>

namespace hewn {
namespace {

TEST_CASE("a point that is projected lies on the ray through its place") {
  Camera camera;
  camera.fit(Vec3(1, 2, 3), 5);
  for (const bool is_perspective : {true, false}) {
    camera.is_perspective = is_perspective;
    const Vec3 p(2.5, 0.5, 4);
    const Vec3 at = camera.project(p, 1.6);
    const ViewRay ray = camera.ray(at.x(), at.y(), 1.6);
    CHECK((p - ray.origin).cross(ray.direction).norm() < 1e-9);
  }
}

TEST_CASE("the matrices agree with the rays") {
  Camera camera;
  camera.fit(Vec3(0, 0, 0), 2);
  for (const bool is_perspective : {true, false}) {
    camera.is_perspective = is_perspective;
    const Vec3 p(0.7, -0.4, 1.1);
    const glm::vec4 clip = camera.projection(1.5) * camera.view() * glm::vec4(0.7F, -0.4F, 1.1F, 1);
    const Vec3 at = camera.project(p, 1.5);
    CHECK(clip.x / clip.w == doctest::Approx(at.x()).epsilon(1e-4));
    CHECK(clip.y / clip.w == doctest::Approx(at.y()).epsilon(1e-4));
    CHECK(std::abs(clip.z / clip.w) < 1);  // within the depth range
  }
}

TEST_CASE("zooming keeps the point under the cursor in its place") {
  Camera camera;
  camera.fit(Vec3::Zero(), 3);
  const double x = 0.4;
  const double y = -0.3;
  const ViewRay before = camera.ray(x, y, 1.4);
  const double along =
      (camera.target - before.origin).dot(camera.back()) / before.direction.dot(camera.back());
  const Vec3 p = before.origin + along * before.direction;
  camera.zoom(3, x, y, 1.4);
  const Vec3 after = camera.project(p, 1.4);
  CHECK(after.x() == doctest::Approx(x));
  CHECK(after.y() == doctest::Approx(y));
  CHECK(after.z() < along / std::abs(before.direction.dot(camera.back())));
}

TEST_CASE("fitting shows the whole sphere") {
  Camera camera;
  camera.fit(Vec3(10, 0, 0), 4);
  for (int k = 0; k < 3; ++k) {
    const Vec3 at = camera.project(Vec3(10, 0, 0) + 4 * Vec3::Unit(k), 1);
    CHECK(std::abs(at.x()) <= 1);
    CHECK(std::abs(at.y()) <= 1);
  }
}

TEST_CASE("standard views look along the axes") {
  Camera camera;
  camera.look(StandardView::Front);
  CHECK(camera.back().isApprox(-Vec3::UnitY(), 1e-12));
  CHECK(camera.up().isApprox(Vec3::UnitZ(), 1e-12));
  camera.look(StandardView::Top);
  CHECK(camera.back().isApprox(Vec3::UnitZ(), 1e-12));
  CHECK(camera.up().isApprox(Vec3::UnitY(), 1e-12));
  camera.look(StandardView::Right);
  CHECK(camera.back().isApprox(Vec3::UnitX(), 1e-12));
}

}  // namespace
}  // namespace hewn
