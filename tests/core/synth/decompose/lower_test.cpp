#include "core/synth/decompose/lower.h"

#include "core/synth/verify.h"
#include "tests/core/synth/search_fixture.h"

namespace hewn {
namespace {

/// The share of uniform points on which the lowered tree and the list agree.
double tree_agrees(SearchFixture& f, std::uint64_t seed) {
  const RunContext run;
  GrowerTeam growers(f.columns, f.combinability, run);
  Rng rng(seed);
  ConstructOptions options;
  options.beam_width = 2;
  options.seeds = 8;
  const auto list = construct_list(f.space, options, growers, rng, run);
  REQUIRE(list);
  const Tree tree = lower_list(*list, f.part.surfaces, *f.part.mesh, {}, f.part.space.frame, {});
  const ListSolid solid(*list, f.part.surfaces.halfspaces, f.part.space.frame, false);
  int same = 0;
  constexpr int kPoints = 4000;
  for (int i = 0; i < kPoints; ++i) {
    const Vec3 p = sample_in_box(f.part.space, 0.1, rng);
    same += tree.contains(p) == solid.contains(p) ? 1 : 0;
  }
  return same / static_cast<double>(kPoints);
}

TEST_CASE("the tree of a list is the same solid") {
  SearchFixture plate(solids::plate_with_hole({10, 8, 2}, 2, 24));
  CHECK(tree_agrees(plate, 1) == 1);
  SearchFixture fillet(solids::block_with_fillet({6, 5, 4}, 1.5, 12));
  CHECK(tree_agrees(fillet, 2) == 1);
  SearchFixture turned(solids::transformed(solids::block_with_fillet({6, 5, 4}, 1.5, 12),
                                           solids::oblique_transform()));
  CHECK(tree_agrees(turned, 3) > 0.9999);
}

TEST_CASE("a tool sticks out of the solid where nothing bounds it") {
  SearchFixture f(solids::plate_with_hole({10, 8, 2}, 2, 24));
  int cylinder = -1;
  for (std::size_t k = 0; k < f.part.surfaces.halfspaces.size(); ++k) {
    const Surface& s = f.part.surfaces.halfspaces[k].surface;
    if (s.kind == SurfaceKind::Cylinder) cylinder = static_cast<int>(k);
  }
  REQUIRE(cylinder >= 0);
  Term hole;
  hole.literals = {{cylinder, true}};
  hole.fills = false;
  hole.cost = 1;
  DecisionList list;
  list.base = true;
  list.items = {std::make_shared<const Term>(hole)};
  const Tree tree = lower_list(list, f.part.surfaces, *f.part.mesh, {}, f.part.space.frame, {});
  REQUIRE(literal_count(tree) == 2);
  for (const Literal& l : tree.literals) {
    if (l.kind != SolidKind::Cylinder) continue;
    CHECK(l.origin.z() < -1.05);
    CHECK(l.origin.z() + l.height > 1.05);
    CHECK(l.radius == doctest::Approx(2));
  }
}

}  // namespace
}  // namespace hewn
