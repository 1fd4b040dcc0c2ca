#pragma once
/// Which cells a tolerance leaves free.
#include <cstddef>
#include <optional>
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
  /// Cost: some lines through each of them that was not looked at before.
  void remove_from(Column& cells, const ArrangementSampler& sampler, double depth,
                   const RunContext& run);
  /// The cell of a point that lies deep after all is not free.
  void hold(const Vec3& point, const ArrangementSampler& sampler);
  /// After a change of the cells' numbers.
  void renumber(const ArrangementSampler& sampler);

  /// Of each cell that was looked at and is not free, a point that lies deep in it.
  std::vector<Vec3> deep_points() const;
  /// Free ones among those that were looked at.
  std::size_t count() const;

 private:
  void mark(const Vec3& point, const ArrangementSampler& sampler);

  const Tree& tree_;
  std::vector<std::optional<CellDepth>> depths_;  ///< by cell; none: not looked at
  std::vector<Vec3> held_;                        ///< points that lie deep
};

}  // namespace hewn
