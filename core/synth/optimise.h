#pragma once
/// The whole pipeline that makes a tree small: cells, redundancy removal, search, proof
/// (Friedrich et al. 2020, figure 1).
#include <string>
#include <vector>

#include "core/base/result.h"
#include "core/base/run_context.h"
#include "core/csg/tree.h"
#include "core/sample/arrangement.h"
#include "core/sample/equivalence.h"
#include "core/sample/point_sets.h"
#include "core/synth/remaining_solid.h"
#include "core/synth/simplify/redundancy.h"
#include "core/synth/thin_features.h"

namespace hewn {

/// All but the first two decompose the tree by dominant halfspaces, then rebuild what remains.
enum class OptimiseMethod {
  Redundancy,  ///< redundancy removal only
  Rewrite,     ///< large neighbourhood search over the whole tree
  Dominant,    ///< what remains is left as it is
  QuineMcCluskey,
  Espresso,
  SetCover,
  Annealing,  ///< of the set cover's QUBO
  Genetic,
};

/// Larger trees are refused: time and memory grow with the square of the literals.
inline constexpr int kMostOptimisedLiterals = 2000;

/// The remaining-solid method that it stands for.
RemainingMethod remaining_method(OptimiseMethod method);

struct OptimiseOptions {
  OptimiseMethod method = OptimiseMethod::Rewrite;
  /// Features thinner than this share of the solid's diagonal may go or be filled; 0: none may.
  double tolerance = 0;
  /// Also use primitives that stand for several of the input's: two aligned boxes that meet in a
  /// box, a cylinder that a box cuts short.
  bool derives_primitives = true;
  /// Also start from a tree built anew from the surfaces of the solid, with other primitives.
  bool rebuilds = true;
  int effort = 1;   ///< of the search: steps in units of the default
  int rounds = 12;  ///< of search and check; counterexamples join the cells between them
  /// Where the search starts; lines along the faces have the last word in any case.
  CellSampling cells = CellSampling::Lines;
  ArrangementOptions arrangement = {};
  EquivalenceOptions equivalence = {};
  RemainingOptions remaining = {};
  bool wants_qubo = false;
  bool wants_front = false;  ///< also search for the non-dominated trees (genetic search)
};

/// A tree of the Pareto front.
struct FrontMember {
  Tree tree;
  double geometry =
      0;  ///< share of cells that are right, mean of inside and outside; 1: same solid
  int size = 0;
  double proximity = 0;
};

struct TreeFigures {
  int literals = 0;
  int size = 0;
  double proximity = 1;
};

struct StageSeconds {
  std::string stage;
  double seconds = 0;
};

enum class SolidExtent { Bounded, Empty, Everything };

struct OptimiseResult {
  Tree tree;
  SolidExtent extent = SolidExtent::Bounded;
  TreeFigures before, after;
  std::size_t cells = 0;                   ///< different ones that were compared
  std::size_t tolerated_cells = 0;         ///< of them, thin ones that were free to change
  std::size_t changed_cells = 0;           ///< of them, those that did
  std::vector<ThinFeature> thin_features;  ///< what those are
  double resolution = 0;  ///< cells thinner than this are not told apart; model units
  int rounds = 0;
  bool is_input = false;  ///< nothing smaller could be proved: the input itself
  RedundancyCounts redundancy;
  Equivalence equivalence;
  int remaining_literals = 0;  ///< after decomposition, before they are rebuilt
  std::vector<FrontMember> front;
  std::string qubo;  ///< of the remaining solid's set cover, as JSON; with `wants_qubo`
  std::vector<StageSeconds> seconds;
};

/// A tree of the same solid with no more literals. It agrees with the input on every cell of the
/// literals' arrangement and on fresh points, or it is the input.
/// Fails with: Cancelled, InvalidArgument (an option out of range), TooLarge.
/// Deterministic for `run.seed`, for any number of threads.
Result<OptimiseResult> optimise(const Tree& tree, const OptimiseOptions& options,
                                const RunContext& run);

}  // namespace hewn
