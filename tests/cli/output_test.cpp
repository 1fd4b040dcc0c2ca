// Outputs: formats, folders that cannot be written, the same bytes for any number of threads.
#include <filesystem>
#include <string>

#include <doctest/doctest.h>
#include <nlohmann/json.hpp>

#include "tests/cli/program.h"

namespace hewn::cli {
namespace {

constexpr int kNoInput = 3, kNoOutput = 5;

TEST_CASE("a cube becomes one cube, with a report that says so") {
  const Folder folder;
  const std::string input = folder.write("cube.off", cube_off());
  const Outcome outcome = run_hewn({"reconstruct", input, "-o", folder / "out.scad", "--report",
                                    folder / "out.json", "--picture", folder / "out.png"});
  REQUIRE_MESSAGE(outcome.exit_code == 0, outcome.err);
  CHECK(outcome.err.empty());
  CHECK(content_of(folder / "out.scad").find("cube(") != std::string::npos);
  CHECK(content_of(folder / "out.png").substr(1, 3) == "PNG");
  const auto report = nlohmann::json::parse(content_of(folder / "out.json"));
  CHECK(report.at("hewn-report") == 1);
  CHECK(report.at("tree").at("literals") == 1);
  CHECK(report.at("tree").at("size") == 1);
  CHECK(report.at("geometry").at("iou").get<double>() > 0.999);
  CHECK(report.at("geometry").at("hausdorff_rel").get<double>() < 1e-4);
  CHECK(report.at("input").at("is_closed") == true);
  CHECK(report.at("polyhedron_share") == 0);
}

TEST_CASE("the number of threads leaves no trace in the tree") {
  const Folder folder;
  for (const std::string part : {"bracket.off", "shaft.stl"}) {
    CAPTURE(part);
    const std::string input = std::string(HEWN_ASSETS "/") + part;
    for (const std::string threads : {"1", "2", "8"}) {
      const Outcome outcome = run_hewn(
          {"reconstruct", input, "-o", folder / (threads + ".scad"), "--threads", threads});
      REQUIRE_MESSAGE(outcome.exit_code == 0, outcome.err);
    }
    const std::string one = content_of(folder / "1.scad");
    CHECK(one.size() > 100);
    CHECK(one == content_of(folder / "2.scad"));
    CHECK(one == content_of(folder / "8.scad"));
  }
}

TEST_CASE("a dash prints the tree and nothing else") {
  const Folder folder;
  const std::string input = folder.write("cube.off", cube_off());
  const Outcome printed = run_hewn({"reconstruct", input, "-o", "-"});
  REQUIRE(run_hewn({"reconstruct", input, "-o", folder / "out.scad"}).exit_code == 0);
  CHECK(printed.exit_code == 0);
  CHECK(printed.out == content_of(folder / "out.scad"));
}

TEST_CASE("an output folder that is not there is refused before any work") {
  const Folder folder;
  const std::string input = folder.write("cube.off", cube_off());
  const Outcome outcome = run_hewn({"reconstruct", input, "-o", folder / "no/out.scad"});
  CHECK(outcome.exit_code == kNoOutput);
  CHECK_MESSAGE(outcome.says("no folder"), outcome.err);
  const Outcome report = run_hewn(
      {"reconstruct", input, "-o", folder / "out.scad", "--report", folder / "no/out.json"});
  CHECK(report.exit_code == kNoOutput);
  CHECK(folder.files() == std::vector<std::string>{"cube.off"});
}

TEST_CASE("a read-only folder and a path below a file are refused") {
  const Folder folder;
  const std::string input = folder.write("cube.off", cube_off());
  for (const std::string& path : {std::string("/proc/out.scad"), input + "/out.scad"}) {
    const Outcome outcome = run_hewn({"reconstruct", input, "-o", path});
    CHECK(outcome.exit_code == kNoOutput);
    CHECK_MESSAGE(outcome.says("cannot write"), outcome.err);
    CHECK_MESSAGE(outcome.says(path), outcome.err);
  }
  CHECK(content_of(input) == cube_off());
}

TEST_CASE("a full disk is reported and an older report stays") {
  const Folder folder;
  const std::string input = folder.write("cube.off", cube_off());
  const std::string full = folder / "full.scad";
  std::filesystem::create_symlink("/dev/full", full);
  const Outcome outcome = run_hewn({"reconstruct", input, "-o", full});
  CHECK(outcome.exit_code == kNoOutput);
  CHECK_MESSAGE(outcome.says("No space left"), outcome.err);
}

TEST_CASE("a folder that permissions protect is refused before any work") {
  const Folder folder;
  const std::string input = folder.write("cube.off", cube_off());
  const std::filesystem::path locked = folder / "locked";
  std::filesystem::create_directory(locked);
  std::filesystem::permissions(
      locked, std::filesystem::perms::owner_read | std::filesystem::perms::owner_exec);
  Denied denied;
  denied.is_privileged = false;
  const std::string path = (locked / "out.scad").string();
  const Outcome outcome = run_hewn_with(denied, {"reconstruct", input, "-o", path});
  CHECK(outcome.exit_code == kNoOutput);
  CHECK_MESSAGE(outcome.says("read-only; choose one you may write to"), outcome.err);
  CHECK_MESSAGE(outcome.says(path), outcome.err);
  CHECK(std::filesystem::is_empty(locked));
  const std::string report = (locked / "out.json").string();
  CHECK(run_hewn_with(denied, {"reconstruct", input, "-o", folder / "out.scad", "--report", report})
            .exit_code == kNoOutput);
  CHECK(folder.files() == std::vector<std::string>{"cube.off", "locked"});
}

TEST_CASE("an input that may not be read is refused with its name") {
  const Folder folder;
  const std::string input = folder.write("cube.off", cube_off());
  std::filesystem::permissions(input, std::filesystem::perms::none);
  Denied denied;
  denied.is_privileged = false;
  const Outcome outcome = run_hewn_with(denied, {"info", input});
  CHECK(outcome.exit_code == kNoInput);
  CHECK_MESSAGE(outcome.says("Permission denied"), outcome.err);
  CHECK_MESSAGE(outcome.says(input), outcome.err);
}

TEST_CASE("a disk that fills up amid a file leaves the older one and no rest") {
  const Folder folder;
  const std::string input = folder.write("cube.off", cube_off());
  Denied denied;
  denied.file_bytes = 100;
  for (const std::string name : {"out.scad", "out.json", "out.stl", "out.step"}) {
    CAPTURE(name);
    const std::string older = folder.write(name, "older");
    const auto before = folder.files();
    const Outcome outcome = run_hewn_with(denied, {"reconstruct", input, "-o", older});
    CHECK(outcome.exit_code == kNoOutput);
    CHECK_MESSAGE(outcome.says("cannot write"), outcome.err);
    CHECK_MESSAGE(outcome.says(older), outcome.err);
    CHECK(content_of(older) == "older");
    CHECK(folder.files() == before);
  }
  // The tree would fit, the report does not.
  denied.file_bytes = 1000;
  const Outcome outcome = run_hewn_with(
      denied, {"reconstruct", input, "-o", folder / "tree.scad", "--report", folder / "r.json"});
  CHECK(outcome.exit_code == kNoOutput);
  CHECK_MESSAGE(outcome.says("r.json"), outcome.err);
}

TEST_CASE("a full standard output is an error") {
  const Folder folder;
  Denied denied;
  denied.out = "/dev/full";
  const Outcome info = run_hewn_with(denied, {"info", folder.write("cube.off", cube_off())});
  CHECK(info.exit_code == kNoOutput);
  CHECK_MESSAGE(info.says("standard output"), info.err);
  const Outcome outcome =
      run_hewn_with(denied, {"reconstruct", folder.write("cube.off", cube_off()), "-o", "-"});
  CHECK(outcome.exit_code == kNoOutput);
  CHECK_MESSAGE(outcome.says("standard output"), outcome.err);
}

TEST_CASE("info prints JSON that says what was read") {
  const Folder folder;
  const Outcome outcome = run_hewn({"info", folder.write("cube.off", cube_off()), "--json"});
  REQUIRE(outcome.exit_code == 0);
  const auto json = nlohmann::json::parse(outcome.out);
  CHECK(json.at("triangles") == 12);
  CHECK(json.at("is_closed") == true);
  CHECK(json.at("volume").get<double>() == doctest::Approx(1000));
}

TEST_CASE("segment lists the six sides of a cube and writes them as JSON") {
  const Folder folder;
  const Outcome outcome =
      run_hewn({"segment", folder.write("cube.off", cube_off()), "-o", folder / "groups.json"});
  REQUIRE_MESSAGE(outcome.exit_code == 0, outcome.err);
  const auto json = nlohmann::json::parse(content_of(folder / "groups.json"));
  REQUIRE(json.at("groups").size() == 6);
  for (const auto& group : json.at("groups")) {
    CHECK(group.at("kind") == "plane");
    CHECK(group.at("triangles").size() == 2);
  }
}

TEST_CASE("help and version end well") {
  CHECK(run_hewn({"--help"}).exit_code == 0);
  CHECK(run_hewn({"reconstruct", "--help"}).out.find("--tree-starts") != std::string::npos);
  CHECK(run_hewn({"--version"}).out.find("hewn") != std::string::npos);
}

}  // namespace
}  // namespace hewn::cli
