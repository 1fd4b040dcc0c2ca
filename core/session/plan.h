#pragma once
/// Carries out the mesh-side part of a project: cuts, merges and the division into partitions.
#include <memory>
#include <string>
#include <vector>

#include "core/base/result.h"
#include "core/base/run_context.h"
#include "core/fit/surface_set.h"
#include "core/mesh/query.h"
#include "core/session/project.h"

namespace hewn {

/// The mesh with its groups after cuts and merges.
struct PreparedMesh {
  std::shared_ptr<const Mesh> mesh;
  std::shared_ptr<const MeshQuery> query;
  Segmentation segmentation;
};

/// One node of the partition expression with its groups resolved, parents before children.
struct Partition {
  std::string name;
  Op op = Op::Union;
  int parent = -1;
  std::vector<int> groups;         ///< ascending; empty: only children
  bool is_subtracted = false;      ///< under an odd number of differences
  std::vector<int> touching_cuts;  ///< cuts that border on its groups
};

/// Applies the project's cuts and merges in order.
/// Fails with: InvalidArgument (a group that is not there), Cancelled.
Result<PreparedMesh> apply_edits(const Project& project, std::shared_ptr<const Mesh> mesh,
                                 Segmentation segmentation, const RunContext& run);

/// The groups that the references name, ascending, each once. `where` begins the error's place.
/// Fails with InvalidArgument: a group that is not there.
Result<std::vector<int>> find_groups(const PreparedMesh& prepared,
                                     const std::vector<GroupRef>& refs, const std::string& where);

/// Resolves the project's partition expression. A group that several partitions name belongs to
/// each; groups that none names are left out with a warning.
/// Fails with InvalidArgument: a group that is not there, a partition that is empty.
Result<std::vector<Partition>> resolve_partitions(const Project& project,
                                                  const PreparedMesh& prepared,
                                                  const RunContext& run);

/// `surfaces` and the planes of the cuts that border on the partition, as separating halfspaces.
SurfaceSet with_cut_planes(const SurfaceSet& surfaces, const Project& project,
                           const Partition& partition);

}  // namespace hewn
