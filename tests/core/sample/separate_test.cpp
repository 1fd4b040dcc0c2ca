#include "core/sample/separate.h"

#include <doctest/doctest.h>

#include "tests/support/part_problem.h"
#include "tests/support/solids.h"

namespace hewn {
namespace {

TEST_CASE("a fillet gets the planes at its ends, after which no point is in conflict") {
  solids::PartProblem part(solids::block_with_fillet({6, 5, 4}, 1.5, 16));
  auto table = build_sample_table(part.space, 8000, part.surfaces.halfspace_of_group, part.run);
  REQUIRE(table.has_value());
  Cells cells = find_cells(*table);
  const long before = cells.conflicting_points();
  REQUIRE(before > 0);
  const std::size_t halfspaces = part.surfaces.halfspaces.size();
  const int added =
      add_separating_halfspaces(part.space, part.surfaces, *table, cells, ArcCut::Chord, part.run)
          .added;
  CHECK(added >= 1);
  CHECK(part.surfaces.halfspaces.size() == halfspaces + static_cast<std::size_t>(added));
  CHECK(table->halfspaces == part.surfaces.halfspaces.size());
  CHECK(cells.conflicting_points() * 1000 < static_cast<long>(table->size()));
  for (std::size_t k = halfspaces; k < part.surfaces.halfspaces.size(); ++k) {
    const Halfspace& h = part.surfaces.halfspaces[k];
    CHECK(h.is_separating);
    CHECK(h.area == 0);
    if (h.surface.kind == SurfaceKind::Plane) {
      CHECK(part.surfaces.directions[h.direction] == h.surface.axis);
    }
  }
}

TEST_CASE("the corner beyond a fillet can be cut off by planes along the part") {
  for (const ArcCut cut : {ArcCut::Chord, ArcCut::Corner}) {
    solids::PartProblem part(solids::block_with_fillet({6, 5, 4}, 1.5, 16));
    auto table = build_sample_table(part.space, 8000, part.surfaces.halfspace_of_group, part.run);
    REQUIRE(table.has_value());
    Cells cells = find_cells(*table);
    const std::size_t directions = part.surfaces.directions.size();
    const std::size_t halfspaces = part.surfaces.halfspaces.size();
    const Separation done =
        add_separating_halfspaces(part.space, part.surfaces, *table, cells, cut, part.run);
    CHECK(done.corners == (cut == ArcCut::Corner ? 1 : 0));
    CHECK(cells.conflicting_points() * 1000 < static_cast<long>(table->size()));
    int odd = 0;
    for (std::size_t k = halfspaces; k < part.surfaces.halfspaces.size(); ++k) {
      odd += part.surfaces.halfspaces[k].direction >= static_cast<int>(directions) ? 1 : 0;
    }
    CHECK((odd == 0) == (cut == ArcCut::Corner));
  }
}

TEST_CASE("a part without conflict gets no separating surface") {
  solids::PartProblem part(solids::plate_with_hole({10, 8, 2}, 2, 24));
  auto table = build_sample_table(part.space, 4000, part.surfaces.halfspace_of_group, part.run);
  REQUIRE(table.has_value());
  Cells cells = find_cells(*table);
  CHECK(add_separating_halfspaces(part.space, part.surfaces, *table, cells, ArcCut::Chord, part.run)
            .added == 0);
}

TEST_CASE("no candidate repeats a plane of the part") {
  solids::PartProblem part(solids::block_with_fillet({6, 5, 4}, 1.5, 16));
  const std::vector<Halfspace> candidates =
      separating_candidates(part.space, part.surfaces).halfspaces;
  REQUIRE(!candidates.empty());
  for (const Halfspace& c : candidates) {
    for (const Halfspace& h : part.surfaces.halfspaces) {
      if (h.surface.kind != SurfaceKind::Plane || c.surface.kind != SurfaceKind::Plane) continue;
      const bool same =
          h.surface.axis == c.surface.axis && std::abs(h.surface.offset - c.surface.offset) < 1e-9;
      CHECK(!same);
    }
  }
}

}  // namespace
}  // namespace hewn
