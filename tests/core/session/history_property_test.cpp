#include <doctest/doctest.h>

#include "core/base/rng.h"
#include "core/session/replay.h"
#include "tests/core/session/session_fixture.h"

namespace hewn {
namespace {

using testing::one_thread;
using testing::SessionFolder;

/// Draws commands, sensible ones and ones that must be refused.
class CommandSource {
 public:
  CommandSource(const Session& session, Rng& rng) : session_(session), rng_(rng) {}

  SessionCommand draw() {
    switch (rng_.below(15)) {
      case 14:
        return edit_literal();
      case 0:
        return cut();
      case 1:
        return DeleteCut{small()};
      case 2:
        return move_cut();
      case 3:
        return MergeGroups{groups()};
      case 4:
        return DeleteMerge{small()};
      case 5:
      case 6:
        return partition();
      case 7:
        return assign();
      case 8:
        return RemovePartition{path()};
      case 9:
        return rename();
      case 10:
        return set_op();
      case 11:
        return move();
      case 12:
        return colour();
      default:
        return rng_.coin() ? SessionCommand(Undo{}) : SessionCommand(Redo{});
    }
  }

 private:
  int small() { return static_cast<int>(rng_.below(3)); }

  CutStep random_cut() {
    CutStep step;
    step.normal = Vec3::Unit(static_cast<int>(rng_.below(3)));
    step.offset = rng_.uniform(-12, 12);
    if (rng_.coin()) step.groups = groups();
    return step;
  }

  /// Many cuts would only make the test slow.
  SessionCommand cut() {
    if (session_.document().project.cuts.size() >= 4) return DeleteCut{0};
    return AddCut{random_cut()};
  }

  SessionCommand move_cut() {
    const CutStep step = random_cut();
    const int which = small();
    return MoveCut{which, step.normal, step.offset};
  }

  std::vector<GroupRef> groups() {
    const auto& prepared = *session_.document().prepared;
    const std::size_t count = 1 + rng_.below(3);
    std::vector<int> chosen;
    for (std::size_t i = 0; i < count; ++i) {
      chosen.push_back(static_cast<int>(rng_.below(prepared.segmentation.groups.size())));
    }
    return refer_to(prepared, chosen);
  }

  PartitionPath path() {
    PartitionPath path;
    const PartitionPlan* plan = &session_.document().project.root;
    while (!plan->children.empty() && rng_.below(3) > 0) {
      path.push_back(static_cast<int>(rng_.below(plan->children.size())));
      plan = &plan->children[path.back()];
    }
    if (rng_.below(10) == 0) path.push_back(7);  // there is none
    return path;
  }

  Op op() {
    const Op ops[] = {Op::Union, Op::Difference, Op::Intersection};
    return ops[rng_.below(3)];
  }

  SessionCommand partition() {
    PartitionPath parent = path();
    const Op chosen = op();
    return AddPartition{std::move(parent), "", chosen, groups()};
  }
  SessionCommand assign() {
    PartitionPath target = path();
    return AssignGroups{std::move(target), groups()};
  }
  SessionCommand rename() {
    PartitionPath target = path();
    return RenamePartition{std::move(target), "name " + std::to_string(rng_.below(100))};
  }
  SessionCommand colour() {
    PartitionPath target = path();
    if (rng_.below(3) == 0) return ColourPartition{std::move(target), {}};
    return ColourPartition{std::move(target), static_cast<std::uint32_t>(rng_.below(1 << 24))};
  }
  SessionCommand edit_literal() {
    const int literal = small();
    return EditLiteral{{literal, rng_.coin() ? "radius" : "height", rng_.uniform(-1, 5)}};
  }
  SessionCommand set_op() {
    PartitionPath target = path();
    return SetPartitionOp{std::move(target), op()};
  }
  SessionCommand move() {
    PartitionPath from = path();
    PartitionPath to = path();
    return MovePartition{std::move(from), std::move(to), small()};
  }

