#include "core/sample/frame.h"

#include <doctest/doctest.h>

#include "tests/support/part_problem.h"
#include "tests/support/solids.h"

namespace hewn {
namespace {

TEST_CASE("an aligned part has the identity as its frame") {
  const solids::PartProblem part(solids::box({-1, -2, 0}, {4, 3, 7}));
  CHECK(part.space.frame.rotation == Mat3::Identity());
  CHECK(part.space.frame.box.lo == part.mesh->bounds.lo);
  CHECK(part.space.frame.box.hi == part.mesh->bounds.hi);
}

TEST_CASE("the frame of a turned box is the box's own, so that its volume is") {
  const Mesh turned =
      solids::transformed(solids::box({-1, -2, 0}, {4, 3, 7}), solids::oblique_transform());
  const solids::PartProblem part(turned);
  CHECK(part.space.frame.rotation.determinant() == doctest::Approx(1));
  CHECK(part.space.frame.box.size().prod() == doctest::Approx(5 * 5 * 7).epsilon(1e-6));
}

/// A lever along x, turned: two flat ends, one flank off the axes, two bores.
SurfaceSet lever_surfaces(const Mat3& turn) {
  SurfaceSet set;
  const Vec3 flank = Vec3(0.1, 0.995, 0).normalized();
  set.directions = {turn.col(2), turn * flank};
  const auto add = [&set](SurfaceKind kind, int direction, const Vec3& point, double area) {
    Halfspace h;
    h.surface.kind = kind;
    h.surface.axis = set.directions[static_cast<std::size_t>(direction)];
    h.surface.point = point;
    h.surface.offset = h.surface.axis.dot(point);
    h.surface.radius = 3;
    h.direction = direction;
    h.area = area;
    set.halfspaces.push_back(h);
  };
  add(SurfaceKind::Plane, 0, Vec3::Zero(), 500);
  add(SurfaceKind::Plane, 0, turn * Vec3(0, 0, 6), 500);
  add(SurfaceKind::Plane, 1, turn * Vec3(0, 10, 0), 300);
  add(SurfaceKind::Cylinder, 0, Vec3::Zero(), 50);
  add(SurfaceKind::Cylinder, 0, turn * Vec3(50, 0, 2), 50);
  return set;
}

TEST_CASE("where a part has only one flank, its frame follows the line from bore to bore") {
  const Mesh extent = solids::box({-10, -10, 0}, {55, 10, 6});
  CHECK(find_frame(extent, {}, lever_surfaces(Mat3::Identity())).rotation == Mat3::Identity());
  const Mat3 turn = Eigen::AngleAxisd(0.7, Vec3(1, 2, 3).normalized()).toRotationMatrix();
  const Frame frame = find_frame(extent, {}, lever_surfaces(turn));
  double along = 0;
  for (int c = 0; c < 3; ++c) {
    along = std::max(along, std::abs(frame.rotation.col(c).dot(turn.col(0))));
  }
  CHECK(along == doctest::Approx(1));
  CHECK((frame.rotation.transpose() * frame.rotation - Mat3::Identity()).norm() < 1e-12);
  // A second flank across the first direction decides again.
  SurfaceSet two = lever_surfaces(turn);
  two.halfspaces.push_back(two.halfspaces[2]);
  double across = 0;
  const Frame flank_frame = find_frame(extent, {}, two);
  for (int c = 0; c < 3; ++c) {
    across = std::max(across, std::abs(flank_frame.rotation.col(c).dot(two.directions[1])));
  }
  CHECK(across == doctest::Approx(1));
}

TEST_CASE("the frame of a lone cylinder contains its axis") {
  const solids::PartProblem part(solids::cylinder(2, 9, 32));
  const Frame& frame = part.space.frame;
  double along = 0;
  for (int c = 0; c < 3; ++c) along = std::max(along, std::abs(frame.rotation.col(c).z()));
  CHECK(along == doctest::Approx(1));
}

}  // namespace
}  // namespace hewn
