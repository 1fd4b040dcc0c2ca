#include "core/session/found_partitions.h"

#include <doctest/doctest.h>

#include "core/session/session.h"
#include "tests/core/session/session_fixture.h"

namespace hewn {
namespace {

using testing::hole;
using testing::OpenSession;
using State = PartProgress::State;

TEST_CASE("a partition's key tells what its tree depends on, and nothing else") {
  Project project;
  Partition partition;
  partition.groups = {1, 2};
  const std::string key = partition_key(project, partition);
  Partition other = partition;
  other.name = "another";
  other.op = Op::Intersection;
  Project renamed = project;
  renamed.root.name = "part 2";
  CHECK(partition_key(renamed, other) == key);
  other.groups = {1, 3};
  CHECK(partition_key(project, other) != key);
  other = partition;
  other.is_subtracted = true;
  CHECK(partition_key(project, other) != key);
  Project seeded = project;
  seeded.seed = 5;
  CHECK(partition_key(seeded, partition) != key);
}

TEST_CASE("what was searched before is not searched again, and the tree is the same") {
  OpenSession open;
  REQUIRE(open.session.execute(AddPartition{{}, "holes", Op::Difference, hole()}));
  const Document& document = open.session.document();
  const auto segmented = [&] {
    SegmentedMesh out;
    out.report = document.source->report;
    out.prepared = *document.prepared;
    return out;
  };
  FoundPartitions memory;
  SearchWatch watch;
  watch.found = &memory;
  const RunContext run = testing::one_thread();
  const auto first = reconstruct(document.project, segmented(), run, watch);
  REQUIRE(first);
  REQUIRE(first->partitions.size() == 2);

  const auto partitions = resolve_partitions(document.project, *document.prepared, run);
  REQUIRE(partitions);
  PartitionResult marked = *memory.find(partition_key(document.project, partitions->at(1)));
  CHECK(marked.answer.terms_grown == first->partitions[1].answer.terms_grown);
  marked.answer.terms_grown = -7;  // to know it again
  memory.keep(partition_key(document.project, partitions->at(1)), marked);

  Project renamed = document.project;
  renamed.root.children[0].name = "bores";
  const auto second = reconstruct(renamed, segmented(), run, watch);
  REQUIRE(second);
  CHECK(second->partitions[1].answer.terms_grown == -7);
  CHECK(second->partitions[1].name == "bores");
  CHECK(second->partitions[1].area_share == first->partitions[1].area_share);
  CHECK(tree_size(second->tree) == tree_size(first->tree));
}

TEST_CASE("one partition can be stopped; the others are there when it is tried again") {
  OpenSession open;
  Session& session = open.session;
  REQUIRE(session.execute(AddPartition{{}, "holes", Op::Difference, hole()}));
  REQUIRE(session.execute(Reconstruct{}));
  session.stop_partition("holes");
  session.wait();
  const auto parts = session.partition_progress();
  REQUIRE(parts.size() == 2);
  CHECK(parts[0].state == State::Done);
  CHECK(parts[1].state == State::Stopped);
  CHECK_FALSE(session.current_result());
  CHECK(session.failure().empty());
  REQUIRE(session.execute(Reconstruct{}));
  session.wait();
  REQUIRE(session.current_result());
  CHECK(literal_count(session.current_result()->found.tree) == 2);
}

}  // namespace
}  // namespace hewn
