#include "ui/studio.h"

#include <set>

#include <doctest/doctest.h>

#include "tests/ui/bench.h"
#include "ui/panels/panels.h"
#include "ui/tools/knife.h"
#include "ui/view/look.h"
#include "ui/view/unlike_colours.h"

namespace hewn {
namespace {

constexpr int kEnter = 257, kEscape = 256, kSpace = 32;

using testing::Bench;

TEST_CASE("every action has a key of its own, a help text and a title of its own") {
  std::set<std::pair<int, int>> keys;
  std::set<std::string> titles;
  for (const Action& action : make_actions()) {
    CAPTURE(action.title);
    CHECK(titles.insert(action.title).second);
    CHECK(std::string(action.help).size() > 10);
    if (action.key == 0) continue;
    CHECK(keys.insert({action.key, action.mods}).second);
    CHECK_FALSE(shortcut_text(action).empty());
    if (action.key != '=') CHECK(shortcut_text(action).back() != '+');
  }
  CHECK(titles.size() > 40);
}

TEST_CASE("Shift+P subtracts the selected groups, Ctrl+Z gives them back") {
  Bench bench;
  CHECK_FALSE(bench.key('P', kShift));  // nothing is selected
  bench.state().selected = {bench.hole_group()};
  CHECK(bench.key('P', kShift));
  const PartitionPlan& root = bench.session().document().project.root;
  REQUIRE(root.children.size() == 1);
  CHECK(root.children[0].op == Op::Difference);
  CHECK(bench.state().selected.empty());
  CHECK(bench.key('Z', kCtrl));
  CHECK(bench.session().document().project.root.children.empty());
  CHECK(bench.key('Z', kCtrl | kShift));
  CHECK(bench.session().document().project.root.children.size() == 1);
}

TEST_CASE("the knife's plane from numbers is cut on Enter and left on Esc") {
  Bench bench;
  CHECK(bench.key('K'));
  CHECK(bench.state().tool == Tool::Knife);
  CHECK_FALSE(bench.key(kEnter));  // no plane yet
  set_knife_plane(bench.studio().ui(), {Vec3::UnitX(), 10, ""});
  CHECK(bench.state().knife.crossed == 4);
  const Scene scene = build_scene(bench.studio().ui(), {0, 0, 800, 600});
  CHECK(scene.has_knife);
  CHECK(scene.sheets.size() == 1);
  CHECK(bench.key(kEnter));
  CHECK(bench.session().document().prepared->segmentation.groups.size() == 11);
  CHECK(bench.state().tool == Tool::Select);
  CHECK(bench.key('K'));
  CHECK(bench.key(kEscape));
  CHECK(bench.state().tool == Tool::Select);
}

TEST_CASE("a line across the middle of the top view cuts along an axis") {
  Bench bench;
  CHECK(bench.key('7'));
  StudioState& state = bench.state();
  const ViewArea area{0, 0, 800, 600};
  state.knife.from = {500, 100};
  state.knife.to = {503, 500};  // half a degree off
  aim_knife(bench.studio().ui(), area);
  REQUIRE(state.knife.plane);
  CHECK(std::abs(state.knife.plane->normal.x()) == doctest::Approx(1));
  CHECK(state.knife.plane->snapped_to.find("x axis") != std::string::npos);
  // 100 pixels right of the middle, in model units at the target's depth.
  const double expected = 101.5 * state.camera.unit_per_pixel(600);
  CHECK(std::abs(state.knife.plane->offset) == doctest::Approx(expected).epsilon(1e-6));
}

TEST_CASE("hidden groups cannot be selected and come back") {
  Bench bench;
  bench.state().selected = {0, 1};
  CHECK(bench.key('H'));
  CHECK(bench.key('A', kCtrl));
  CHECK(bench.state().selected == std::vector<int>{2, 3, 4, 5, 6});
  CHECK(group_states(bench.studio().ui())[0].flags == kHiddenFlag);
  CHECK(bench.key('H', kAlt));
  CHECK(bench.state().hidden.empty());
  bench.state().selected = {3};
  CHECK(bench.key('H', kShift));
  CHECK(bench.state().hidden == std::set<int>{0, 1, 2, 4, 5, 6});
}

TEST_CASE("selections grow, shrink and find their like") {
  Bench bench;
  const int hole = bench.hole_group();
  bench.state().selected = {hole};
  CHECK(bench.key('='));
  CHECK(bench.state().selected.size() == 3);  // the wall, top and bottom
  CHECK(bench.key('-'));
  CHECK(bench.state().selected == std::vector<int>{hole});
  CHECK(bench.key('I', kCtrl));
  CHECK(bench.state().selected.size() == 6);
  bench.state().selected = {bench.state().selected.front()};
  CHECK(bench.key('S'));
  CHECK(bench.state().selected.size() == 6);  // all planes
  CHECK(bench.key(kEscape));
  CHECK(bench.state().selected.empty());
}

TEST_CASE("faces side by side get unlike colours") {
  // Numbers that are 21 or 34 apart have nearly the same hue.
  DisplayMesh mesh;
  mesh.labels = 60;
  const auto meet = [&mesh](int a, int b) {
    mesh.lines.push_back({{}, {a, b}});
    mesh.lines.push_back({{}, {a, b}});
  };
  meet(0, 21);
  meet(34, 0);
  meet(21, 34);
  meet(5, 5);
  for (int g = 1; g < 60; ++g) meet(0, g);
  const auto numbers = unlike_colours(mesh);
  const auto differ = [&](int a, int b) {
    const LabelState first = golden_state(numbers[a]);
    const LabelState second = golden_state(numbers[b]);
    return std::abs(first.red - second.red) + std::abs(first.green - second.green) +
           std::abs(first.blue - second.blue);
  };
  CHECK(numbers[3] == 3);
  CHECK(differ(21, 34) > 60);
  for (int g = 1; g < 60; ++g) CHECK(differ(0, g) > 60);
}

TEST_CASE("colours tell what they are asked to") {
  Bench bench;
  Ui& ui = bench.studio().ui();
  CHECK(bench.key('2', kCtrl));
  const auto kinds = group_states(ui);
  const LabelState hole = kinds[bench.hole_group()];
  CHECK(hole == kind_state(SurfaceKind::Cylinder, true));
  CHECK(bench.key('3', kCtrl));
  bench.state().selected = {bench.hole_group()};
  CHECK(bench.key('P'));
  const auto owners = group_states(ui);
  std::set<int> reds;
  for (const LabelState& state : owners) reds.insert(state.red);
  CHECK(reds.size() == 2);  // two partitions
  REQUIRE(bench.session().execute(ColourPartition{{0}, 0x102030}));
  CHECK(group_states(ui)[bench.hole_group()] == LabelState{0x10, 0x20, 0x30, 0});
  bench.state().hovered = 2;
  CHECK((group_states(ui)[2].flags & kHoveredFlag) != 0);
}

TEST_CASE("a tree that was asked for is shown when it comes") {
  Bench bench;
  bench.session().set_views(true);
  Ui& ui = bench.studio().ui();
  const ViewArea area{0, 0, 800, 600};
  CHECK(bench.key('R', kCtrl));
  CHECK(build_scene(ui, area).items[0].slot == MeshSlot::Input);
  bench.session().wait();
  bench.session().poll();
  bench.session().wait();
  REQUIRE(bench.session().result_view());
  CHECK(build_scene(ui, area).items[0].slot == MeshSlot::Surface);
}

TEST_CASE("Space, held, shows the input alone") {
  Bench bench;
  bench.session().set_views(true);
  REQUIRE(bench.session().execute(Reconstruct{}));
  bench.session().wait();
  bench.session().poll();
  bench.session().wait();
  REQUIRE(bench.session().result_view());
  CHECK(bench.key('R'));
  Ui& ui = bench.studio().ui();
  const ViewArea area{0, 0, 800, 600};
  CHECK(build_scene(ui, area).items[0].slot == MeshSlot::Surface);
  bench.studio().key(kSpace, 0, true);
  CHECK(build_scene(ui, area).items[0].slot == MeshSlot::Input);
  bench.studio().key(kSpace, 0, false);
  CHECK(build_scene(ui, area).items[0].slot == MeshSlot::Surface);
  CHECK(bench.key('O'));
  CHECK(build_scene(ui, area).items.size() == 2);
  CHECK(bench.key('I'));
  CHECK(bench.key('4', kCtrl));
  CHECK(build_scene(ui, area).items[0].shows_deviation);
}

TEST_CASE("the palette runs the command that is typed") {
  Bench bench;
  CHECK(bench.key('K', kCtrl));
  bench.frames(2);
  for (const char c : std::string("x-ray")) ImGui::GetIO().AddInputCharacter(c);
  bench.frames(3);
  CHECK(bench.state().palette_text == "x-ray");
  CHECK_FALSE(bench.key('X'));  // the letter belongs to the text
  ImGuiIO& io = ImGui::GetIO();
#if IMGUI_VERSION_NUM >= 18700
  io.AddKeyEvent(ImGuiKey_Enter, true);
#else
  io.KeyMap[ImGuiKey_Enter] = kEnter;
  io.KeysDown[kEnter] = true;
#endif
  bench.frames(2);
  CHECK(bench.state().is_xray);
  CHECK_FALSE(bench.state().shows_palette);
}

TEST_CASE("a click on a group's row selects it") {
  Bench bench;
  // Rows stand below the partitions; the first below the heading of the groups.
  bool found = false;
  for (float y = 120; y < 300 && !found; y += 8) {
    bench.click(120, y);
    found = bench.state().selected.size() == 1;
  }
  CHECK(found);
}

TEST_CASE("sections go through the middle across x, y and z in turn") {
  Bench bench;
  for (int k = 0; k < 3; ++k) {
    CHECK(bench.key('C'));
    REQUIRE(bench.state().section);
    CHECK(bench.state().section->normal == Vec3::Unit(k));
    const Box3& bounds = bench.session().document().prepared->mesh->bounds;
    CHECK(bench.state().section->offset == bounds.center()[k]);
  }
  CHECK(bench.key('C'));
  CHECK(!bench.state().section);
}

TEST_CASE("panels fold away and give the part their room") {
  Bench bench;
  const int before = bench.studio().backing().picture_x;
  CHECK(bench.key('B', kCtrl));
  bench.frames(2);
  CHECK(bench.studio().backing().picture_x < before);
  CHECK(bench.key('B', kCtrl | kShift));
  bench.frames(2);
  CHECK_FALSE(bench.state().shows_result);
  CHECK(bench.key('B', kCtrl));
  bench.frames(2);
  CHECK(bench.studio().backing().picture_x == before);
}

TEST_CASE("a plan that is not saved is asked about before it goes") {
  Bench bench;
  const int quit = 'Q';
  bench.state().selected = {bench.hole_group()};
  REQUIRE(bench.key('P', kShift));
  CHECK(bench.key(quit, kCtrl));
  CHECK_FALSE(bench.state().wants_close);
  REQUIRE(bench.state().leaving);
  CHECK(bench.key(kEscape));
  CHECK_FALSE(bench.state().leaving);
  // Another mesh does not take its place unasked.
  const std::filesystem::path mesh = bench.session().document().project.mesh;
  CHECK(request_open(bench.studio().ui(), mesh));
  REQUIRE(bench.state().leaving);
  CHECK(bench.session().document().project.root.children.size() == 1);
  leave_now(bench.studio().ui());
  CHECK_FALSE(bench.state().leaving);
  bench.session().wait();
  CHECK(bench.session().document().project.root.children.empty());
  // Nothing is unsaved now.
  CHECK(bench.key(quit, kCtrl));
  CHECK(bench.state().wants_close);
}

TEST_CASE("asked to quit once more, the window closes") {
  Bench bench;
  bench.state().selected = {bench.hole_group()};
  REQUIRE(bench.key('P', kShift));
  CHECK(bench.key('Q', kCtrl));
  CHECK(bench.key('Q', kCtrl));
  CHECK(bench.state().wants_close);
}

TEST_CASE("settings are found by name, changed by commands and undone") {
  Bench bench;
  CHECK(bench.key(',', kCtrl));
  REQUIRE(bench.state().shows_settings);
  bench.state().settings_filter = "--regularise-round-values";
  bench.frames(3);
  const auto is_round = [&bench] {
    return bench.session().document().project.settings.regularise.round_values;
  };
  REQUIRE(is_round());
  // The one box that is left stands somewhere in the panel's column of values.
  const float x = 1280 - bench.state().right_width - 200;
  for (float y = 140; y < 400 && is_round(); y += 6) bench.click(x, y);
  CHECK_FALSE(is_round());
  CHECK(bench.key('Z', kCtrl));
  CHECK(is_round());
  CHECK(bench.key(kEscape));
  CHECK_FALSE(bench.state().shows_settings);
}

TEST_CASE("every option is on the settings panel, and the log opens") {
  Bench bench;
  CHECK(bench.key(',', kCtrl));
  bench.state().settings_filter = "-";  // all sections open
  bench.frames(3);
  CHECK(bench.key('J', kCtrl));
  bench.frames(3);
  CHECK(bench.state().shows_log);
  CHECK(bench.key(kEscape));
  CHECK_FALSE(bench.state().shows_log);
}

TEST_CASE("the text of both themes can be read") {
  const auto luminance = [](const ImVec4& c) {
    const glm::vec3 l = to_linear(c);
    return 0.2126 * l.r + 0.7152 * l.g + 0.0722 * l.b;
  };
  const auto contrast = [&](const ImVec4& a, const ImVec4& b) {
    const double x = luminance(a);
    const double y = luminance(b);
    return (std::max(x, y) + 0.05) / (std::min(x, y) + 0.05);
  };
  for (const Theme& theme : {dark_theme(), light_theme()}) {
    for (const ImVec4& ground : {theme.background, theme.panel, theme.raised}) {
      for (const ImVec4& text : {theme.text, theme.faint, theme.bad, theme.warning}) {
        CHECK(contrast(text, ground) >= 4.5);
      }
    }
  }
}

TEST_CASE("view settings survive, and nonsense in their file does no harm") {
  Bench bench;
  const testing::SessionFolder folder("settings");
  bench.state().is_light = true;
  bench.state().left_width = 300;
  REQUIRE(bench.studio().save_settings(folder / "s" / "studio.json"));
  Bench* const other = &bench;
  other->state().is_light = false;
  other->state().left_width = 264;
  other->studio().load_settings(folder / "s" / "studio.json");
  CHECK(other->state().is_light);
  CHECK(other->state().left_width == 300);
}

}  // namespace
}  // namespace hewn
