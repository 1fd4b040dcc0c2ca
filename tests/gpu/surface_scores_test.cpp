/// Surface scores of trees against a sample-by-sample evaluation, on every device.
#include "core/compute/surface_scores.h"

#include <utility>

#include <doctest/doctest.h>

#include "tests/gpu/random_tree.h"
#include "tests/gpu/test_device.h"

namespace hewn {
namespace {

using testing::device_under_test;

using Scored = std::vector<std::vector<SampleScore>>;  // by primitive, then by sample

Scored random_scores(std::size_t primitives, std::size_t samples, Rng& rng) {
  Scored all(primitives, std::vector<SampleScore>(samples));
  for (auto& of_primitive : all) {
    for (SampleScore& s : of_primitive) {
      // Few distances, so that many are equal: then the left operand decides.
      s.distance = static_cast<float>(rng.below(9)) - 4;
      s.score = static_cast<std::uint32_t>(rng.below(SurfaceScoreKernel::kLargestScore + 1));
      s.turned_score = static_cast<std::uint32_t>(rng.below(1000));
    }
  }
  return all;
}

SurfaceScores table_of(const Scored& scores) {
  SurfaceScores table(scores.size(), scores[0].size());
  for (std::size_t k = 0; k < scores.size(); ++k) {
    for (std::size_t i = 0; i < scores[k].size(); ++i) table.set(k, i, scores[k][i]);
  }
  return table;
}

/// Distance, primitive and whether it is turned, at one sample after the other.
std::uint64_t scored_plainly(const std::vector<Token>& tree, const Scored& scores) {
  struct Side {
    float distance;
    std::size_t primitive;
    bool is_turned;
  };
  std::uint64_t total = 0;
  for (std::size_t i = 0; i < scores[0].size(); ++i) {
    std::vector<Side> stack;
    for (const Token token : tree) {
      if (token >= 0) {
        const auto k = static_cast<std::size_t>(token);
        stack.push_back({scores[k][i].distance, k, false});
        continue;
      }
      Side b = stack.back();
      if (token == kDifferenceToken || token == kComplementToken) {
        b.distance = -b.distance;
        b.is_turned = !b.is_turned;
      }
      if (token == kComplementToken) {
        stack.back() = b;
        continue;
      }
      stack.pop_back();
      Side& a = stack.back();
      const bool takes_b = token == kUnionToken ? b.distance < a.distance : b.distance > a.distance;
      if (takes_b) a = b;
    }
    const SampleScore& s = scores[stack.back().primitive][i];
    total += stack.back().is_turned ? s.turned_score : s.score;
  }
  return total;
}

TEST_CASE("trees score as a sample-by-sample evaluation says") {
  const auto device = device_under_test();
  if (!device) return;
  Rng rng(41);
  for (const std::size_t samples : {1, 63, 64, 65, 1000}) {
    constexpr std::size_t kPrimitives = 9;
    const Scored scores = random_scores(kPrimitives, samples, rng);
    SurfaceScores table = table_of(scores);
    TreeBatch batch;
    std::vector<std::vector<Token>> trees(60);
    for (std::size_t t = 0; t < trees.size(); ++t) {
      testing::append_random_tree(trees[t], 1 + rng.below(t < 40 ? 12 : 120), kPrimitives, rng);
      batch.add(trees[t]);
    }
    std::vector<std::uint64_t> totals(trees.size(), 7);
    // Twice: the second time the scores are on the device already.
    for (int round = 0; round < 2; ++round) {
      REQUIRE(table.measure(*device, batch, totals, {}).has_value());
      for (std::size_t t = 0; t < trees.size(); ++t) {
        REQUIRE(totals[t] == scored_plainly(trees[t], scores));
      }
    }
  }
}

TEST_CASE("samples that exceed the device's budget go through in parts") {
  Rng rng(43);
  constexpr std::size_t kPrimitives = 9;
  constexpr std::size_t kSamples = 1000;
  const Scored scores = random_scores(kPrimitives, kSamples, rng);
  TreeBatch batch;
  std::vector<std::vector<Token>> trees(20);
  for (auto& tree : trees) {
    testing::append_random_tree(tree, 1 + rng.below(12), kPrimitives, rng);
    batch.add(tree);
  }
  std::vector<std::uint64_t> totals(trees.size());
  // Less than a block of samples, some blocks, all.
  for (const std::size_t budget : {std::size_t{1}, std::size_t{50'000}, std::size_t{1} << 30}) {
    CpuDevice device(2, budget);
    SurfaceScores table = table_of(scores);
    REQUIRE(table.measure(device, batch, totals, {}).has_value());
    for (std::size_t t = 0; t < trees.size(); ++t) {
      REQUIRE(totals[t] == scored_plainly(trees[t], scores));
    }
  }
}

TEST_CASE("few samples at a time give the same totals as many") {
  Rng rng(42);
  constexpr std::size_t kPrimitives = 7;
  constexpr std::size_t kSamples = 192;
  std::vector<float> distances(kPrimitives * kSamples);
  std::vector<std::uint32_t> scores(2 * distances.size());
  for (float& d : distances) d = static_cast<float>(rng.below(9)) - 4;
  for (std::uint32_t& s : scores) s = static_cast<std::uint32_t>(rng.below(1000));
  TreeBatch batch;
  for (int t = 0; t < 50; ++t) {
    std::vector<Token> tree;
    testing::append_random_tree(tree, 1 + rng.below(60), kPrimitives, rng);
    batch.add(tree);
  }
  std::vector<std::uint64_t> few(batch.size(), 0);
  std::vector<std::uint64_t> many(batch.size(), 0);
  SurfaceScoreKernel kernel{batch.trees().data(),
                            static_cast<std::int64_t>(batch.size()),
                            batch.steps().data(),
                            kSamples,
                            distances.data(),
                            scores.data(),
                            few.data()};
  for (std::int64_t i = 0; i < kernel.items<DeviceGrain>(); ++i) kernel.run<DeviceGrain>(i);
  kernel.totals = many.data();
  for (std::int64_t i = 0; i < kernel.items<HostGrain>(); ++i) kernel.run<HostGrain>(i);
  CHECK(few == many);
}

TEST_CASE("without samples or trees there is no score") {
  const auto device = device_under_test();
  if (!device) return;
  TreeBatch batch;
  std::vector<std::uint64_t> totals;
  SurfaceScores some(2, 5);
  CHECK(some.measure(*device, batch, totals, {}).has_value());
  batch.add(std::vector<Token>{0});
  totals.assign(1, 7);
  SurfaceScores none(1, 0);
  REQUIRE(none.measure(*device, batch, totals, {}).has_value());
  CHECK(totals[0] == 0);
}

TEST_CASE("large totals do not overflow") {
  const auto device = device_under_test();
  if (!device) return;
  constexpr std::size_t kSamples = 4096;
  SurfaceScores table(1, kSamples);
  for (std::size_t i = 0; i < kSamples; ++i) {
    table.set(0, i, {1, SurfaceScoreKernel::kLargestScore, 0});
  }
  TreeBatch batch;
  batch.add(std::vector<Token>{0});
  std::vector<std::uint64_t> totals(1);
  REQUIRE(table.measure(*device, batch, totals, {}).has_value());
  CHECK(totals[0] == std::uint64_t{kSamples} * SurfaceScoreKernel::kLargestScore);
}

}  // namespace
}  // namespace hewn
