#include "core/session/suggest.h"

#include <doctest/doctest.h>

#include "tests/core/session/session_fixture.h"

namespace hewn {
namespace {

using testing::hole;
using testing::one_thread;
using testing::SessionFolder;

struct Solved {
  SessionFolder folder{"suggest"};
  Session session{one_thread()};
  Solved() {
    session.set_views(false);
    REQUIRE(session.execute(OpenFile{folder.plate()}));
    session.wait();
    REQUIRE(session.execute(Reconstruct{}));
    session.wait();
    REQUIRE(session.current_result());
  }
  const Tree& tree() const { return session.current_result()->found.tree; }
};

TEST_CASE("the hole of a plate is suggested as a partition that is taken away") {
  Solved solved;
  const auto plan = suggest_partitions(solved.session.document(), solved.tree());
  REQUIRE(plan);
  REQUIRE(plan->root.children.size() == 1);
  CHECK(plan->root.children[0].op == Op::Difference);
  REQUIRE(solved.session.execute(SetPlan{plan_text(*plan)}));
  const auto& views = solved.session.partitions();
  REQUIRE(views.size() == 2);
  CHECK(views[1].partition.groups == *find_groups(*solved.session.document().prepared, hole(), ""));
  // The plan that was suggested leads to as good a tree.
  REQUIRE(solved.session.execute(Reconstruct{}));
  solved.session.wait();
  REQUIRE(solved.session.current_result());
  CHECK(literal_count(solved.tree()) == 2);
  CHECK(solved.session.current_result()->found.score.iou > 0.99);
}

TEST_CASE("nothing is suggested for one literal, nor over the user's own partitions") {
  Solved solved;
  Tree one;
  one.root = one.add_literal(solved.tree().literals[0]);
  const auto none = suggest_partitions(solved.session.document(), one);
  REQUIRE_FALSE(none);
  CHECK(none.error().code == ErrorCode::InvalidArgument);
  const Tree tree = solved.tree();
  REQUIRE(solved.session.execute(AddPartition{{}, "mine", Op::Difference, hole()}));
  const auto second = suggest_partitions(solved.session.document(), tree);
  REQUIRE_FALSE(second);
  CHECK(second.error().message.size() > 10);
}

}  // namespace
}  // namespace hewn
