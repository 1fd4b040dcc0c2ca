#pragma once
/// A tree built anew from nothing but the surfaces of another one and its solid: the decision-list
/// search of reconstruction with exact halfspaces and exact labels.
#include <memory>
#include <optional>
#include <vector>

#include "core/base/result.h"
#include "core/base/run_context.h"
#include "core/csg/tree.h"
#include "core/sample/sample_table.h"
#include "core/synth/decompose/list_search.h"

namespace hewn {

struct RebuildOptions {
  /// Points nearer to the solid's surface than this are free; model units.
  double depth = 0;
  int volume_points = 8000;
  ListSearchOptions list = {};
};

/// Searches for a tree of the solid's own surfaces, again and again as its answers are refuted.
class TreeRebuilder {
 public:
  /// `points` must come out right in any case: one for each known cell. The references must
  /// outlive it.
  TreeRebuilder(const Tree& tree, const std::vector<Vec3>& points, double scale,
                const RebuildOptions& options, const RunContext& run);
  ~TreeRebuilder();
  TreeRebuilder(const TreeRebuilder&) = delete;
  TreeRebuilder& operator=(const TreeRebuilder&) = delete;

  /// A lower bound on the literals of any tree of this solid; 0 when none is known, as with a depth
  /// that is free. Cost: some lines through the solid.
  int least_literals();

  /// A tree that agrees with the given one on all points so far. Nothing when there is none:
  /// literals without plain surfaces, an unbounded solid, no list was found, or none with at most
  /// `most_literals` (0: any number) is to be expected.
  /// Fails with: Cancelled. Deterministic for `run.seed`, for any number of threads.
  Result<std::optional<Tree>> next(int most_literals);

  /// The points as the given tree has them.
  std::vector<LabelledPoint> labelled(const std::vector<Vec3>& points) const;

  /// Which points an answer is told.
  enum class Take {
    Wrong,        ///< those in which it is wrong
    WrongAndNew,  ///< also those of cells that are new: what mends one must not break others
  };
  /// Takes those of the points into account that are not free. With each that is wrong go some of
  /// the same feature: what is just thick enough to matter is found place by place else. Returns
  /// how many are wrong.
  std::size_t refute(const Tree& found, const std::vector<LabelledPoint>& points, Take take);

 private:
  class Search;
  std::unique_ptr<Search> search_;
};

}  // namespace hewn
