/// Lasso and knife handles, by the mouse.
#include <cmath>

#include <doctest/doctest.h>

#include "tests/ui/bench.h"
#include "ui/actions.h"
#include "ui/tools/knife.h"
#include "ui/tools/measure.h"
#include "ui/tools/plane_handles.h"

namespace hewn {
namespace {

using testing::Bench;
constexpr int kEnter = 257;

/// Where the view lies in the bench's window: between the side panels, below the toolbar.
constexpr float kLeft = 300, kTop = 200;

/// Three groups side by side, each 100 pixels wide, from (`kLeft`, `kTop`) on, 200 high.
struct Stripes {
  ViewArea view;
  int operator()(int x, int y) const {
    const int column = static_cast<int>(std::floor((view.x + static_cast<float>(x) - kLeft) / 100));
    const float row = view.y + static_cast<float>(y) - kTop;
    return column >= 0 && column < 3 && row >= 0 && row < 200 ? column : -1;
  }
};

/// The studio's view: the picture begins where its backing says.
ViewArea view_of(Bench& bench) {
  const Backing& backing = bench.studio().backing();
  const float right = bench.state().right_width + 4;
  return {static_cast<float>(backing.picture_x), static_cast<float>(backing.picture_y),
          1280 - right - static_cast<float>(backing.picture_x),
          720 - 26 - static_cast<float>(backing.picture_y)};
}

TEST_CASE("the lasso takes the groups that lie in it for the most part") {
  Bench bench;
  bench.engine().label_at = Stripes{view_of(bench)};
  CHECK(bench.key('L'));
  REQUIRE(bench.state().tool == Tool::Lasso);
  // Around the first stripe and a third of the second.
  bench.drag({{kLeft - 10, kTop - 10},
              {kLeft + 133, kTop - 10},
              {kLeft + 133, kTop + 210},
              {kLeft - 10, kTop + 210}});
  CHECK(bench.state().selected == std::vector<int>{0});
  CHECK(bench.state().tool == Tool::Select);
}

TEST_CASE("a lasso with a dent leaves out what lies in the dent; Shift adds") {
  Bench bench;
  bench.engine().label_at = Stripes{view_of(bench)};
  CHECK(bench.key('L'));
  // A horseshoe: the first and the last stripe, open towards the bottom between them.
  bench.drag({{kLeft - 10, kTop - 10},
              {kLeft + 310, kTop - 10},
              {kLeft + 310, kTop + 210},
              {kLeft + 200, kTop + 210},
              {kLeft + 200, kTop + 10},
              {kLeft + 100, kTop + 10},
              {kLeft + 100, kTop + 210},
              {kLeft - 10, kTop + 210}});
  CHECK(bench.state().selected == std::vector<int>{0, 2});
  CHECK(bench.key('L'));
  ImGui::GetIO().KeyShift = true;
#if IMGUI_VERSION_NUM >= 18700
  ImGui::GetIO().AddKeyEvent(ImGuiMod_Shift, true);
#endif
  bench.drag({{kLeft + 90, kTop - 10},
              {kLeft + 210, kTop - 10},
              {kLeft + 210, kTop + 210},
              {kLeft + 90, kTop + 210}});
  CHECK(bench.state().selected == std::vector<int>{0, 1, 2});
}

/// The middle of a handle: where it is found, in steps of two pixels.
std::array<float, 2> place_of(Bench& bench, const ViewArea& view, PlaneHandle handle) {
  std::array<float, 2> sum{};
  int count = 0;
  for (float y = view.y; y < view.y + view.height; y += 2) {
    for (float x = view.x; x < view.x + view.width; x += 2) {
      if (plane_handle_at(bench.studio().ui(), view, {x, y}) != handle) continue;
      sum[0] += x;
      sum[1] += y;
      ++count;
    }
  }
  REQUIRE(count > 0);
  return {sum[0] / static_cast<float>(count), sum[1] / static_cast<float>(count)};
}

TEST_CASE("the middle handle moves a plane along its normal by as much as the mouse") {
  Bench bench;
  CHECK(bench.key('1'));  // from the front: x to the right, z upwards
  CHECK(bench.key('K'));
  set_knife_plane(bench.studio().ui(), {Vec3::UnitX(), 2, ""});
  bench.frames(2);
  const ViewArea view = view_of(bench);
  const auto at = place_of(bench, view, PlaneHandle::Move);
  bench.drag({at, {at[0] + 30, at[1]}, {at[0] + 60, at[1]}});
  const SnappedPlane& plane = *bench.state().knife.plane;
  CHECK(plane.normal == Vec3::UnitX());
  const double expected = 2 + 60 * bench.state().camera.unit_per_pixel(view.height);
  CHECK(plane.offset == doctest::Approx(expected).epsilon(0.05));
}

TEST_CASE("a side handle turns the plane about the point next to the part's middle") {
  Bench bench;
  CHECK(bench.key('1'));
  CHECK(bench.key('K'));
  set_knife_plane(bench.studio().ui(), {Vec3::UnitX(), 2, ""});
  bench.frames(2);
  const ViewArea view = view_of(bench);
  // The arms of a plane across x are y and z; from the front only that along z is seen in full.
  const Tangents frame = tangents(Vec3::UnitX());
  const PlaneHandle up =
      std::abs(frame.u.z()) > std::abs(frame.w.z()) ? PlaneHandle::TurnU : PlaneHandle::TurnW;
  const auto at = place_of(bench, view, up);
  bench.drag({at, {at[0] + 40, at[1]}});
  const SnappedPlane& plane = *bench.state().knife.plane;
  CHECK(plane.normal.norm() == doctest::Approx(1));
  CHECK(std::abs(plane.normal.y()) < 1e-9);
  CHECK(std::abs(plane.normal.z()) > 0.1);
  CHECK(plane.normal.x() > 0.5);
  // The middle of the plane stayed: on x = 2.
  CHECK(plane.normal.dot(Vec3(2, 0, 0)) == doctest::Approx(plane.offset).epsilon(1e-6));
}

TEST_CASE("the section moves with its handle, and the knife's plane stays away") {
  Bench bench;
  CHECK(bench.key('1'));
  CHECK(bench.key('C'));
  bench.frames(2);
  const ViewArea view = view_of(bench);
  const auto at = place_of(bench, view, PlaneHandle::Move);
  bench.drag({at, {at[0] + 30, at[1]}, {at[0] + 60, at[1]}});
  REQUIRE(bench.state().section);
  const double expected = 60 * bench.state().camera.unit_per_pixel(view.height);
  CHECK(bench.state().section->offset == doctest::Approx(expected).epsilon(0.05));
  CHECK(bench.state().selected.empty());
  CHECK(!bench.state().knife.plane);
  CHECK(bench.engine().last.section.w == doctest::Approx(expected).epsilon(0.05));
}

TEST_CASE("two clicks measure what lies between two faces") {
  Bench bench;
  CHECK(bench.key('1'));
  const PreparedMesh& prepared = *bench.session().document().prepared;
  const auto group_at = [&](const Vec3& p) {
    return find_groups(prepared, {{p, -1}}, "").value().front();
  };
  const int front = group_at(Vec3(10, -10, 0));
  bench.engine().label_at = [front](int, int) { return front; };
  CHECK(bench.key('M', kShift));
  REQUIRE(bench.state().tool == Tool::Measure);
  const ImVec2 first = to_pixel(bench.studio().ui(), view_of(bench), Vec3(10, -10, 0));
  bench.click(first.x, first.y);
  REQUIRE(bench.state().measure.spots.size() == 1);
  CHECK(bench.state().selected.empty());
  // The bore through the plate, as if its near wall were not there.
  const int bore = bench.hole_group();
  bench.engine().label_at = [bore](int, int) { return bore; };
  bench.state().camera.pan(0, 1, 300);  // the labels are read anew
  const ImVec2 second = to_pixel(bench.studio().ui(), view_of(bench), Vec3(1, 0, 0));
  bench.click(second.x, second.y);
  REQUIRE(bench.state().measure.spots.size() == 2);
  const auto found = measured(bench.studio().ui());
  CHECK(found[0].what == "axis to plane");
  CHECK(found[0].value == doctest::Approx(10).epsilon(1e-4));
  bench.key(256);  // Esc
  CHECK(bench.state().tool == Tool::Select);
  CHECK(bench.state().measure.spots.empty());
}

TEST_CASE("a cut that ends at a corner goes through it; Alt leaves it as drawn") {
  Bench bench;
  CHECK(bench.key('1'));
  const PreparedMesh& prepared = *bench.session().document().prepared;
  const int front = find_groups(prepared, {{Vec3(10, -10, 0), -1}}, "").value().front();
  bench.engine().label_at = [front](int, int) { return front; };
  const Vec3 corner(20, -10, 4);
  const ImVec2 at = to_pixel(bench.studio().ui(), view_of(bench), corner);
  const std::vector<std::array<float, 2>> line = {
      {at.x - 200, at.y + 130}, {at.x - 90, at.y + 60}, {at.x + 3, at.y - 2}};
  const auto distance = [&] {
    const SnappedPlane& plane = *bench.state().knife.plane;
    return std::abs(plane.normal.dot(corner) - plane.offset);
  };
  CHECK(bench.key('K'));
  bench.drag(line);
  REQUIRE(bench.state().knife.plane);
  CHECK(distance() < 1e-9);
  CHECK(bench.state().knife.plane->snapped_to.find("corner") != std::string::npos);
  ImGui::GetIO().KeyAlt = true;
#if IMGUI_VERSION_NUM >= 18700
  ImGui::GetIO().AddKeyEvent(ImGuiMod_Alt, true);
#endif
  aim_knife(bench.studio().ui(), view_of(bench));
  CHECK(distance() > 1e-3);
}

TEST_CASE("a placed cut is taken up, moved and set down as one command") {
  Bench bench;
  REQUIRE(bench.session().execute(AddCut{{Vec3::UnitX(), 5, {}}}));
  bench.session().wait();
  bench.frames(2);
  const std::size_t depth = bench.session().history().depth();
  bench.state().tool = Tool::Knife;
  set_knife_plane(bench.studio().ui(), {Vec3::UnitX(), 5, ""});
  bench.state().knife.placed_cut = 0;
  set_knife_plane(bench.studio().ui(), {Vec3::UnitX(), 7, ""});
  CHECK(bench.key(kEnter));
  bench.session().wait();
  const auto& cuts = bench.session().document().project.cuts;
  REQUIRE(cuts.size() == 1);
  CHECK(cuts[0].offset == 7);
  CHECK(bench.session().history().depth() == depth + 1);
}

}  // namespace
}  // namespace hewn
