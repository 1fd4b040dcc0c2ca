#include "core/session/project.h"

#include <charconv>
#include <cmath>
#include <system_error>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "core/base/file.h"
#include "core/io/point_json.h"

namespace hewn {
namespace {

using Json = nlohmann::json;

/// Carries the first problem out of the recursive reading; caught in `parse_project`.
struct BadProject {
  Error error;
};

[[noreturn]] void fail(const std::string& where, const std::string& what) {
  throw BadProject{{ErrorCode::Format, what + "; docs/project-file.md describes the format",
                    where.empty() ? "project" : where}};
}

/// Misspelt keys would otherwise be ignored in silence.
void check_keys(const Json& object, const std::string& where,
                std::initializer_list<std::string_view> known) {
  if (!object.is_object()) fail(where, "an object {...} is needed here");
  for (const auto& [key, value] : object.items()) {
    if (std::find(known.begin(), known.end(), key) == known.end()) {
      fail(where, fmt::format("unknown key '{}'; known: {}", key, fmt::join(known, ", ")));
    }
  }
}

double read_number(const Json& value, const std::string& where) {
  if (!value.is_number() || !std::isfinite(value.get<double>())) fail(where, "a number is needed");
  return value.get<double>();
}

Vec3 read_point(const Json& value, const std::string& where) {
  if (!value.is_array() || value.size() != 3) fail(where, "three numbers [x, y, z] are needed");
  Vec3 p;
  for (int k = 0; k < 3; ++k) p[k] = read_number(value[static_cast<std::size_t>(k)], where);
  return p;
}

GroupRef read_group(const Json& value, const std::string& where) {
  GroupRef ref;
  if (value.is_number_integer()) {
    ref.index = value.get<int>();
  } else {
    check_keys(value, where, {"at", "index"});
    if (value.contains("at")) ref.at = read_point(value["at"], where + ".at");
    if (value.contains("index")) {
      if (!value["index"].is_number_integer()) fail(where + ".index", "a whole number is needed");
      ref.index = value["index"].get<int>();
    }
  }
  if (!ref.at && ref.index < 0) fail(where, R"(a group needs "at": [x, y, z] or an index from 0)");
  return ref;
}

std::vector<GroupRef> read_groups(const Json& value, const std::string& where) {
  if (!value.is_array()) fail(where, "a list of groups is needed");
  std::vector<GroupRef> refs;
  for (std::size_t i = 0; i < value.size(); ++i) {
    refs.push_back(read_group(value[i], fmt::format("{}[{}]", where, i)));
  }
  return refs;
}

CutStep read_cut(const Json& value, const std::string& where) {
  check_keys(value, where, {"normal", "offset", "point", "groups"});
  CutStep cut;
  if (!value.contains("normal")) fail(where, R"(a cut needs "normal")");
  const Vec3 normal = read_point(value["normal"], where + ".normal");
  double length = normal.norm();
  if (!(length > 0)) fail(where + ".normal", "the normal must not be zero");
  // A plan that was written reads back to the same bits: results are found again by its text.
  if (std::abs(length - 1) < 1e-12) length = 1;
  cut.normal = normal / length;
  if (value.contains("offset") == value.contains("point")) {
    fail(where, R"(a cut needs either "offset" or "point")");
  }
  cut.offset = value.contains("offset")
                   ? read_number(value["offset"], where + ".offset") / length
                   : cut.normal.dot(read_point(value["point"], where + ".point"));
  if (value.contains("groups")) cut.groups = read_groups(value["groups"], where + ".groups");
  return cut;
}

Op read_op(const Json& value, const std::string& where) {
  if (value == "union") return Op::Union;
  if (value == "difference") return Op::Difference;
  if (value == "intersection") return Op::Intersection;
  fail(where, R"(the operation must be "union", "difference" or "intersection")");
}

std::uint32_t read_colour(const Json& value, const std::string& where) {
  const std::string text = value.is_string() ? value.get<std::string>() : "";
  std::uint32_t colour = 0;
  const char* end = text.data() + text.size();
  if (text.size() != 7 || text[0] != '#' ||
      std::from_chars(text.data() + 1, end, colour, 16).ptr != end) {
    fail(where, R"(a colour must be a text like "#1f77b4")");
  }
  return colour;
}

PartitionPlan read_partition(const Json& value, const std::string& where, int depth) {
  constexpr int kDeepest = 64;  // the reader is recursive: bound what a file can make it do
  if (depth > kDeepest) fail(where, fmt::format("partitions nest deeper than {}", kDeepest));
  check_keys(value, where, {"name", "op", "groups", "children", "colour"});
  PartitionPlan plan;
  if (value.contains("name")) {
    if (!value["name"].is_string()) fail(where + ".name", "a text is needed");
    plan.name = value["name"].get<std::string>();
  }
  if (value.contains("op")) plan.op = read_op(value["op"], where + ".op");
  if (value.contains("colour")) plan.colour = read_colour(value["colour"], where + ".colour");
  if (value.contains("groups") && value["groups"] == "rest") {
    plan.takes_rest = true;
  } else if (value.contains("groups")) {
    plan.groups = read_groups(value["groups"], where + ".groups");
  }
  if (value.contains("children")) {
    const Json& children = value["children"];
    if (!children.is_array()) fail(where + ".children", "a list of partitions is needed");
    for (std::size_t i = 0; i < children.size(); ++i) {
      plan.children.push_back(
          read_partition(children[i], fmt::format("{}.children[{}]", where, i), depth + 1));
    }
  }
  if (plan.groups.empty() && !plan.takes_rest && plan.children.empty()) {
    fail(where, R"(a partition needs groups (a list or "rest") or children)");
  }
  return plan;
}

LiteralEdit read_edit(const Json& value, const std::string& where) {
  check_keys(value, where, {"literal", "field", "value"});
  LiteralEdit edit;
  if (!value.contains("literal") || !value["literal"].is_number_integer()) {
    fail(where + ".literal", "a whole number is needed");
  }
  if (!value.contains("field") || !value["field"].is_string()) {
    fail(where + ".field", "a name is needed");
  }
  if (!value.contains("value")) fail(where, R"(an edit needs "value")");
  edit.literal = value["literal"].get<int>();
  edit.field = value["field"].get<std::string>();
  edit.value = read_number(value["value"], where + ".value");
  return edit;
}

int count_rest(const PartitionPlan& plan) {
  int count = plan.takes_rest ? 1 : 0;
  for (const PartitionPlan& child : plan.children) count += count_rest(child);
  return count;
}

void read_version(const Json& root) {
  if (!root.is_object() || !root.contains("hewn-project") ||
      !root["hewn-project"].is_number_integer()) {
    fail("", R"(not a project file: the key "hewn-project" with the version is missing)");
  }
  const int version = root["hewn-project"].get<int>();
  if (version < 1 || version > kProjectVersion) {
    fail("hewn-project", fmt::format("version {} is not known to this program, which reads up to "
                                     "{}; use a newer hewn",
                                     version, kProjectVersion));
  }
}

Project read_project(const Json& root, const std::filesystem::path& folder) {
  read_version(root);
  check_keys(root, "",
             {"hewn-project", "mesh", "seed", "options", "cuts", "merges", "partition", "edits"});
  Project project;
  if (!root.contains("mesh") || !root["mesh"].is_string()) fail("mesh", "a file name is needed");
  const std::filesystem::path mesh = root["mesh"].get<std::string>();
  project.mesh = mesh.is_absolute() ? mesh : folder / mesh;
  if (root.contains("seed")) {
    if (!root["seed"].is_number_unsigned()) fail("seed", "a whole number from 0 is needed");
    project.seed = root["seed"].get<std::uint64_t>();
  }
  if (root.contains("options")) {
    if (auto set = settings_from_json(project.settings, root["options"]); !set) {
      Error error = set.error();
      error.where = "options";
      throw BadProject{error};
    }
  }
  const Json none = Json::array();
  const Json& cuts = root.contains("cuts") ? root["cuts"] : none;
  if (!cuts.is_array()) fail("cuts", "a list is needed");
  for (std::size_t i = 0; i < cuts.size(); ++i) {
    project.cuts.push_back(read_cut(cuts[i], fmt::format("cuts[{}]", i)));
  }
  const Json& merges = root.contains("merges") ? root["merges"] : none;
  if (!merges.is_array()) fail("merges", "a list is needed");
  for (std::size_t i = 0; i < merges.size(); ++i) {
    project.merges.push_back(read_groups(merges[i], fmt::format("merges[{}]", i)));
  }
  if (root.contains("partition")) {
    project.root = read_partition(root["partition"], "partition", 0);
  }
  const Json& edits = root.contains("edits") ? root["edits"] : none;
  if (!edits.is_array()) fail("edits", "a list is needed");
  for (std::size_t i = 0; i < edits.size(); ++i) {
    project.edits.push_back(read_edit(edits[i], fmt::format("edits[{}]", i)));
  }
  if (count_rest(project.root) > 1) fail("partition", R"(only one partition can take the "rest")");
  return project;
}

Json partition_json(const PartitionPlan& plan) {
  Json object = {{"name", plan.name}, {"op", name_of(plan.op)}};
  if (plan.takes_rest) {
    object["groups"] = "rest";
  } else if (!plan.groups.empty()) {
    object["groups"] = groups_to_json(plan.groups);
  }
  if (plan.colour) object["colour"] = colour_text(*plan.colour);
  for (const PartitionPlan& child : plan.children) {
    object["children"].push_back(partition_json(child));
  }
  return object;
}

}  // namespace

Json groups_to_json(const std::vector<GroupRef>& groups) {
  Json list = Json::array();
  for (const GroupRef& ref : groups) {
    Json item = Json::object();
    if (ref.at) item["at"] = point_json(*ref.at);
    if (ref.index >= 0) item["index"] = ref.index;
    list.push_back(std::move(item));
  }
  return list;
}

Result<std::vector<GroupRef>> groups_from_json(const Json& value, const std::string& where) {
  try {
    return read_groups(value, where);
  } catch (const BadProject& bad) {
    return bad.error;
  }
}

std::string colour_text(std::uint32_t colour) { return fmt::format("#{:06x}", colour & 0xffffff); }

Result<std::uint32_t> colour_from_text(std::string_view text) {
  try {
    return read_colour(Json(text), "colour");
  } catch (const BadProject& bad) {
    return bad.error;
  }
}

const char* name_of(Op op) {
  if (op == Op::Difference) return "difference";
  return op == Op::Intersection ? "intersection" : "union";
}

Result<Op> op_from_name(std::string_view name) {
  try {
    return read_op(Json(name), "op");
  } catch (const BadProject& bad) {
    return bad.error;
  }
}

Result<Project> parse_project(std::string_view text, const std::filesystem::path& folder) {
  try {
    return read_project(Json::parse(text), folder);
  } catch (const BadProject& bad) {
    return bad.error;
  } catch (const Json::exception& bad) {
    return Error{ErrorCode::Format, fmt::format("not valid JSON: {}", bad.what()), "project"};
  }
}

std::string project_text(const Project& project, const std::filesystem::path& folder) {
  std::error_code failure;
  const auto relative = std::filesystem::relative(project.mesh, folder, failure);
  Json root = {{"hewn-project", kProjectVersion},
               {"mesh", failure || relative.empty() ? project.mesh.string() : relative.string()},
               {"seed", project.seed},
               {"options", settings_to_json(project.settings)},
               {"partition", partition_json(project.root)}};
  for (const CutStep& cut : project.cuts) {
    Json object = {{"normal", point_json(cut.normal)}, {"offset", cut.offset}};
    if (!cut.groups.empty()) object["groups"] = groups_to_json(cut.groups);
    root["cuts"].push_back(std::move(object));
  }
  for (const LiteralEdit& edit : project.edits) {
    root["edits"].push_back(
        {{"literal", edit.literal}, {"field", edit.field}, {"value", edit.value}});
  }
  for (const auto& merge : project.merges) root["merges"].push_back(groups_to_json(merge));
  return root.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

Result<Project> load_project(const std::filesystem::path& path) {
  auto text = read_file(path);
  if (!text) return text.error();
  auto project = parse_project(*text, path.parent_path());
  if (project) return project;
  Error error = project.error();
  error.where = path.string() + (error.where.empty() ? "" : ", " + error.where);
  return error;
}

}  // namespace hewn
