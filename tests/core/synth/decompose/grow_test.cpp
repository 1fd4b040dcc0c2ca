#include "core/synth/decompose/grow.h"

#include "core/synth/decompose/grower_team.h"
#include "tests/core/synth/search_fixture.h"
#include "tests/gpu/failing_device.h"

namespace hewn {
namespace {

TEST_CASE("a grown term covers its seed and no open cell of the other kind") {
  const SearchFixture f(solids::plate_with_hole({10, 8, 2}, 2, 24));
  TermGrower grower(f.columns, f.combinability);
  grower.set_open(f.space.care);
  Rng rng(1);
  int grown = 0;
  for (int k = 0; k < 400; ++k) {
    GrowRequest request;
    request.seed = rng.below(f.columns.cells());
    request.fills = test_bit(f.columns.wanted().data(), request.seed);
    request.mode = static_cast<GrowMode>(k % 4);
    request.noise = 0.5;
    request.random = rng.next();
    const auto term = grower.grow(request);
    if (!term) continue;
    ++grown;
    CHECK(test_bit(term->cover.data(), request.seed));
    for (std::size_t i = 0; i < f.columns.words(); ++i) {
      const Word wanted = f.columns.wanted()[i];
      CHECK((term->cover[i] & f.space.care[i] & (request.fills ? ~wanted : wanted)) == 0);
    }
    CHECK(term->cost == term_cost(term->literals, f.combinability));
  }
  CHECK(grown > 200);
  CHECK(grower.terms_grown() == 400);
}

TEST_CASE("no literal of a grown term can be left out") {
  const SearchFixture f(solids::plate_with_hole({10, 8, 2}, 2, 24));
  TermGrower grower(f.columns, f.combinability);
  grower.set_open(f.space.care);
  Rng rng(2);
  for (int k = 0; k < 100; ++k) {
    GrowRequest request;
    request.seed = rng.below(f.columns.cells());
    request.fills = test_bit(f.columns.wanted().data(), request.seed);
    request.random = rng.next();
    const auto term = grower.grow(request);
    REQUIRE(term);
    for (std::size_t skip = 0; term->literals.size() > 1 && skip < term->literals.size(); ++skip) {
      Word impure = 0;
      for (std::size_t i = 0; i < f.columns.words(); ++i) {
        Word cover = f.space.care[i];
        for (std::size_t m = 0; m < term->literals.size(); ++m) {
          if (m == skip) continue;
          const TermLiteral& l = term->literals[m];
          cover &= f.columns.column(static_cast<std::size_t>(l.halfspace), l.inside)[i];
        }
        impure |= cover & (request.fills ? ~f.columns.wanted()[i] : f.columns.wanted()[i]);
      }
      CHECK(impure != 0);
    }
  }
}

TEST_CASE("what terms share does not change them: in a batch as alone, with any threads") {
  const SearchFixture f(solids::plate_with_hole({10, 8, 2}, 2, 24));
  std::vector<Word> open = f.space.care;
  std::vector<Word> required = f.space.care;
  Rng rng(4);
  for (std::size_t i = 0; i < open.size(); ++i) {
    open[i] &= rng.next() | rng.next();
    required[i] = open[i] & rng.next();
  }
  std::vector<GrowRequest> requests(60);
  for (std::size_t k = 0; k < requests.size(); ++k) {
    GrowRequest& r = requests[k];
    r.seed = rng.below(f.columns.cells());
    r.fills = test_bit(f.columns.wanted().data(), r.seed);
    r.gains_required = rng.coin();
    r.mode = static_cast<GrowMode>(k % 4);
    r.noise = 0.1 * static_cast<double>(k % 3);
    r.random = rng.next();
  }
  for (const int threads : {1, 2}) {
    RunContext run;
    run.threads = threads;
    GrowerTeam team(f.columns, f.combinability, run, 0);
    const auto batch = team.grow(requests, open, &required);
    CHECK(team.terms_grown() == static_cast<long>(requests.size()));
    int grown = 0;
    for (std::size_t k = 0; k < requests.size(); ++k) {
      TermGrower alone(f.columns, f.combinability);
      alone.set_open(open, &required);
      const auto term = alone.grow(requests[k]);
      REQUIRE(term.has_value() == batch[k].has_value());
      if (!term) continue;
      ++grown;
      CHECK(term->literals == batch[k]->literals);
      CHECK(term->cover == batch[k]->cover);
    }
    CHECK(grown > 20);
  }
}

TEST_CASE("terms are the same where a device counts pairs of literals, and where it is lost") {
  const SearchFixture f(solids::plate_with_hole({10, 8, 2}, 2, 24));
  Rng rng(3);
  std::vector<GrowRequest> requests(60);
  for (std::size_t k = 0; k < requests.size(); ++k) {
    GrowRequest& request = requests[k];
    request.seed = rng.below(f.columns.cells());
    request.fills = test_bit(f.columns.wanted().data(), request.seed);
    request.gains_required = k % 3 == 0;
    request.mode = static_cast<GrowMode>(k % 4);
    request.noise = 0.5;
    request.random = rng.next();
  }
  const auto grown = [&](const RunContext& run) {
    GrowerTeam team(f.columns, f.combinability, run, 0);
    std::vector<std::vector<TermLiteral>> literals;
    for (const auto& term : team.grow(requests, f.space.care, &f.columns.wanted())) {
      literals.push_back(term ? term->literals : std::vector<TermLiteral>());
    }
    return literals;
  };
  const auto expected = grown({});
  for (const int good_calls : {1000, 5}) {
    testing::FailingDevice* device = nullptr;
    RunContext run;
    run.compute = std::make_shared<Compute>(1, DeviceChoice{DeviceChoice::Kind::Cuda, 0},
                                            testing::opens(device, good_calls, testing::kLost));
    CHECK(grown(run) == expected);
    CHECK((run.compute->accelerated_jobs() > 0) == (good_calls > 100));
  }
}

}  // namespace
}  // namespace hewn
