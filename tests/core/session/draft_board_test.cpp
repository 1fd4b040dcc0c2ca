#include "core/session/draft_board.h"

#include <doctest/doctest.h>

#include "core/session/reconstruct.h"
#include "tests/core/csg/box.h"
#include "tests/core/session/session_fixture.h"

namespace hewn {
namespace {

Tree one_box(double size) {
  Tree tree;
  tree.root = tree.add_literal(testing::box({0, 0, 0}, Vec3::Constant(size)));
  return tree;
}

TEST_CASE("drafts are shown once every searched partition has one") {
  int shown = 0;
  double last = 0;
  DraftBoard board({true, false, true}, [&](const auto& trees) {
    ++shown;
    REQUIRE(trees.size() == 3);
    CHECK_FALSE(trees[1]);
    last = trees[0]->literals[0].size.x();
  });
  board.update(0, [] { return one_box(1); });
  CHECK(shown == 0);
  board.update(2, [] { return one_box(2); });
  CHECK(shown == 1);
  CHECK(last == 1);
}

TEST_CASE("drafts that nobody would see in time are not even made") {
  DraftBoard board({true}, [&](const auto&) {
    const auto until = std::chrono::steady_clock::now() + std::chrono::milliseconds(50);
    while (std::chrono::steady_clock::now() < until) continue;
  });
  int made = 0;
  const auto make = [&made] {
    ++made;
    return one_box(1);
  };
  board.update(0, make);
  board.update(0, make);  // within the 200 ms of rest that showing for 50 asks for
  CHECK(made == 1);
}

TEST_CASE("a search shows a measured draft, and ends as it does without") {
  const testing::SessionFolder folder("draft");
  Project project;
  project.mesh = folder.plate();
  project.root.name = "body";
  const RunContext run = testing::one_thread();
  auto segmented = segment_project(project, run);
  REQUIRE(segmented);
  std::vector<Reconstruction> drafts;
  SearchWatch watch;
  watch.on_draft = [&drafts](Reconstruction draft) { drafts.push_back(std::move(draft)); };
  const auto watched = reconstruct(project, *segmented, run, watch);
  const auto alone = reconstruct(project, *segmented, run);
  REQUIRE(watched);
  REQUIRE(alone);
  REQUIRE_FALSE(drafts.empty());
  CHECK(literal_count(drafts.front().tree) >= literal_count(watched->tree));
  CHECK(drafts.front().score.iou > 0.9);
  CHECK(tree_size(watched->tree) == tree_size(alone->tree));
  CHECK(watched->score.hausdorff == alone->score.hausdorff);
}

}  // namespace
}  // namespace hewn
