#pragma once
/// The project file: a mesh and the user's plan for it. Format: docs/project-file.md
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "core/base/result.h"
#include "core/csg/tree.h"
#include "core/session/literal_edit.h"
#include "core/session/settings.h"

namespace hewn {

/// Names a face group, robustly by a point on it, or by its index. The point decides when both
/// are given, so that a plan survives a change of the segmentation.
struct GroupRef {
  std::optional<Vec3> at;
  int index = -1;
};

/// Divides groups along the plane `normal . x = offset`.
struct CutStep {
  Vec3 normal = Vec3::UnitZ();  ///< unit
  double offset = 0;
  std::vector<GroupRef> groups;  ///< empty: all
};

/// A named set of groups with the operation that joins it to what stands before it among its
/// siblings, or to its parent's own solid.
struct PartitionPlan {
  std::string name = "part";
  Op op = Op::Union;  ///< Union, Difference or Intersection
  std::vector<GroupRef> groups;
  bool takes_rest = false;  ///< all groups that no partition names
  std::vector<PartitionPlan> children = {};
  std::optional<std::uint32_t> colour = {};  ///< 0xRRGGBB; without one, that of its place
};

struct Project {
  std::filesystem::path mesh;
  std::uint64_t seed = 1;
  Settings settings;
  std::vector<CutStep> cuts;                  ///< in order; each sees the groups of those before
  std::vector<std::vector<GroupRef>> merges;  ///< after the cuts
  PartitionPlan root = {"part", Op::Union, {}, true};
  std::vector<LiteralEdit> edits;  ///< of the tree that is found
};

/// The version that this program writes and the newest that it reads.
inline constexpr int kProjectVersion = 1;

/// Reads a project; a relative mesh path is taken from `folder`.
/// Fails with: Format (says which key), InvalidArgument (an option's value).
Result<Project> parse_project(std::string_view text, const std::filesystem::path& folder);

/// The text that `parse_project` reads; the mesh's path is written relative to `folder`.
std::string project_text(const Project& project, const std::filesystem::path& folder);

/// Fails as `parse_project` and `read_file` do.
Result<Project> load_project(const std::filesystem::path& path);

/// Groups as in a project file. `where` begins the error's place. Fails with: Format.
nlohmann::json groups_to_json(const std::vector<GroupRef>& groups);
Result<std::vector<GroupRef>> groups_from_json(const nlohmann::json& value,
                                               const std::string& where);

/// "#rrggbb", as in a project file.
std::string colour_text(std::uint32_t colour);
/// Fails with: Format.
Result<std::uint32_t> colour_from_text(std::string_view text);

/// "union", "difference" or "intersection", as in a project file.
const char* name_of(Op op);
/// Fails with: Format.
Result<Op> op_from_name(std::string_view name);

}  // namespace hewn
