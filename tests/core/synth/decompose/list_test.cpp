#include <algorithm>
#include <cmath>

#include "core/synth/decompose/decision_list.h"
#include "core/synth/decompose/gather.h"
#include "core/synth/decompose/neighbourhood.h"
#include "core/synth/decompose/pull_out.h"
#include "core/synth/decompose/rebase.h"
#include "core/synth/decompose/relax.h"
#include "core/synth/decompose/tighten.h"
#include "tests/core/synth/search_fixture.h"

namespace hewn {
namespace {

struct ListFixture : SearchFixture {
  using SearchFixture::SearchFixture;

  DecisionList construct(std::uint64_t seed) {
    const RunContext run;
    GrowerTeam growers(columns, combinability, run);
    Rng rng(seed);
    ConstructOptions options;
    options.beam_width = 2;
    options.seeds = 8;
    auto list = construct_list(space, options, growers, rng, run);
    REQUIRE(list);
    return *list;
  }
};

TEST_CASE("a constructed list decides every cell as wanted") {
  ListFixture f(solids::plate_with_hole({10, 8, 2}, 2, 24));
  const DecisionList list = f.construct(1);
  CHECK(is_right(f.space, list.items, list.base));
  std::vector<Word> inside(f.columns.words());
  evaluate_list(list.items, list.base, inside);
  for (std::size_t i = 0; i < inside.size(); ++i) {
    CHECK(((inside[i] ^ f.columns.wanted()[i]) & f.space.care[i]) == 0);
  }
}

TEST_CASE("a list that lacks an item has wrong cells, and repair mends them") {
  ListFixture f(solids::plate_with_hole({10, 8, 2}, 2, 24));
  DecisionList list = f.construct(2);
  REQUIRE(!list.items.empty());
  list.items.erase(list.items.begin());
  CHECK(!is_right(f.space, list.items, list.base));
  Word wrong = 0;
  for (const Word w : wrong_cells(f.space, list.items, list.base)) wrong |= w;
  CHECK(wrong != 0);
  const RunContext run;
  GrowerTeam growers(f.columns, f.combinability, run);
  Rng rng(3);
  REQUIRE(repair_list(f.space, list, growers, rng, run));
  CHECK(is_right(f.space, list.items, list.base));
}

TEST_CASE("a box less all around a washer becomes a disc less its hole") {
  ListFixture f(solids::revolve({{2, 0}, {5, 0}, {5, 1}, {2, 1}}, 48, true));
  // Whatever halfspace side holds nothing of the solid is cut off.
  DecisionList list{{}, true};
  for (std::size_t k = 0; k < f.columns.halfspaces(); ++k) {
    for (const bool inside : {false, true}) {
      Term cut;
      cut.fills = false;
      cut.literals = {{static_cast<int>(k), inside}};
      const TermPtr item = finished_term(f.space, cut);
      Word held = 0;
      for (std::size_t i = 0; i < f.columns.words(); ++i) {
        held |= item->cover[i] & f.columns.wanted()[i];
      }
      if (held == 0) list.items.push_back(item);
    }
  }
  REQUIRE(is_right(f.space, list.items, list.base));
  REQUIRE(list.items.size() == 4);
  CHECK(list.cost() == 6);  // the box, two planes, the hole, and all outside a cylinder
  REQUIRE(rebase_list(f.space, list));
  CHECK_FALSE(list.base);
  CHECK(list.cost() == 2);
  CHECK(is_right(f.space, list.items, list.base));
  CHECK_FALSE(rebase_list(f.space, list));
}

TEST_CASE("a bore that hub and flange share is cut once, and the flange goes through the hub") {
  ListFixture f(solids::revolve({{1, 0}, {4, 0}, {4, 1}, {2, 1}, {2, 3}, {1, 3}}, 48, true));
  // The sides that hold `p` of the planes at some heights and the cylinders of some radii.
  const auto filled_around = [&f](const Vec3& p, std::vector<double> heights,
                                  std::vector<double> radii) {
    Term term;
    for (std::size_t k = 0; k < f.columns.halfspaces(); ++k) {
      const Surface& s = f.part.surfaces.halfspaces[k].surface;
      const bool is_plane = s.kind == SurfaceKind::Plane;
      const double size = is_plane ? s.offset * s.axis.z() : s.radius;
      const auto& sizes = is_plane ? heights : radii;
      const auto is_size = [&](double x) { return std::abs(x - size) < 0.01; };
      if (std::none_of(sizes.begin(), sizes.end(), is_size)) continue;
      term.literals.push_back({static_cast<int>(k), s.signed_distance(p) < 0});
    }
    return finished_term(f.space, term);
  };
  DecisionList list{
      {filled_around({1.5, 0, 2}, {0, 3}, {1, 2}), filled_around({3, 0, 0.5}, {0, 1}, {1, 2, 4})},
      false};
  REQUIRE(is_right(f.space, list.items, list.base));
  REQUIRE(list.cost() == 5);
  REQUIRE(pull_out_cuts(f.space, list));
  CHECK(list.cost() == 3);
  CHECK(list.items.size() == 3);
  CHECK_FALSE(list.items.front()->fills);
  CHECK(is_right(f.space, list.items, list.base));
  CHECK_FALSE(pull_out_cuts(f.space, list));
}

TEST_CASE("improving keeps a list right and never makes it dearer") {
  ListFixture f(solids::block_with_fillet({6, 5, 4}, 1.5, 12));
  for (std::uint64_t seed = 1; seed <= 3; ++seed) {
    DecisionList list = f.construct(seed);
    const int before = list.cost();
    Rng rng(seed);
    NeighbourhoodOptions options;
    options.steps = 100;
    improve_list(f.space, options, list, rng, f.part.run);
    CHECK(is_right(f.space, list.items, list.base));
    CHECK(list.cost() <= before);
  }
}

TEST_CASE("improving finds the same list for any number of threads") {
  ListFixture f(solids::block_with_fillet({6, 5, 4}, 1.5, 12));
  const DecisionList start = f.construct(1);
  NeighbourhoodOptions options;
  options.steps = 60;
  const auto improved = [&](int threads, WalkReport& report) {
    DecisionList list = start;
    Rng rng(7);
    RunContext run = f.part.run;
    run.threads = threads;
    report = improve_list(f.space, options, list, rng, run);
    return list;
  };
  WalkReport alone;
  const DecisionList expected = improved(1, alone);
  CHECK(alone.steps > 0);
  for (const int threads : {0, 2, 8}) {
    WalkReport report;
    const DecisionList list = improved(threads, report);
    CHECK(report.steps == alone.steps);
    CHECK(report.terms_grown == alone.terms_grown);
    REQUIRE(list.items.size() == expected.items.size());
    for (std::size_t k = 0; k < list.items.size(); ++k) {
      CHECK(list.items[k]->literals == expected.items[k]->literals);
      CHECK(list.items[k]->fills == expected.items[k]->fills);
    }
  }
}

TEST_CASE("relaxing keeps a list right and its terms no smaller") {
  ListFixture f(solids::plate_with_hole({10, 8, 2}, 2, 24));
  DecisionList list = f.construct(4);
  const DecisionList before = list;
  relax_list(f.space, f.part.surfaces, list);
  CHECK(is_right(f.space, list.items, list.base));
  CHECK(list.cost() <= before.cost());
  REQUIRE(list.items.size() == before.items.size());
  for (std::size_t k = 0; k < list.items.size(); ++k) {
    for (std::size_t i = 0; i < f.columns.words(); ++i) {
      CHECK((before.items[k]->cover[i] & ~list.items[k]->cover[i]) == 0);
    }
  }
}

TEST_CASE("a block that reaches too far is bounded where the solid ends, and needs no cut") {
  ListFixture f(solids::box({0, 0, 0}, {4, 3, 2}));
  Term block;
  Term cut;
  cut.fills = false;
  for (std::size_t k = 0; k < f.part.surfaces.halfspaces.size(); ++k) {
    const Surface& s = f.part.surfaces.halfspaces[k].surface;
    const bool is_inside = s.signed_distance(Vec3(2, 1.5, 1)) < 0;
    const bool is_top = std::abs(s.axis.z()) > 0.5 && s.offset != 0;
    (is_top ? cut : block).literals.push_back({static_cast<int>(k), is_inside != is_top});
  }
  REQUIRE(cut.literals.size() == 1);
  cut.cost = block.cost = 1;
  DecisionList list;
  list.items = {with_cover(f.columns, cut), with_cover(f.columns, block)};
  REQUIRE(is_right(f.space, list.items, list.base));
  tighten_list(f.space, f.part.surfaces, list);
  CHECK(is_right(f.space, list.items, list.base));
  REQUIRE(list.items.size() == 1);
  CHECK(list.items[0]->literals.size() == 6);
}

TEST_CASE("tightening keeps a list right, and takes nothing of the solid from its filling terms") {
  ListFixture f(solids::block_with_fillet({6, 5, 4}, 1.5, 12));
  for (std::uint64_t seed = 1; seed <= 3; ++seed) {
    DecisionList list = f.construct(seed);
    relax_list(f.space, f.part.surfaces, list);
    const DecisionList before = list;
    tighten_list(f.space, f.part.surfaces, list);
    CHECK(is_right(f.space, list.items, list.base));
    CHECK(list.cost() <= before.cost());
    if (list.items.size() != before.items.size()) continue;
    for (std::size_t k = 0; k < list.items.size(); ++k) {
      for (std::size_t i = 0; i < f.columns.words(); ++i) {
        const Word lost = before.items[k]->cover[i] & ~list.items[k]->cover[i];
        CHECK((lost & f.space.care[i] & f.columns.wanted()[i]) == 0);
        if (!list.items[k]->fills) CHECK(lost == 0);
      }
    }
  }
}

TEST_CASE("gathering brings items of one kind together") {
  ListFixture f(solids::plate_with_hole({10, 8, 2}, 2, 24));
  for (std::uint64_t seed = 1; seed <= 3; ++seed) {
    DecisionList list = f.construct(seed);
    const int changes = count_changes(list);
    const std::size_t own = list.items.size();
    // Repeated below everything else, items decide nothing more but change kind again and again.
    for (std::size_t i = 0; i < own; ++i) list.items.push_back(list.items[i]);
    for (std::size_t i = 0; i < own; ++i) list.items.push_back(list.items[i]);
    REQUIRE(is_right(f.space, list.items, list.base));
    const int cost = list.cost();
    gather_runs(f.space, list);
    CHECK(is_right(f.space, list.items, list.base));
    CHECK(list.cost() == cost);
    CHECK(count_changes(list) <= changes);
  }
}

TEST_CASE("an order that matters stays") {
  ListFixture f(solids::plate_with_hole({10, 8, 2}, 2, 24));
  DecisionList list = f.construct(1);
  const std::vector<TermPtr> before = list.items;
  const int changes = count_changes(list);
  gather_runs(f.space, list);
  CHECK(count_changes(list) == changes);
  CHECK(list.items.size() == before.size());
}

}  // namespace
}  // namespace hewn
