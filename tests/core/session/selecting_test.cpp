#include "core/session/selecting.h"

#include <doctest/doctest.h>

#include "core/session/describe.h"
#include "tests/core/session/session_fixture.h"

namespace hewn {
namespace {

TEST_CASE("numbers show four significant digits") {
  CHECK(short_number(3) == "3");
  CHECK(short_number(12.7) == "12.7");
  CHECK(short_number(0.083333333) == "0.08333");
  CHECK(short_number(1234.56) == "1235");
  CHECK(short_number(-0.5) == "-0.5");
  CHECK(short_number(0) == "0");
  CHECK(short_number(1e-7) == "1.000e-07");
  CHECK(short_number(0.99996) == "1");
}

TEST_CASE("selections combine as sets") {
  const std::vector<int> a = {1, 3, 5};
  const std::vector<int> b = {3, 4};
  CHECK(combined(a, b, Combine::Replace) == b);
  CHECK(combined(a, b, Combine::Add) == std::vector<int>{1, 3, 4, 5});
  CHECK(combined(a, b, Combine::Remove) == std::vector<int>{1, 5});
  CHECK(combined(a, b, Combine::Toggle) == std::vector<int>{1, 4, 5});
}

TEST_CASE("planes snap to directions and to what lies near them") {
  const testing::SessionFolder folder("snap");
  Session session(testing::one_thread());
  session.set_views(false);
  REQUIRE(session.execute(OpenFile{folder.plate()}));
  session.wait();
  const PreparedMesh& prepared = *session.document().prepared;
  const Vec3 tilted = Vec3(1, 0.03, 0).normalized();
  const SnappedPlane free = snap_plane(prepared, tilted, Vec3(0.2, 0, 0), 0, 0);
  CHECK(free.normal.isApprox(tilted));
  CHECK(free.snapped_to.empty());
  const SnappedPlane turned = snap_plane(prepared, tilted, Vec3(0.2, 0, 0), 0.09, 0);
  CHECK(turned.normal == Vec3::UnitX());
  CHECK(turned.offset == doctest::Approx(0.2));
  const SnappedPlane middle = snap_plane(prepared, tilted, Vec3(0.2, 0, 0), 0.09, 0.5);
  CHECK(middle.offset == doctest::Approx(0).epsilon(1e-6));  // the hole's axis
  CHECK(middle.snapped_to.find("middle of") != std::string::npos);
  const SnappedPlane side = snap_plane(prepared, tilted, Vec3(19.8, 0, 0), 0.09, 0.5);
  CHECK(side.offset == doctest::Approx(20));
  const SnappedPlane upright = snap_plane(prepared, Vec3(1, 1, 0.02), Vec3::Zero(), 0.09, 0);
  CHECK(upright.normal.z() == 0);
  CHECK(upright.snapped_to == "along z");
}

TEST_CASE("a selection is described by what its groups share") {
  const testing::SessionFolder folder("describe");
  Session session(testing::one_thread());
  session.set_views(false);
  REQUIRE(session.execute(OpenFile{folder.plate()}));
  session.wait();
  const PreparedMesh& prepared = *session.document().prepared;
  const auto hole = find_groups(prepared, testing::hole(), "");
  REQUIRE(hole);
  CHECK(describe_selection(prepared, *hole).starts_with("cylinder r 3, "));
  CHECK(describe_selection(prepared, {}) == "nothing selected");
  const auto planes = combined({0, 1, 2, 3, 4, 5, 6}, *hole, Combine::Remove);
  CHECK(describe_selection(prepared, planes).starts_with("6 planes, "));
}

}  // namespace
}  // namespace hewn
