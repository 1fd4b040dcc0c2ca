#include "core/session/measuring.h"

#include <doctest/doctest.h>

#include "tests/core/session/session_fixture.h"

namespace hewn {
namespace {

using doctest::Approx;

/// Groups without triangles: what dimensions need.
struct Surfaces {
  PreparedMesh prepared;

  Spot add(SurfaceKind kind, const Vec3& point, const Vec3& axis, const Vec3& at,
           double radius = 1) {
    FaceGroup group;
    group.surface.kind = kind;
    group.surface.point = point;
    group.surface.axis = axis.normalized();
    group.surface.offset = group.surface.axis.dot(point);
    group.surface.radius = radius;
    prepared.segmentation.groups.push_back(group);
    return {at, static_cast<int>(prepared.segmentation.groups.size()) - 1, false};
  }
};

TEST_CASE("parallel planes are a distance apart, others an angle") {
  Surfaces s;
  const Spot bottom = s.add(SurfaceKind::Plane, Vec3::Zero(), -Vec3::UnitZ(), Vec3(1, 2, 0));
  const Spot top = s.add(SurfaceKind::Plane, Vec3(0, 0, 5), Vec3::UnitZ(), Vec3(4, 6, 5));
  const Spot slope = s.add(SurfaceKind::Plane, Vec3::Zero(), Vec3(0, 1, 1), Vec3::Zero());
  const auto apart = dimensions_between(s.prepared, bottom, top);
  CHECK(apart[0].what == "planes");
  CHECK(apart[0].value == Approx(5));
  CHECK(apart[0].from == Vec3(1, 2, 0));
  CHECK(apart[0].to == Vec3(1, 2, 5));
  CHECK(apart[1].what == "spots");
  CHECK(apart[1].value == Approx(std::sqrt(50)));
  CHECK(apart[2].value == 3);
  const auto turned = dimensions_between(s.prepared, top, slope);
  CHECK(turned[0].is_angle);
  CHECK(turned[0].value == Approx(45));
}

TEST_CASE("axes are measured at their nearest") {
  Surfaces s;
  const Spot upright = s.add(SurfaceKind::Cylinder, Vec3(0, 0, -7), Vec3::UnitZ(), Vec3(1, 0, 2));
  const Spot beside = s.add(SurfaceKind::Cylinder, Vec3(3, 4, 9), -Vec3::UnitZ(), Vec3(3, 5, 1));
  const Spot skew = s.add(SurfaceKind::Cylinder, Vec3(-8, 2, 1), Vec3::UnitX(), Vec3(0, 3, 1));
  const auto parallel = dimensions_between(s.prepared, upright, beside);
  CHECK(parallel[0].what == "axes");
  CHECK(parallel[0].value == Approx(5));
  CHECK(parallel[0].from.isApprox(Vec3(0, 0, 2)));
  const auto crossing = dimensions_between(s.prepared, upright, skew);
  CHECK(crossing[0].value == Approx(90));
  CHECK(crossing[1].what == "closest");
  CHECK(crossing[1].value == Approx(2));
  CHECK(crossing[1].from.isApprox(Vec3(0, 0, 1)));
  CHECK(crossing[1].to.isApprox(Vec3(0, 2, 1)));
}

TEST_CASE("a plane and an axis, in either order") {
  Surfaces s;
  const Spot wall = s.add(SurfaceKind::Plane, Vec3(10, 0, 0), Vec3::UnitX(), Vec3(10, 1, 1));
  const Spot bore = s.add(SurfaceKind::Cylinder, Vec3(4, 0, 0), Vec3::UnitZ(), Vec3(5, 0, 1));
  const Spot leaning = s.add(SurfaceKind::Cone, Vec3::Zero(), Vec3(1, 0, 2), Vec3(1, 0, 1));
  for (const auto& [a, b] : {std::pair(wall, bore), std::pair(bore, wall)}) {
    const auto found = dimensions_between(s.prepared, a, b);
    CHECK(found[0].what == "axis to plane");
    CHECK(found[0].value == Approx(6));
    CHECK((a.group == wall.group ? found[0].from : found[0].to).x() == Approx(10));
  }
  const auto angle = dimensions_between(s.prepared, wall, leaning);
  CHECK(angle[0].is_angle);
  CHECK(angle[0].value == Approx(std::atan(0.5) * 180 / kPi));
}

TEST_CASE("corners stand for themselves, spheres for their centres") {
  Surfaces s;
  const Spot ball = s.add(SurfaceKind::Sphere, Vec3(0, 0, 3), Vec3::UnitZ(), Vec3(0, 0, 5), 2);
  Spot corner = s.add(SurfaceKind::Plane, Vec3::Zero(), Vec3::UnitZ(), Vec3(4, 0, 0));
  const auto to_plane = dimensions_between(s.prepared, ball, corner);
  CHECK(to_plane[0].what == "centre to plane");
  CHECK(to_plane[0].value == Approx(3));
  corner.is_corner = true;
  const auto to_corner = dimensions_between(s.prepared, corner, ball);
  CHECK(to_corner[0].what == "point to centre");
  CHECK(to_corner[0].value == Approx(5));
  const auto two_corners = dimensions_between(s.prepared, corner, corner);
  CHECK(two_corners[0].value == 0);
  CHECK(two_corners.size() == 4);  // the distance and its three parts, not twice the same
  const auto sizes = dimensions_of(s.prepared, ball);
  CHECK(sizes[0].what == "radius");
  CHECK(sizes[1].value == 4);
}

TEST_CASE("a ray finds the group that is seen") {
  const testing::OpenSession open;
  const PreparedMesh& prepared = *open.session.document().prepared;
  const auto group_at = [&](const Vec3& p) {
    return find_groups(prepared, {{p, -1}}, "").value().front();
  };
  Pointing down{Vec3(15, 5, 100), -Vec3::UnitZ(), group_at(Vec3(15, 5, 4))};
  const auto top = spot_at(prepared, down);
  REQUIRE(top);
  CHECK(!top->is_corner);
  CHECK((top->at - Vec3(15, 5, 4)).norm() < 1e-5);
  // The plate's underside is behind its top; what is hidden or cut away does not stop the ray.
  down.group = group_at(Vec3(15, 5, -4));
  const auto bottom = spot_at(prepared, down);
  REQUIRE(bottom);
  CHECK(bottom->at.z() == Approx(-4));
  down.cut_normal = Vec3::UnitX();
  down.cut_offset = 10;
  CHECK(!spot_at(prepared, down));
  down.cut_offset = 20;
  CHECK(spot_at(prepared, down));
  down.group = group_at(Vec3(3, 0, 0));  // the ray does not meet the hole's wall
  CHECK(!spot_at(prepared, down));
}

TEST_CASE("corners are the vertices between groups") {
  const testing::OpenSession open;
  const auto corners = corners_of(*open.session.document().prepared);
  CHECK(corners.size() == 4 * 32);  // the rims of the plate and of its hole, above and below
  std::size_t of_three = 0;
  for (const Corner& corner : corners) {
    if (corner.groups.size() == 2) continue;
    CHECK(corner.at.cwiseAbs() == Vec3(20, 10, 4));
    ++of_three;
  }
  CHECK(of_three == 8);
}

}  // namespace
}  // namespace hewn
