#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "core/io/point_json.h"
#include "core/session/command.h"

namespace hewn {
namespace {

using Json = nlohmann::json;

/// Carries a bad value out of the reading; caught in `command_from_line`.
struct BadCommand {
  Error error;
};

Vec3 read_point(const Json& value) {
  return {value.at(0).get<double>(), value.at(1).get<double>(), value.at(2).get<double>()};
}

std::vector<GroupRef> read_groups(const Json& object) {
  auto groups = groups_from_json(object.at("groups"), "groups");
  if (!groups) throw BadCommand{groups.error()};
  return std::move(*groups);
}

Op read_op(const Json& object) {
  auto op = op_from_name(object.at("op").get<std::string>());
  if (!op) throw BadCommand{op.error()};
  return *op;
}

std::optional<std::uint32_t> read_colour(const Json& object) {
  const std::string text = object.at("colour").get<std::string>();
  if (text.empty()) return std::nullopt;
  auto colour = colour_from_text(text);
  if (!colour) throw BadCommand{colour.error()};
  return *colour;
}

/// The name in the log, the title for people, and the fields both ways.
template <class C>
struct Entry;

template <>
struct Entry<AddCut> {
  static constexpr const char* kName = "cut";
  static constexpr const char* kTitle = "Cut";
  static Json write(const AddCut& c) {
    return {{"normal", point_json(c.cut.normal)},
            {"offset", c.cut.offset},
            {"groups", groups_to_json(c.cut.groups)}};
  }
  static AddCut read(const Json& j) {
    return {{read_point(j.at("normal")), j.at("offset").get<double>(), read_groups(j)}};
  }
};

template <>
struct Entry<MoveCut> {
  static constexpr const char* kName = "move-cut";
  static constexpr const char* kTitle = "Move cut";
  static Json write(const MoveCut& c) {
    return {{"cut", c.cut}, {"normal", point_json(c.normal)}, {"offset", c.offset}};
  }
  static MoveCut read(const Json& j) {
    return {j.at("cut").get<int>(), read_point(j.at("normal")), j.at("offset").get<double>()};
  }
};

template <>
struct Entry<DeleteCut> {
  static constexpr const char* kName = "delete-cut";
  static constexpr const char* kTitle = "Delete cut";
  static Json write(const DeleteCut& c) { return {{"cut", c.cut}}; }
  static DeleteCut read(const Json& j) { return {j.at("cut").get<int>()}; }
};

template <>
struct Entry<MergeGroups> {
  static constexpr const char* kName = "merge";
  static constexpr const char* kTitle = "Merge groups";
  static Json write(const MergeGroups& c) { return {{"groups", groups_to_json(c.groups)}}; }
  static MergeGroups read(const Json& j) { return {read_groups(j)}; }
};

template <>
struct Entry<DeleteMerge> {
  static constexpr const char* kName = "delete-merge";
  static constexpr const char* kTitle = "Separate merged groups";
  static Json write(const DeleteMerge& c) { return {{"merge", c.merge}}; }
  static DeleteMerge read(const Json& j) { return {j.at("merge").get<int>()}; }
};

template <>
struct Entry<AddPartition> {
  static constexpr const char* kName = "partition";
  static constexpr const char* kTitle = "New partition";
  static Json write(const AddPartition& c) {
    return {{"parent", c.parent},
            {"name", c.name},
            {"op", name_of(c.op)},
            {"groups", groups_to_json(c.groups)}};
  }
  static AddPartition read(const Json& j) {
    return {j.at("parent").get<PartitionPath>(), j.at("name").get<std::string>(), read_op(j),
            read_groups(j)};
  }
};

template <>
struct Entry<AssignGroups> {
  static constexpr const char* kName = "assign";
  static constexpr const char* kTitle = "Move groups to partition";
  static Json write(const AssignGroups& c) {
    return {{"partition", c.partition}, {"groups", groups_to_json(c.groups)}};
  }
  static AssignGroups read(const Json& j) {
    return {j.at("partition").get<PartitionPath>(), read_groups(j)};
  }
};

template <>
struct Entry<RemovePartition> {
  static constexpr const char* kName = "remove-partition";
  static constexpr const char* kTitle = "Remove partition";
  static Json write(const RemovePartition& c) { return {{"partition", c.partition}}; }
  static RemovePartition read(const Json& j) { return {j.at("partition").get<PartitionPath>()}; }
};

template <>
struct Entry<RenamePartition> {
  static constexpr const char* kName = "rename-partition";
  static constexpr const char* kTitle = "Rename partition";
  static Json write(const RenamePartition& c) {
    return {{"partition", c.partition}, {"name", c.name}};
  }
  static RenamePartition read(const Json& j) {
    return {j.at("partition").get<PartitionPath>(), j.at("name").get<std::string>()};
  }
};

template <>
struct Entry<ColourPartition> {
  static constexpr const char* kName = "colour-partition";
  static constexpr const char* kTitle = "Change colour";
  static Json write(const ColourPartition& c) {
    return {{"partition", c.partition}, {"colour", c.colour ? colour_text(*c.colour) : ""}};
  }
  static ColourPartition read(const Json& j) {
    return {j.at("partition").get<PartitionPath>(), read_colour(j)};
  }
};

template <>
struct Entry<SetPartitionOp> {
  static constexpr const char* kName = "set-operation";
  static constexpr const char* kTitle = "Change operation";
  static Json write(const SetPartitionOp& c) {
    return {{"partition", c.partition}, {"op", name_of(c.op)}};
  }
  static SetPartitionOp read(const Json& j) {
    return {j.at("partition").get<PartitionPath>(), read_op(j)};
  }
};

template <>
struct Entry<MovePartition> {
  static constexpr const char* kName = "move-partition";
  static constexpr const char* kTitle = "Move partition";
  static Json write(const MovePartition& c) {
    return {{"partition", c.partition}, {"parent", c.parent}, {"position", c.position}};
  }
  static MovePartition read(const Json& j) {
    return {j.at("partition").get<PartitionPath>(), j.at("parent").get<PartitionPath>(),
            j.at("position").get<int>()};
  }
};

template <>
struct Entry<SetOption> {
  static constexpr const char* kName = "option";
  static constexpr const char* kTitle = "Change setting";
  static Json write(const SetOption& c) {
    return {{"section", c.section}, {"option", c.option}, {"value", c.text}};
  }
  static SetOption read(const Json& j) {
    return {j.at("section").get<std::string>(), j.at("option").get<std::string>(),
            j.at("value").get<std::string>()};
  }
};

template <>
struct Entry<SetSeed> {
  static constexpr const char* kName = "seed";
  static constexpr const char* kTitle = "Change seed";
  static Json write(const SetSeed& c) { return {{"seed", c.seed}}; }
  static SetSeed read(const Json& j) { return {j.at("seed").get<std::uint64_t>()}; }
};

template <>
struct Entry<EditLiteral> {
  static constexpr const char* kName = "edit-literal";
  static constexpr const char* kTitle = "Edit literal";
  static Json write(const EditLiteral& c) {
    return {{"literal", c.edit.literal}, {"field", c.edit.field}, {"value", c.edit.value}};
  }
  static EditLiteral read(const Json& j) {
    return {{j.at("literal").get<int>(), j.at("field").get<std::string>(),
             j.at("value").get<double>()}};
  }
};

template <>
struct Entry<SetPlan> {
  static constexpr const char* kName = "plan";
  static constexpr const char* kTitle = "Take result";
  static Json write(const SetPlan& c) { return {{"plan", c.plan}}; }
  static SetPlan read(const Json& j) { return {j.at("plan").get<std::string>()}; }
};

template <class C>
struct PathEntry {
  static Json write(const C& c) { return {{"path", c.path.string()}}; }
  static C read(const Json& j) { return {j.at("path").get<std::string>()}; }
};

template <>
struct Entry<OpenFile> : PathEntry<OpenFile> {
  static constexpr const char* kName = "open";
  static constexpr const char* kTitle = "Open";
};

template <>
struct Entry<SaveProject> : PathEntry<SaveProject> {
  static constexpr const char* kName = "save";
  static constexpr const char* kTitle = "Save project";
};

template <>
struct Entry<ExportTree> {
  static constexpr const char* kName = "export";
  static constexpr const char* kTitle = "Export";
  static Json write(const ExportTree& c) {
    return {{"path", c.path.string()}, {"match-facets", c.match_facets}};
  }
  static ExportTree read(const Json& j) {
    return {j.at("path").get<std::string>(), j.at("match-facets").get<bool>()};
  }
};

template <class C>
struct PlainEntry {
  static Json write(const C&) { return Json::object(); }
  static C read(const Json&) { return {}; }
};

template <>
struct Entry<Reconstruct> : PlainEntry<Reconstruct> {
  static constexpr const char* kName = "reconstruct";
  static constexpr const char* kTitle = "Reconstruct";
};

template <>
struct Entry<Undo> : PlainEntry<Undo> {
  static constexpr const char* kName = "undo";
  static constexpr const char* kTitle = "Undo";
};

template <>
struct Entry<Redo> : PlainEntry<Redo> {
  static constexpr const char* kName = "redo";
  static constexpr const char* kTitle = "Redo";
};

/// Reads the alternative whose name it is; tries them in order.
template <std::size_t I = 0>
SessionCommand read_as(const std::string& name, const Json& fields) {
  if constexpr (I < std::variant_size_v<SessionCommand>) {
    using C = std::variant_alternative_t<I, SessionCommand>;
    if (name == Entry<C>::kName) return Entry<C>::read(fields);
    return read_as<I + 1>(name, fields);
  } else {
    throw BadCommand{{ErrorCode::Format, fmt::format("unknown command '{}'", name)}};
  }
}

}  // namespace

const char* title_of(const SessionCommand& command) {
  return std::visit([](const auto& c) { return Entry<std::decay_t<decltype(c)>>::kTitle; },
                    command);
}

std::string command_to_line(const SessionCommand& command) {
  return std::visit(
      [](const auto& c) {
        using C = std::decay_t<decltype(c)>;
        Json line = Entry<C>::write(c);
        line["command"] = Entry<C>::kName;
        return line.dump(-1, ' ', false, Json::error_handler_t::replace);
      },
      command);
}

Result<SessionCommand> command_from_line(std::string_view line) {
  try {
    const Json fields = Json::parse(line);
    return read_as(fields.at("command").get<std::string>(), fields);
  } catch (const BadCommand& bad) {
    return bad.error;
  } catch (const Json::exception& bad) {
    return Error{ErrorCode::Format, fmt::format("not a command: {}", bad.what())};
  }
}

}  // namespace hewn
