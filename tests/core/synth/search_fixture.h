#pragma once
/// A small part with its cells, ready for growing terms and lists.
#include <doctest/doctest.h>

#include "core/sample/separate.h"
#include "core/synth/decompose/construct.h"
#include "core/synth/decompose/grower_team.h"
#include "tests/support/part_problem.h"
#include "tests/support/solids.h"

namespace hewn {

struct SearchFixture {
  explicit SearchFixture(Mesh mesh)
      : part(std::move(mesh)),
        table(*build_sample_table(part.space, 6000, part.surfaces.halfspace_of_group, part.run)),
        cells(find_cells(table)),
        separating(add_separating_halfspaces(part.space, part.surfaces, table, cells, ArcCut::Chord,
                                             part.run)
                       .added),
        columns(table, cells),
        combinability(part.surfaces) {
    space.columns = &columns;
    space.combinability = &combinability;
    space.care = columns.all();
  }

  solids::PartProblem part;
  SampleTable table;
  Cells cells;
  int separating;
  ColumnTable columns;
  Combinability combinability;
  SearchSpace space;
};

}  // namespace hewn