  const Session& session_;
  Rng& rng_;
};

struct Tally {
  int done = 0, refused = 0;
};

void run_sequence(const std::filesystem::path& mesh, std::uint64_t seed, int length, Tally& tally) {
  CAPTURE(seed);
  Session session(one_thread());
  session.set_views(false);
  REQUIRE(session.execute(OpenFile{mesh}));
  session.wait();
  const std::string initial = plan_text(session.document().project);
  Rng rng(seed);
  CommandSource source(session, rng);
  for (int i = 0; i < length; ++i) {
    const std::string before = plan_text(session.document().project);
    if (session.execute(source.draw())) {
      ++tally.done;
    } else {
      ++tally.refused;
      REQUIRE(plan_text(session.document().project) == before);
    }
    REQUIRE(session.document().is_ready());
  }
  const std::string last = plan_text(session.document().project);
  const auto replayed = replay_log(session.log(), "log", one_thread());
  REQUIRE(replayed);
  REQUIRE(replayed->plan == last);

  const std::size_t depth = session.history().depth();
  while (session.history().can_undo()) REQUIRE(session.execute(Undo{}));
  REQUIRE(plan_text(session.document().project) == initial);
  REQUIRE(session.document().prepared->segmentation.groups.size() == 7);
  for (std::size_t i = 0; i < depth; ++i) REQUIRE(session.execute(Redo{}));
  REQUIRE(plan_text(session.document().project) == last);
}

TEST_CASE("undoing all gives the initial plan, replaying gives the last one, byte for byte") {
  const SessionFolder folder("property");
  const auto mesh = folder.plate();
#ifdef HEWN_SANITIZED
  constexpr int kSequences = 40;  // instrumented code is some ten times slower
#else
  constexpr int kSequences = 200;
#endif
  constexpr int kLength = 200;
  Tally tally;
  for (int i = 0; i < kSequences; ++i) run_sequence(mesh, 1000 + i, kLength, tally);
  // The test is worth something only when most kinds of commands get through.
  CHECK(tally.done > kSequences * kLength / 3);
  CHECK(tally.refused > kSequences * kLength / 20);
}

TEST_CASE("every kind of command survives its line") {
  const std::vector<GroupRef> refs = {{Vec3(0.1, 1e-9, -3), -1}, {std::nullopt, 4}};
  const std::vector<SessionCommand> commands = {
      AddCut{{Vec3(0.6, 0.8, 0), 1.0 / 3, refs}},
      MoveCut{2, Vec3::UnitY(), -0.1},
      DeleteCut{1},
      MergeGroups{refs},
      DeleteMerge{3},
      AddPartition{{0, 2}, "a \"b\" \xc3\xa4", Op::Intersection, refs},
      AssignGroups{{1}, refs},
      RemovePartition{{0}},
      RenamePartition{{0, 1}, "x"},
      ColourPartition{{0}, 0x00ff7f},
      SetPartitionOp{{0}, Op::Difference},
      MovePartition{{0}, {1, 0}, 2},
      SetOption{"tree", "starts", "2"},
      SetSeed{18446744073709551615ull},
      EditLiteral{{3, "radius", 0.1}},
      SetPlan{"{}\n"},
      OpenFile{"a b.stl"},
      SaveProject{"p.json"},
      Reconstruct{},
      ExportTree{"out.scad", true},
      Undo{},
      Redo{}};
  REQUIRE(commands.size() == std::variant_size_v<SessionCommand>);
  for (std::size_t i = 0; i < commands.size(); ++i) {
    const std::string line = command_to_line(commands[i]);
    CAPTURE(line);
    CHECK(line.find('\n') == std::string::npos);
    const auto read = command_from_line(line);
    REQUIRE(read);
    CHECK(read->index() == i);
    CHECK(command_to_line(*read) == line);
  }
}

}  // namespace
}  // namespace hewn
