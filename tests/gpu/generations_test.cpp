/// Generations of trees that breed on a device, against the same on the host, on every device.
#include "core/compute/generations.h"

#include <algorithm>
#include <memory>

#include <doctest/doctest.h>

#include "core/compute/compute.h"
#include "tests/gpu/failing_device.h"
#include "tests/gpu/random_tree.h"
#include "tests/gpu/test_device.h"

namespace hewn {
namespace {

using testing::device_under_test;
using Trees = std::vector<std::vector<Token>>;

constexpr std::size_t kPrimitives = 9;
constexpr std::size_t kSamples = 200;
constexpr BreedingRules kRules{kPrimitives, 60, 0.4, 0.5, 2};
constexpr TreeWorth kWorth{2.0 * SurfaceScoreKernel::kLargestScore * kSamples, 1e-3};

SurfaceScores random_scores(std::uint64_t seed) {
  Rng rng(seed);
  SurfaceScores scores(kPrimitives, kSamples);
  for (std::size_t k = 0; k < kPrimitives; ++k) {
    for (std::size_t i = 0; i < kSamples; ++i) {
      SampleScore s;
      s.distance = static_cast<float>(rng.uniform(-1, 1));
      s.score = static_cast<std::uint32_t>(rng.below(SurfaceScoreKernel::kLargestScore));
      s.turned_score = static_cast<std::uint32_t>(rng.below(SurfaceScoreKernel::kLargestScore));
      scores.set(k, i, s);
    }
  }
  return scores;
}

Trees random_trees(std::size_t count, std::uint64_t seed) {
  Rng rng(seed);
  Trees trees(count);
  for (auto& tree : trees) {
    do {
      tree.clear();
      testing::append_random_tree(tree, 1 + rng.below(20), kPrimitives, rng);
    } while (tree.size() > static_cast<std::size_t>(kRules.most_tokens));
  }
  return trees;
}

bool is_complete(const std::vector<Token>& tree) {
  int open = 0;
  for (const Token t : tree) {
    if (t >= static_cast<Token>(kPrimitives)) return false;
    if (t >= 0) ++open;
    if (t < 0 && t != kComplementToken) --open;
    if (open < 1) return false;
  }
  return open == 1;
}

Trees all_of(const Generations& generations) {
  Trees trees;
  for (std::size_t t = 0; t < generations.size(); ++t) {
    const auto tree = generations.tree(t);
    REQUIRE(tree.has_value());
    trees.push_back(*tree);
  }
  return trees;
}

/// The best and the last tree pass on.
std::vector<std::int32_t> elite_of(const Generations& generations) {
  std::size_t best = 0;
  for (std::size_t t = 1; t < generations.size(); ++t) {
    if (generations.score(t) > generations.score(best)) best = t;
  }
  return {static_cast<std::int32_t>(best), static_cast<std::int32_t>(generations.size() - 1)};
}

/// Some generations later.
Result<void> breed_some(Generations& generations, const Trees& first, int count,
                        const RunContext& run) {
  if (auto done = generations.begin(first, run); !done) return done;
  for (int i = 0; i < count; ++i) {
    const auto done = generations.breed(elite_of(generations), static_cast<std::uint64_t>(i), run);
    if (!done) return done;
  }
  return {};
}

TEST_CASE("generations are the same to the bit, and their scores those of a batch") {
  const auto device = device_under_test();
  if (!device) return;
  CpuDevice plain = testing::plain_device();
  for (const std::size_t count : {2, 31, 150}) {
    const Trees first = random_trees(count, count);
    SurfaceScores scores = random_scores(71);
    SurfaceScores plain_scores = random_scores(71);
    Generations own(*device, scores, kRules, kWorth);
    Generations known(plain, plain_scores, kRules, kWorth);
    REQUIRE(breed_some(own, first, 12, {}).has_value());
    REQUIRE(breed_some(known, first, 12, {}).has_value());
    const Trees trees = all_of(own);
    REQUIRE(trees == all_of(known));
    TreeBatch batch;
    for (const auto& tree : trees) {
      REQUIRE(is_complete(tree));
      REQUIRE(tree.size() <= static_cast<std::size_t>(kRules.most_tokens));
      batch.add(tree);
    }
    std::vector<std::uint64_t> totals(count);
    REQUIRE(plain_scores.measure(plain, batch, totals, {}).has_value());
    for (std::size_t t = 0; t < count; ++t) {
      REQUIRE(own.fit(t) == kWorth.fit(totals[t]));
      REQUIRE(own.score(t) == kWorth.score(totals[t], static_cast<std::int32_t>(trees[t].size())));
    }
  }
}

TEST_CASE("the elite passes on, and children differ from generation to generation") {
  const auto device = device_under_test();
  if (!device) return;
  SurfaceScores scores = random_scores(72);
  Generations generations(*device, scores, kRules, kWorth);
  REQUIRE(generations.begin(random_trees(40, 72), {}).has_value());
  const Trees before = all_of(generations);
  REQUIRE(generations.breed(std::vector<std::int32_t>{17, 3}, 1, {}).has_value());
  const Trees after = all_of(generations);
  CHECK(after[0] == before[17]);
  CHECK(after[1] == before[3]);
  REQUIRE(generations.breed({}, 1, {}).has_value());
  CHECK(all_of(generations) != after);
}

TEST_CASE("selection raises the score") {
  const auto device = device_under_test();
  if (!device) return;
  SurfaceScores scores = random_scores(73);
  Generations generations(*device, scores, kRules, kWorth);
  const auto best = [&] {
    return generations.score(static_cast<std::size_t>(elite_of(generations)[0]));
  };
  REQUIRE(generations.begin(random_trees(100, 73), {}).has_value());
  const double before = best();
  REQUIRE(breed_some(generations, random_trees(100, 73), 40, {}).has_value());
  CHECK(best() > before);
}

TEST_CASE("a device lost at any call leaves the same generations") {
  const Trees first = random_trees(12, 74);
  const auto bred_on = [&first](Compute& compute, const RunContext& run) {
    SurfaceScores scores = random_scores(74);
    Trees trees;
    const auto job = [&](Device& device) -> Result<void> {
      Generations generations(device, scores, kRules, kWorth);
      if (auto done = breed_some(generations, first, 3, run); !done) return done;
      trees.clear();
      for (std::size_t t = 0; t < generations.size(); ++t) {
        auto tree = generations.tree(t);
        if (!tree) return tree.error();
        trees.push_back(*tree);
      }
      return {};
    };
    REQUIRE(compute.run(1, run, job).has_value());
    return trees;
  };
  Compute processor(1);
  const Trees known = bred_on(processor, {});
  testing::lose_at_every_call(
      [&](Compute& compute, const RunContext& run) { REQUIRE(bred_on(compute, run) == known); });
}

TEST_CASE("more trees than a device has memory for are refused before anything is allocated") {
  testing::FailingDevice device(1000, testing::kLost);
  SurfaceScores scores = random_scores(75);
  Generations generations(device, scores, kRules, kWorth);
  const auto done = generations.begin(Trees(10'000, {0}), {});
  REQUIRE_FALSE(done.has_value());
  CHECK(done.error().code == ErrorCode::OutOfMemory);
  CHECK(device.allocated() == 0);
}

TEST_CASE("generations stop on request") {
  const auto device = device_under_test();
  if (!device) return;
  SurfaceScores scores = random_scores(76);
  Generations generations(*device, scores, kRules, kWorth);
  RunContext run;
  run.cancel->cancel();
  const auto done = generations.begin(random_trees(5, 76), run);
  REQUIRE_FALSE(done.has_value());
  CHECK(done.error().code == ErrorCode::Cancelled);
}

}  // namespace
}  // namespace hewn
