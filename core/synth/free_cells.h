#pragma once
/// Which cells a tolerance leaves free.
#include <cstddef>
#include <map>
#include <vector>

#include "core/base/run_context.h"
#include "core/csg/tree.h"
#include "core/sample/arrangement.h"
#include "core/sample/thin_cells.h"
#include "core/synth/simplify/formula.h"

namespace hewn {

/// Cells of a solid's arrangement that lie in features thinner than a tolerance. What is known of a
/// cell is kept while others join the arrangement.
class FreeCells {
 public:
  /// The tree must outlive it.
  explicit FreeCells(const Tree& tree) : tree_(tree) {}

  /// Takes the free ones out of `cells`. Points nearer to the surface than `depth` are free.
  /// Cost: some lines through each cell that is new.
  void remove_from(Column& cells, const ArrangementSampler& sampler, double depth,
                   const RunContext& run);
  /// The cell of a point that lies deep after all is not free.
  void hold(const Vec3& point, const ArrangementSampler& sampler);
  /// After a change of the cells' numbers.
  void renumber(const ArrangementSampler& sampler);

  /// Of each cell that is not free a point that lies deep in it.
  std::vector<Vec3> deep_points() const;
  std::size_t count() const;

 private:
  void mark(const Vec3& point, const ArrangementSampler& sampler);

  const Tree& tree_;
  std::vector<CellDepth> depths_;  ///< by cell, as far as looked at
  std::vector<Vec3> held_points_;
  std::map<std::size_t, Vec3> held_;  ///< cells with such a point
};

}  // namespace hewn
