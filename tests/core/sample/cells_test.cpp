#include "core/sample/cells.h"

#include <doctest/doctest.h>

#include "tests/support/part_problem.h"
#include "tests/support/solids.h"

namespace hewn {
namespace {

/// A square field of unit boxes with gaps as wide as they are.
Mesh field_of_boxes(int side) {
  Mesh field;
  for (int x = 0; x < side; ++x) {
    for (int y = 0; y < side; ++y) {
      const Vec3 lo(2 * x, 2 * y, 0);
      const Mesh box = solids::box(lo, lo + Vec3::Ones());
      field = field.triangles.empty() ? box : solids::together(field, box);
    }
  }
  return field;
}

TEST_CASE("points share a cell exactly when their signatures are equal") {
  const solids::PartProblem part(solids::plate_with_hole({10, 8, 2}, 2, 24));
  const auto table =
      build_sample_table(part.space, 2000, part.surfaces.halfspace_of_group, part.run);
  REQUIRE(table.has_value());
  const Cells cells = find_cells(*table);
  const auto same = [&](std::size_t a, std::size_t b) {
    return std::equal(table->signature(a), table->signature(a) + table->stride,
                      table->signature(b));
  };
  for (std::size_t i = 0; i < table->size(); ++i) {
    CHECK(same(i, static_cast<std::size_t>(cells.first_point[cells.cell_of_point[i]])));
  }
  for (std::size_t a = 0; a < cells.size(); ++a) {
    for (std::size_t b = a + 1; b < cells.size(); ++b) {
      CHECK(!same(static_cast<std::size_t>(cells.first_point[a]),
                  static_cast<std::size_t>(cells.first_point[b])));
    }
  }
  CHECK(cells.conflicting_points() == 0);
}

TEST_CASE("the columns of the two sides of a halfspace split all kept cells") {
  const solids::PartProblem part(solids::block_with_fillet({6, 5, 4}, 1.5, 12));
  const auto table =
      build_sample_table(part.space, 2000, part.surfaces.halfspace_of_group, part.run);
  REQUIRE(table.has_value());
  const Cells cells = find_cells(*table);
  const ColumnTable columns(*table, cells);
  REQUIRE(columns.words() % kWordBlock == 0);
  for (std::size_t k = 0; k < columns.halfspaces(); ++k) {
    for (std::size_t i = 0; i < columns.words(); ++i) {
      const Word in = columns.column(k, true)[i];
      const Word out = columns.column(k, false)[i];
      CHECK((in & out) == 0);
      CHECK((in | out) == columns.all()[i]);
    }
  }
  for (std::size_t c = 0; c < cells.size(); ++c) {
    const int kept = columns.kept_index(static_cast<int>(c));
    if (kept < 0) continue;
    CHECK(test_bit(columns.wanted().data(), static_cast<std::size_t>(kept)) ==
          (cells.inside_count[c] > cells.outside_count[c]));
  }
}

TEST_CASE("neighbours share blocks: half of space leaves whole blocks of a column empty") {
  const solids::PartProblem part(field_of_boxes(7));
  const auto table =
      build_sample_table(part.space, 20000, part.surfaces.halfspace_of_group, part.run);
  REQUIRE(table.has_value());
  const ColumnTable columns(*table, find_cells(*table));
  REQUIRE(columns.cells() > 600);
  std::size_t empty = 0;
  for (std::size_t k = 0; k < columns.halfspaces(); ++k) {
    for (std::size_t i = 0; i < columns.words(); ++i) {
      empty += columns.column(k, true)[i] == 0 || columns.column(k, false)[i] == 0 ? 1 : 0;
    }
  }
  CHECK(empty > columns.halfspaces() * columns.words() / 3);
}

}  // namespace
}  // namespace hewn
