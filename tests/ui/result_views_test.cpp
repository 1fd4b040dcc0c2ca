/// Outline, graph and exact pictures of a result, and the one selection behind them.
#include <chrono>
#include <thread>

#include <doctest/doctest.h>

#include "tests/ui/bench.h"
#include "ui/panels/tree_marks.h"
#include "ui/view/look.h"

namespace hewn {
namespace {

using testing::Bench;

/// The plate less its hole, found and shown.
void solve(Bench& bench) {
  bench.session().set_views(true);
  REQUIRE(bench.session().execute(Reconstruct{}));
  for (int i = 0; i < 3; ++i) {
    bench.session().wait();
    bench.session().poll();
  }
  REQUIRE(bench.session().result_view());
  bench.frames(3);
}

const Tree& tree_of(Bench& bench) { return bench.session().shown_result()->found.tree; }

/// The flags of the two literals.
std::array<int, 2> flags(Bench& bench) {
  const auto states = literal_states(bench.studio().ui());
  REQUIRE(states.size() == 2);
  return {states[0].flags, states[1].flags};
}

TEST_CASE("a picked operation marks all that lies below it, a literal only itself") {
  Bench bench;
  solve(bench);
  Ui& ui = bench.studio().ui();
  const Tree& tree = tree_of(bench);
  const int root = tree.root;
  const int leaf = tree.nodes[root].children[1];
  CHECK(flags(bench) == std::array<int, 2>{0, 0});
  pick_node(ui, tree, root);
  CHECK(is_marked(ui, tree, root));
  CHECK_FALSE(is_marked(ui, tree, leaf));
  CHECK(flags(bench) == std::array<int, 2>{kSelectedFlag, kSelectedFlag});
  pick_node(ui, tree, leaf);
  CHECK(bench.state().picked_node == -1);
  const int literal = tree.nodes[leaf].literal;
  CHECK(flags(bench)[literal] == kSelectedFlag);
  CHECK(flags(bench)[1 - literal] == kFadedFlag);
  pick_node(ui, tree, leaf);  // once more gives it up
  CHECK(flags(bench) == std::array<int, 2>{0, 0});
  hover_node(ui, tree, root);
  CHECK(flags(bench) == std::array<int, 2>{kHoveredFlag, kHoveredFlag});
}

TEST_CASE("a node under the mouse shows what it explains of the mesh") {
  Bench bench;
  solve(bench);
  Ui& ui = bench.studio().ui();
  CHECK(build_scene(ui, {}).items[0].slot == MeshSlot::Input);
  hover_node(ui, tree_of(bench), tree_of(bench).root);
  CHECK(build_scene(ui, {}).items[0].slot == MeshSlot::Measured);
}

/// Clicks through the right panel's tabs until one shows the graph.
bool open_graph(Bench& bench) {
  for (float y = 230; y < 300; y += 6) {
    for (float x = 1000; x < 1100; x += 12) {
      bench.click(x, y);
      if (bench.state().shows_graph) return true;
    }
  }
  return false;
}

TEST_CASE("nodes of the graph are hovered and picked by the mouse, the wheel zooms at it") {
  Bench bench;
  solve(bench);
  REQUIRE(open_graph(bench));
  bench.state().picked_literal = bench.state().picked_node = -1;
  ImGuiIO& io = ImGui::GetIO();
  bool picked = false;
  for (float y = 280; y < 690 && !picked; y += 8) {
    for (float x = 980; x < 1270 && !picked; x += 12) {
      io.MousePos = {x, y};
      bench.frames(2);
      if (bench.state().hovered_literal < 0) continue;
      const int hovered = bench.state().hovered_literal;
      bench.click(x, y);
      picked = bench.state().picked_literal == hovered;
    }
  }
  CHECK(picked);
  // What lies under the mouse stays there.
  const GraphState before = bench.state().graph;
  io.MousePos = {1100, 320};
  bench.frames(1);
  io.MouseWheel = 2;
  bench.frames(1);
  const GraphState& after = bench.state().graph;
  CHECK(after.zoom > before.zoom);
  const double share_before = (320 - before.pan_y) / before.zoom;
  const double share_after = (320 - after.pan_y) / after.zoom;
  // The panel's own middle is unknown here, but the same for both.
  const double corner = (share_before - share_after) / (1 / before.zoom - 1 / after.zoom);
  CHECK(corner > 300);
  CHECK(corner < 600);
}

TEST_CASE("the result is drawn exactly at rest, by triangles as wires and when told so") {
  Bench bench;
  solve(bench);
  CHECK(bench.session().result_view()->program);
  CHECK(bench.key('R'));
  CHECK(build_scene(bench.studio().ui(), {}).items[0].is_exact);
  bench.frames(2);
  std::this_thread::sleep_for(std::chrono::milliseconds(200));
  bench.frames(2);
  REQUIRE_FALSE(bench.engine().last.items.empty());
  CHECK(bench.engine().last.items[0].is_exact);
  CHECK(bench.state().exact_now.is_exact);
  CHECK(bench.key('W'));
  CHECK_FALSE(bench.engine().last.items[0].is_exact);
  CHECK(bench.key('W'));
  CHECK(bench.key('E'));  // always
  CHECK(bench.state().exact == ExactMode::On);
  CHECK(bench.engine().last.items[0].is_exact);
  CHECK(bench.key('E'));  // never
  CHECK_FALSE(bench.engine().last.items[0].is_exact);
}

TEST_CASE("an engine that cannot draw the tree is told apart, with its reason") {
  struct Refuses : testing::PaintedEngine {
    std::string show_tree(const TreeProgram* tree) override { return tree ? "too old" : ""; }
  };
  Bench bench(std::make_unique<Refuses>());
  solve(bench);
  CHECK(bench.key('R'));
  bench.state().exact = ExactMode::On;
  bench.frames(2);
  CHECK_FALSE(bench.engine().last.items[0].is_exact);
  CHECK(bench.state().exact_now.problem == "too old");
}

}  // namespace
}  // namespace hewn
