#pragma once
/// The whole way from a project to a checked tree: load, segment, regularise, search every
/// partition, join, verify.
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "core/base/result.h"
#include "core/base/run_context.h"
#include "core/csg/tree.h"
#include "core/mesh/load.h"
#include "core/session/plan.h"
#include "core/session/project.h"
#include "core/session/score.h"

namespace hewn {

class FoundPartitions;
class PartBoard;

struct Reconstruction;

/// For work on drafts: silent, and on one thread, since one that waits for others would first take
/// up some of the search's work.
RunContext beside_search(const RunContext& run);

/// Who looks on while a search runs.
struct SearchWatch {
  PartBoard* board = nullptr;  ///< told how far each partition is; null: nobody
  /// Gets better and better results on the way, measured like the last one; from any of the
  /// search's threads, one at a time. Which ones depends on the clock. May be empty.
  std::function<void(Reconstruction draft)> on_draft = {};
  /// Asked for partitions before they are searched, and given those that were; null: search all.
  FoundPartitions* found = nullptr;
};

/// What became of one partition that has groups of its own.
struct PartitionResult {
  std::string name;
  std::string op;  ///< "union", "difference" or "intersection"
  int groups = 0;
  double area_share = 0;       ///< of its groups, of the mesh's surface
  TreeAnswer answer;           ///< its tree and how the search went
  bool is_polyhedron = false;  ///< no primitives were found: its tree is the mesh itself
  double free_form_share = 0;  ///< of the mesh's surface, kept as a polyhedron beside its tree
};

/// Wall-clock time of one stage. The only part of a report that differs from run to run.
struct StageTime {
  std::string stage;
  double seconds = 0;
};

struct Reconstruction {
  MeshReport mesh_report;
  PreparedMesh prepared;
  SurfaceSet surfaces;
  std::vector<PartitionResult> partitions;
  Tree tree;  ///< joined and flattened; each partition's node bears its name
  TreeScore score;
  std::vector<StageTime> times;
  std::vector<std::string> warnings;  ///< the mesh report's first
};

/// The mesh of a project, loaded, divided into groups and edited as the project says.
struct SegmentedMesh {
  MeshReport report;
  PreparedMesh prepared;
  std::vector<StageTime> times;
};

/// Runs the first half: load, segment, cuts and merges.
/// Fails as `load_mesh`, `segment` and `apply_edits` do.
Result<SegmentedMesh> segment_project(const Project& project, const RunContext& run);

/// Runs everything; `project.seed` replaces the context's.
/// Fails as the stages do; with NotFound when a partition has no solution.
/// Same result for any number of threads, times aside.
Result<Reconstruction> reconstruct(const Project& project, const RunContext& run);

/// The result after the project's edits of literals, measured anew; `found` is the result of the
/// same project without them. Fails with: InvalidArgument (as `edit_literals`), Cancelled.
Result<Reconstruction> with_edits(Reconstruction found, const Project& project,
                                  const RunContext& run);

/// The second half alone: `segmented` is what `segment_project` made of the same project.
/// The same result as that of the whole, whoever watches.
Result<Reconstruction> reconstruct(const Project& project, SegmentedMesh segmented,
                                   const RunContext& run, const SearchWatch& watch = {});

}  // namespace hewn
