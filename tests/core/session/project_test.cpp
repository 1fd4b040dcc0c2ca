#include "core/session/project.h"

#include <string>

#include <doctest/doctest.h>
#include <fmt/format.h>

#include "core/base/rng.h"

namespace hewn {
namespace {

constexpr const char* kFull = R"({
  "hewn-project": 1,
  "mesh": "part.off",
  "seed": 9,
  "options": {"segment": {"method": "curvature"}, "tree": {"starts": 2}},
  "cuts": [{"normal": [0, 0, 2], "offset": 10, "groups": [{"at": [1, 2, 3]}, 4]}],
  "merges": [[1, {"index": 2}]],
  "partition": {
    "name": "body", "groups": "rest",
    "children": [
      {"name": "holes", "op": "difference", "groups": [{"at": [0, 0, 5], "index": 7}],
       "children": [{"name": "pin", "op": "union", "groups": [3]}]},
      {"name": "core", "op": "intersection", "groups": [5, 6],
       "colour": "#01c0FE"}
    ]
  }
})";

Error error_of(const std::string& text) {
  const auto project = parse_project(text, "/tmp");
  REQUIRE(!project);
  return project.error();
}

std::string with_partition(const std::string& partition) {
  return R"({"hewn-project": 1, "mesh": "a.off", "partition": )" + partition + "}";
}

TEST_CASE("every key of a project reaches its place") {
  const auto project = parse_project(kFull, "/data");
  REQUIRE(project);
  CHECK(project->mesh == "/data/part.off");
  CHECK(project->seed == 9);
  CHECK(project->settings.segment.method == static_cast<int>(SegmentMethod::Curvature));
  CHECK(project->settings.tree.starts == 2);
  REQUIRE(project->cuts.size() == 1);
  CHECK(project->cuts[0].normal == Vec3::UnitZ());
  CHECK(project->cuts[0].offset == 5);  // divided by the normal's length
  REQUIRE(project->cuts[0].groups.size() == 2);
  CHECK(*project->cuts[0].groups[0].at == Vec3(1, 2, 3));
  CHECK(project->cuts[0].groups[1].index == 4);
  REQUIRE(project->merges.size() == 1);
  CHECK(project->merges[0][1].index == 2);
  CHECK(project->root.takes_rest);
  REQUIRE(project->root.children.size() == 2);
  CHECK(project->root.children[0].op == Op::Difference);
  CHECK(project->root.children[0].children[0].name == "pin");
  CHECK(project->root.children[1].op == Op::Intersection);
  CHECK(project->root.children[1].colour == 0x01c0feU);
  CHECK_FALSE(project->root.colour);
}

TEST_CASE("a project survives writing and reading") {
  const auto first = parse_project(kFull, "/data");
  REQUIRE(first);
  const std::string text = project_text(*first, "/data");
  const auto second = parse_project(text, "/data");
  REQUIRE(second);
  CHECK(project_text(*second, "/data") == text);
  CHECK(second->mesh == first->mesh);
  CHECK(second->root.children[0].groups[0].index == 7);
  CHECK(*second->root.children[0].groups[0].at == Vec3(0, 0, 5));
}

TEST_CASE("cuts at any angle survive writing and reading to the bit") {
  Rng rng(7);
  for (int i = 0; i < 500; ++i) {
    const Vec3 drawn(rng.uniform(-1, 1), rng.uniform(-1, 1), rng.uniform(-1, 1));
    Project project;
    project.mesh = "/data/part.off";
    project.cuts.push_back({drawn.normalized(), rng.uniform(-10, 10), {}});
    const std::string text = project_text(project, "/data");
    const auto read = parse_project(text, "/data");
    REQUIRE(read);
    CHECK(project_text(*read, "/data") == text);
  }
}

TEST_CASE("a project without a partition takes the whole mesh as one") {
  const auto project = parse_project(R"({"hewn-project": 1, "mesh": "a.off"})", "/tmp");
  REQUIRE(project);
  CHECK(project->root.takes_rest);
  CHECK(project->root.children.empty());
}

TEST_CASE("a cut's point stands for its offset") {
  const auto project = parse_project(
      R"({"hewn-project": 1, "mesh": "a.off", "cuts": [{"normal": [0, 3, 4], "point": [0, 5, 0]}]})",
      "/tmp");
  REQUIRE(project);
  CHECK(project->cuts[0].offset == doctest::Approx(3));
}

TEST_CASE("what is no project is refused with a reason") {
  CHECK(error_of("").code == ErrorCode::Format);
  CHECK(error_of("{").message.find("not valid JSON") != std::string::npos);
  CHECK(error_of("[1]").message.find("not a project file") != std::string::npos);
  CHECK(error_of(R"({"hewn-project": 99, "mesh": "a"})").message.find("version 99") !=
        std::string::npos);
  CHECK(error_of(R"({"hewn-project": 1})").where == "mesh");
  CHECK(error_of(R"({"hewn-project": 1, "mesh": "a", "cut": []})").message.find("'cut'") !=
        std::string::npos);
}

TEST_CASE("a mistake deep in a project is named by its path") {
  const Error op = error_of(
      with_partition(R"({"groups": "rest", "children": [{"op": "minus", "groups": [1]}]})"));
  CHECK(op.where == "partition.children[0].op");
  const Error group = error_of(with_partition(R"({"groups": [{"at": [1, 2]}]})"));
  CHECK(group.where == "partition.groups[0].at");
  for (const char* colour : {R"("red")", R"("#12345")", R"("#1234567")", R"("#12345g")", "7"}) {
    const Error bad =
        error_of(with_partition(fmt::format(R"({{"groups": [1], "colour": {}}})", colour)));
    CHECK(bad.where == "partition.colour");
  }
  const Error empty = error_of(with_partition(R"({"name": "x"})"));
  CHECK(empty.message.find("needs groups") != std::string::npos);
  const Error twice =
      error_of(with_partition(R"({"groups": "rest", "children": [{"groups": "rest"}]})"));
  CHECK(twice.message.find("only one") != std::string::npos);
}

TEST_CASE("an option out of range is refused") {
  const Error error =
      error_of(R"({"hewn-project": 1, "mesh": "a", "options": {"tree": {"starts": 100000}}})");
  CHECK(error.code == ErrorCode::InvalidArgument);
  CHECK(error.where == "options");
}

TEST_CASE("deep nesting ends in an error, not in a crash") {
  std::string text = R"({"groups": [0]})";
  for (int i = 0; i < 100; ++i) text = R"({"children": [)" + text + "]}";
  CHECK(error_of(with_partition(text)).message.find("deeper") != std::string::npos);
}

}  // namespace
}  // namespace hewn
