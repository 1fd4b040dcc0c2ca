#include "core/session/part_board.h"

#include <doctest/doctest.h>

#include "core/session/part_report.h"
#include "tests/core/session/session_fixture.h"

namespace hewn {
namespace {

using State = PartProgress::State;
using testing::hole;
using testing::OpenSession;

TEST_CASE("parts keep the order of their first word, bars never go back, ends are final") {
  PartBoard board;
  board.update({.name = "body"});
  board.update({.name = "holes"});
  board.update({.name = "holes", .state = State::Running, .stage = "search", .share = 0.5});
  board.update({.name = "holes", .state = State::Running, .stage = "verify", .share = 0.2});
  auto parts = board.parts();
  REQUIRE(parts.size() == 2);
  CHECK(parts[0].name == "body");
  CHECK(parts[0].state == State::Waiting);
  CHECK(parts[1].stage == "verify");
  CHECK(parts[1].share == 0.5);
  board.update({.name = "holes", .state = State::Failed, .reason = "no"});
  board.update({.name = "holes", .state = State::Running});
  board.stop();
  parts = board.parts();
  CHECK(parts[0].state == State::Stopped);
  CHECK(parts[1].state == State::Failed);
  CHECK(parts[1].reason == "no");
}

TEST_CASE("every partition of a search waits, and is done with its size and error in the end") {
  OpenSession open;
  Session& session = open.session;
  CHECK(session.partition_progress().empty());
  REQUIRE(session.execute(AddPartition{{}, "holes", Op::Difference, hole()}));
  REQUIRE(session.execute(Reconstruct{}));
  const auto before = session.partition_progress();
  REQUIRE(before.size() == 2);
  CHECK_FALSE(before[1].has_ended());  // the worker may have begun
  session.wait();
  const auto after = session.partition_progress();
  REQUIRE(after.size() == 2);
  CHECK(after[0].name == "body");
  CHECK(after[1].name == "holes");
  for (const PartProgress& part : after) {
    CHECK(part.state == State::Done);
    CHECK(part.literals == 1);
    CHECK(part.size == 1);
    CHECK(part.error < 0.01);
  }
  // Another plan knows nothing yet; undo brings the states back with the result.
  REQUIRE(session.execute(SetPartitionOp{{0}, Op::Union}));
  CHECK(session.partition_progress().empty());
  REQUIRE(session.execute(Undo{}));
  CHECK(session.partition_progress().size() == 2);
}

TEST_CASE("a report ends as its search did: done, failed with the reason, or stopped") {
  PartBoard board;
  const auto end = [&board](const std::string& name, const Result<PartitionResult>& result) {
    PartReport report(&board, name);
    report.begin();
    report.running("verify", 0.75);
    CHECK(board.parts().back().stage == "verify");
    CHECK(board.parts().back().share == 0.75);
    report.end(result);
    return board.parts().back();
  };
  PartitionResult found;
  found.answer.tree.root = found.answer.tree.add_literal({});
  found.answer.agreement = 0.75;
  const PartProgress done = end("body", found);
  CHECK(done.state == State::Done);
  CHECK(done.literals == 1);
  CHECK(done.size == 1);
  CHECK(done.error == 0.25);
  const PartProgress failed = end("rib", Error{ErrorCode::NotFound, "no halfspaces; cut it"});
  CHECK(failed.state == State::Failed);
  CHECK(failed.reason == "no halfspaces; cut it");
  CHECK(end("hole", RunContext::cancelled()).state == State::Stopped);
  CHECK(board.parts().size() == 3);
}

TEST_CASE("a cancelled search leaves its partitions stopped, and can be run again") {
  OpenSession open;
  Session& session = open.session;
  REQUIRE(session.execute(AddPartition{{}, "holes", Op::Difference, hole()}));
  REQUIRE(session.execute(Reconstruct{}));
  session.cancel_jobs();
  session.wait();
  if (!session.current_result()) {  // the worker may have been faster
    for (const PartProgress& part : session.partition_progress()) {
      CHECK(part.has_ended());
      CHECK(part.state != State::Failed);
    }
  }
  REQUIRE(session.execute(Reconstruct{}));
  session.wait();
  REQUIRE(session.current_result());
  CHECK(session.partition_progress()[1].state == State::Done);
}

}  // namespace
}  // namespace hewn
