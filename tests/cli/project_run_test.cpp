// Projects through the real binary: partitions, cuts and merges end in named modules.
#include <string>

#include <doctest/doctest.h>
#include <nlohmann/json.hpp>

#include "tests/cli/program.h"

namespace hewn::cli {
namespace {

/// A plate with a hole, drawn as a body and a tool. Groups are named by points on them.
TEST_CASE("a plate and its bores are two partitions with their own modules") {
  const Folder folder;
  const std::string input = folder.write("p.json", R"({
    "hewn-project": 1, "mesh": ")" HEWN_ASSETS R"(/flange.off",
    "partition": {"name": "body", "groups": "rest", "children": [
      {"name": "bolts", "op": "difference", "groups": [
        {"at": [35.5, 0, 4]}, {"at": [17.75, 30.7439, 4]}, {"at": [-17.75, 30.7439, 4]},
        {"at": [-35.5, 0, 4]}, {"at": [-17.75, -30.7439, 4]}, {"at": [17.75, -30.7439, 4]}]}]}
  })");
  const Outcome outcome =
      run_hewn({"reconstruct", input, "-o", folder / "out.scad", "--report", folder / "out.json"});
  REQUIRE_MESSAGE(outcome.exit_code == 0, outcome.err);
  const std::string scad = content_of(folder / "out.scad");
  CHECK(scad.find("module body") != std::string::npos);
  CHECK(scad.find("module bolts") != std::string::npos);
  const auto report = nlohmann::json::parse(content_of(folder / "out.json"));
  REQUIRE(report.at("partitions").size() == 2);
  CHECK(report.at("partitions")[1].at("name") == "bolts");
  CHECK(report.at("partitions")[1].at("groups") == 6);
  CHECK(report.at("geometry").at("iou").get<double>() > 0.97);  // facets against true circles
}

TEST_CASE("a cut through a cube makes two bodies that join to the cube") {
  const Folder folder;
  folder.write("cube.off", cube_off());
  const std::string input = folder.write("p.json", R"({
    "hewn-project": 1, "mesh": "cube.off",
    "cuts": [{"normal": [0, 0, 1], "offset": 4}],
    "partition": {"name": "low", "groups": [
        {"at": [5, 5, 0]}, {"at": [5, 0, 2]}, {"at": [5, 10, 2]}, {"at": [0, 5, 2]},
        {"at": [10, 5, 2]}],
      "children": [{"name": "high", "groups": "rest"}]}
  })");
  const Outcome outcome =
      run_hewn({"reconstruct", input, "-o", folder / "out.scad", "--report", folder / "out.json"});
  REQUIRE_MESSAGE(outcome.exit_code == 0, outcome.err);
  const auto report = nlohmann::json::parse(content_of(folder / "out.json"));
  CHECK(report.at("groups") == 10);
  REQUIRE(report.at("partitions").size() == 2);
  CHECK(report.at("partitions")[0].at("groups") == 5);
  CHECK(report.at("partitions")[1].at("groups") == 5);
  CHECK(report.at("tree").at("literals") == 2);
  CHECK(report.at("geometry").at("iou").get<double>() > 0.999);
}

TEST_CASE("groups that no partition names are left out with a warning") {
  const Folder folder;
  folder.write("cube.off", cube_off());
  const std::string input = folder.write(
      "p.json", R"({"hewn-project": 1, "mesh": "cube.off", "partition": {"groups": [0, 1, 2]}})");
  const Outcome outcome = run_hewn({"reconstruct", input, "-o", folder / "out.scad"});
  CHECK_MESSAGE(outcome.says("belong to no partition"), outcome.err);
}

}  // namespace
}  // namespace hewn::cli
