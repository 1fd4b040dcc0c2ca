#pragma once
/// From labelled space and halfspaces to a CSG tree: the whole search, one call per partition.
#include <functional>
#include <memory>
#include <vector>

#include "core/base/option_table.h"
#include "core/base/result.h"
#include "core/base/run_context.h"
#include "core/csg/tree.h"
#include "core/fit/face_groups.h"
#include "core/fit/surface_set.h"
#include "core/mesh/query.h"

namespace hewn {

/// Is told of a better tree that was found on the way, and makes it when it wants to see it. From
/// the search's threads, also at the same time; nothing that is kept may depend on it.
using DraftSink = std::function<void(const std::function<Tree()>& make)>;

/// What one partition must reproduce. The pointees must outlive the call.
struct TreeProblem {
  const MeshQuery* query = nullptr;
  const Segmentation* segmentation = nullptr;
  const SurfaceSet* surfaces = nullptr;
  /// Face groups of the partition; empty means all. Points whose nearest group is not among them
  /// are don't-cares.
  std::vector<int> groups;
  /// Solids whose points are don't-cares.
  std::vector<Literal> ignored;
  /// Inside and outside swap: the partition's solid will be subtracted.
  bool is_subtracted = false;
  DraftSink on_draft = {};  ///< may be empty
};

enum class TreeSearchKind {
  List,    ///< a decision list: `find_tree`
  Evolve,  ///< the published genetic search: `evolve_tree`
};

/// Budgets count steps, never time, so that results do not depend on the machine's speed.
struct TreeSearchOptions {
  int search = 0;             ///< a `TreeSearchKind`
  int volume_points = 20000;  ///< uniform samples of the first round
  int starts = 6;             ///< independent constructions; the best are refined further
  int beam_width = 6;
  int neighbourhood_steps = 2500;  ///< stop after this many without improvement
  int regrow_tries = 10;           ///< terms tried for each gap of a window
  int rounds = 4;                  ///< counterexample rounds at most, but for stray pieces
  int stray_rounds = 4;            ///< more rounds while points far from the mesh are wrong
};

template <>
std::span<const OptionField<TreeSearchOptions>> option_table<TreeSearchOptions>();

struct TreeAnswer {
  Tree tree;
  /// Share of fresh points (away from inexact surfaces) that the tree classifies as the mesh does.
  double agreement = 0;
  int rounds = 0;      ///< counterexample rounds used
  int halfspaces = 0;  ///< available, separating ones included
  int separating = 0;  ///< halfspaces added to tell inside from outside
  int cells = 0;       ///< distinct sign signatures
  long terms_grown = 0;
  long evaluations = 0;  ///< of trees, in the genetic search
};

/// Finds a small tree for the problem: a decision list of terms on bit columns, refined by large
/// neighbourhood search and counterexamples (docs/architecture.md). Where roundings can be told
/// apart by planes at odd angles or by ones along the part, smaller problems are searched with
/// both, and a primitive at an odd angle counts like two.
/// Fails with: NotFound (no halfspaces, or contradictory labels), Cancelled.
/// Deterministic for any number of threads.
Result<TreeAnswer> find_tree(const TreeProblem& problem, const TreeSearchOptions& options,
                             const RunContext& run);

}  // namespace hewn
