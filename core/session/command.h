#pragma once
/// Everything a user can do, as values: carried out, undone, recorded and replayed.
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "core/base/result.h"
#include "core/base/run_context.h"
#include "core/session/document.h"

namespace hewn {

/// Divides groups by a plane.
struct AddCut {
  CutStep cut;
};
/// Puts a placed cut elsewhere.
struct MoveCut {
  int cut = 0;
  Vec3 normal = Vec3::UnitZ();  ///< unit
  double offset = 0;
};
struct DeleteCut {
  int cut = 0;
};
struct MergeGroups {
  std::vector<GroupRef> groups;
};
struct DeleteMerge {
  int merge = 0;
};
/// Adds a partition below `parent` and moves the groups into it. An empty name gets a number.
struct AddPartition {
  PartitionPath parent;
  std::string name;
  Op op = Op::Union;
  std::vector<GroupRef> groups;
};
/// Moves groups from wherever they are into a partition.
struct AssignGroups {
  PartitionPath partition;
  std::vector<GroupRef> groups;
};
/// Removes a partition with those below it; its groups go to the one that takes the rest.
struct RemovePartition {
  PartitionPath partition;
};
struct RenamePartition {
  PartitionPath partition;
  std::string name;
};
struct ColourPartition {
  PartitionPath partition;
  std::optional<std::uint32_t> colour;  ///< 0xRRGGBB; none: that of its place
};
struct SetPartitionOp {
  PartitionPath partition;
  Op op = Op::Union;
};
/// Hangs a partition below another at a position among its children. Paths are as before the move.
struct MovePartition {
  PartitionPath partition, parent;
  int position = 0;
};
struct SetOption {
  std::string section, option, text;
};
struct SetSeed {
  std::uint64_t seed = 1;
};
/// Changes a number of a literal of the found tree. Other edits of the plan, names and colours
/// aside, take such changes back, because they lead to other trees.
struct EditLiteral {
  LiteralEdit edit;
};
/// Puts another plan for the same mesh in place, e.g. that of a result the user picked.
struct SetPlan {
  std::string plan;  ///< `plan_text` of it
};

/// The commands below are the session's; they do not edit the plan.
struct OpenFile {
  std::filesystem::path path;
};
struct SaveProject {
  std::filesystem::path path;
};
struct Reconstruct {};
struct ExportTree {
  std::filesystem::path path;
  bool match_facets = false;
};
struct Undo {};
struct Redo {};

using SessionCommand =
    std::variant<AddCut, MoveCut, DeleteCut, MergeGroups, DeleteMerge, AddPartition, AssignGroups,
                 RemovePartition, RenamePartition, ColourPartition, SetPartitionOp, MovePartition,
                 SetOption, SetSeed, EditLiteral, SetPlan, OpenFile, SaveProject, Reconstruct,
                 ExportTree, Undo, Redo>;

/// "Cut", "New partition", ...: what menus and the undo list call it.
const char* title_of(const SessionCommand& command);

/// One line of a command log, without the line's end.
std::string command_to_line(const SessionCommand& command);

/// Fails with Format: not JSON, an unknown command, a missing or wrong value.
Result<SessionCommand> command_from_line(std::string_view line);

/// The document after an edit. `document` must be ready for commands that name groups.
/// Fails with InvalidArgument (no such group, cut or partition; an edit that changes nothing; a
/// command that is no edit), Cancelled.
Result<Document> edited(const Document& document, const SessionCommand& command,
                        const RunContext& run);

}  // namespace hewn
