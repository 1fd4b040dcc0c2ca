#pragma once
/// What is being worked on: the plan, the mesh and its groups. A value: copies are cheap, because
/// everything large is shared and never changed.
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/base/result.h"
#include "core/base/run_context.h"
#include "core/session/plan.h"
#include "core/session/project.h"
#include "core/session/reconstruct.h"

namespace hewn {

struct DisplayMesh;

struct Document {
  Project project;
  /// The mesh before cuts and merges; null until it is read, or when an option that shapes the
  /// groups has changed since.
  std::shared_ptr<const SegmentedMesh> source;
  /// The mesh with the plan's cuts and merges; null while `source` is.
  std::shared_ptr<const PreparedMesh> prepared;
  /// `prepared` for drawing, where the job that made it made this too; else null.
  std::shared_ptr<const DisplayMesh> display;

  bool is_ready() const { return prepared != nullptr; }
};

/// The plan as project text with the mesh's absolute path: equal texts, equal plans.
std::string plan_text(const Project& project);

/// What decides the tree: the plan's text without what only shows. Equal keys, equal trees.
std::string search_key(const Project& project);

/// What decides the face groups before any edit: mesh, seed and the options up to segmentation.
std::string source_key(const Project& project);

/// The document with its mesh in place and the plan's cuts and merges carried out.
/// Fails as `apply_edits` does.
Result<Document> with_source(Document document, std::shared_ptr<const SegmentedMesh> source,
                             const RunContext& run);

/// The document with its mesh read and divided into groups, then as `with_source`.
/// Fails as `segment_project` and `apply_edits` do.
Result<Document> read_source(const Document& document, const RunContext& run);

/// Makes the mesh for drawing, unless it is there or there are no groups yet. O(n log n).
void add_display(Document& document);

/// A reference to each group by a point on it.
std::vector<GroupRef> refer_to(const PreparedMesh& prepared, const std::vector<int>& groups);

/// A partition's place: child numbers from the root down; the root's is empty.
using PartitionPath = std::vector<int>;

/// One partition with its resolved groups, for display; parents before children.
struct PartitionView {
  PartitionPath path;
  Partition partition;
  bool takes_rest = false;
  std::optional<std::uint32_t> colour;  ///< 0xRRGGBB, as in the plan
};

/// The partitions of a document that is ready; empty when the plan names a group that is not there
/// or the document is not ready.
std::vector<PartitionView> partition_views(const Document& document);

/// The plan's node at the path; null when there is none.
const PartitionPlan* find_partition(const PartitionPlan& root, const PartitionPath& path);
PartitionPlan* find_partition(PartitionPlan& root, const PartitionPath& path);

/// The expression as text: "body - (holes + slot) * core".
std::string expression_text(const PartitionPlan& root);

}  // namespace hewn
