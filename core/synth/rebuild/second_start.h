#pragma once
/// A second start for optimisation: the solid built anew from its surfaces, until no known cell
/// between the primitives of both trees speaks against it.
#include <optional>
#include <vector>

#include "core/csg/literal_set.h"
#include "core/sample/arrangement.h"
#include "core/synth/rebuild/rebuild.h"

namespace hewn {

/// A tree built anew with the cells that judge it.
struct RebuiltTree {
  Tree tree;
  LiteralSet set;               ///< the input's literals, then its own
  std::vector<int> literal_of;  ///< of the tree, in `set`
  ArrangementSampler sampler;   ///< over `set`
};

/// Keeps what refuted earlier answers, so that it can be asked again.
class SecondStart {
 public:
  /// `points`: one for each known cell. The references must outlive it.
  SecondStart(const Tree& input, std::vector<Vec3> points, double scale, double depth,
              const RunContext& run);

  /// See `TreeRebuilder::least_literals`.
  int least_literals() { return rebuilder_.least_literals(); }

  /// A tree that is right on the cells of `known` and on further points, as far as they are not
  /// free, and on the cells that lines along its primitives find. Nothing when none is found in
  /// time or it has more than `most_literals`; then it is of no use to ask again. Requires: `known`
  /// has the given scale. Fails with: Cancelled. Deterministic for `run.seed`, for any number of
  /// threads.
  Result<std::optional<RebuiltTree>> find(const Arrangement& known,
                                          const std::vector<Vec3>& further,
                                          const ArrangementOptions& lines, int most_literals);

 private:
  Result<std::optional<RebuiltTree>> judged(const Tree& tree, const Arrangement& known,
                                            const std::vector<Vec3>& further,
                                            const ArrangementOptions& lines);

  const Tree& input_;
  std::vector<Vec3> points_;
  double scale_;
  RebuildOptions options_;
  const RunContext& run_;
  TreeRebuilder rebuilder_;
  std::optional<Tree> last_;
  LiteralSet looked_along_;  ///< whose cells are known
  Arrangement seen_;         ///< those cells
  int round_ = 0;
};

}  // namespace hewn
