// Ctrl-C ends the program quickly and leaves no half-written file; so does a time limit.
#include <filesystem>
#include <string>

#include <doctest/doctest.h>
#include <nlohmann/json.hpp>

#include "core/mesh/load.h"
#include "tests/cli/program.h"
#include "tests/support/solids.h"

namespace hewn::cli {
namespace {

#ifdef HEWN_SANITIZED
constexpr double kPatience = 3;  // instrumented code polls as often, but runs slower
#else
constexpr double kPatience = 0.35;  // 0.1 s on an idle machine; tests run side by side
#endif

/// Folders that an interrupted run may have left where temporary files go.
int temporary_folders() {
  int count = 0;
  for (const auto& entry :
       std::filesystem::directory_iterator(std::filesystem::temp_directory_path())) {
    const std::string name = entry.path().filename().string();
    count += name.starts_with("hewn_") && !name.starts_with("hewn_cli_") ? 1 : 0;
  }
  return count;
}

void check_stopped(const Outcome& outcome) {
  CHECK_MESSAGE(outcome.exit_code == 130, outcome.err);
  CHECK(outcome.seconds < kPatience);
  CHECK_MESSAGE(outcome.says("stopped on request"), outcome.err);
}

TEST_CASE("Ctrl-C at any time ends within a moment and leaves nothing behind") {
  const std::string input = HEWN_ASSETS "/knob.ply";
  for (const double after : {0.01, 0.05, 0.15, 0.4}) {
    CAPTURE(after);
    const Folder folder;
    const Outcome outcome =
        run_hewn({"reconstruct", input, "-o", folder / "out.scad", "--tree-neighbourhood-steps",
                  "1000000", "--tree-starts", "64"},
                 after);
    // A fast machine may be done before the signal.
    if (outcome.exit_code == 0) continue;
    CHECK(outcome.exit_code == 130);
    CHECK(outcome.seconds < kPatience);
    CHECK(folder.files().empty());
  }
}

TEST_CASE("Ctrl-C stops every stage of a reconstruction") {
  const Folder folder;
  const std::string fine = folder / "fine.stl";
  REQUIRE(save_mesh(solids::torus(30, 10, 500, 300), fine));
  const std::string knob = HEWN_ASSETS "/knob.ply";
  const std::string cube = folder.write("cube.off", cube_off());
  struct Stage {
    std::string name, input;
    std::vector<std::string> flags;
  };
  // Options that make the stage take far longer than the patience.
  const std::vector<Stage> stages = {
      {"reading", fine, {}},
      {"repairing", fine, {}},
      {"segment", fine, {}},
      {"grow face groups", fine, {"--segment-method", "curvature"}},
      {"sample", cube, {"--tree-volume-points", "10000000"}},
      {"search", knob, {"--tree-neighbourhood-steps", "1000000", "--tree-starts", "64"}},
      {"verify", cube, {"--verify-volume-points", "10000000"}},
  };
  const auto before = folder.files();
  for (const Stage& stage : stages) {
    CAPTURE(stage.name);
    std::vector<std::string> arguments = {"reconstruct", stage.input, "-o", folder / "out.scad"};
    arguments.insert(arguments.end(), stage.flags.begin(), stage.flags.end());
    const StageInterrupt stopped = interrupt_at(stage.name, arguments);
    CHECK_MESSAGE(stopped.has_reached, stopped.outcome.err);
    check_stopped(stopped.outcome);
    CHECK(folder.files() == before);
  }
}

TEST_CASE("Ctrl-C stops comparing and the other programs that are run for it") {
  const Folder folder;
  const int temporary = temporary_folders();
  const std::string cube = folder.write("cube.off", cube_off());
  const StageInterrupt meshes =
      interrupt_at("comparing", {"compare", cube, cube, "--points", "10000000"});
  CHECK(meshes.has_reached);
  check_stopped(meshes.outcome);
  if (std::system("command -v openscad >/dev/null") != 0) return;
  const std::string slow = folder.write(
      "slow.scad", "minkowski() { sphere(5, $fn = 90); rotate([1, 2, 3]) sphere(9, $fn = 90); }");
  const StageInterrupt rendering = interrupt_at("openscad", {"compare", cube, slow});
  CHECK(rendering.has_reached);
  check_stopped(rendering.outcome);
  CHECK(temporary_folders() == temporary);
}

TEST_CASE("Ctrl-C amid an export leaves no file and no temporary folder") {
  const Folder folder;
  const std::string tree = folder / "tree.json";
  REQUIRE(run_hewn({"reconstruct", HEWN_ASSETS "/housing.stl", "-o", tree}).exit_code == 0);
  const int temporary = temporary_folders();
  for (const double after : {0.03, 0.1}) {
    const Outcome outcome = run_hewn({"export", tree, "-o", folder / "out.stl"}, after);
    if (outcome.exit_code == 0) continue;  // done before the signal
    CHECK(outcome.exit_code == 130);
    CHECK(outcome.seconds < kPatience);
    CHECK(folder.files() == std::vector<std::string>{"tree.json"});
    CHECK(temporary_folders() == temporary);
  }
}

TEST_CASE("an older result survives an interrupted run") {
  const Folder folder;
  folder.write("out.scad", "older");
  const Outcome outcome =
      run_hewn({"reconstruct", HEWN_ASSETS "/knob.ply", "-o", folder / "out.scad",
                "--tree-neighbourhood-steps", "1000000", "--tree-starts", "64"},
               0.1);
  if (outcome.exit_code != 0) CHECK(content_of(folder / "out.scad") == "older");
  CHECK(folder.files() == std::vector<std::string>{"out.scad"});
}

TEST_CASE("a time limit ends the search with the best tree so far") {
  const Folder folder;
  const std::string report = folder / "report.json";
  const std::vector<std::string> thorough = {
      "reconstruct", HEWN_ASSETS "/housing.stl",   "-o",      folder / "out.scad", "--report",
      report,        "--tree-neighbourhood-steps", "1000000", "--tree-starts",     "64"};
  const auto terms_grown = [&report] {
    const auto json = nlohmann::json::parse(content_of(report));
    return json.at("partitions").at(0).at("search").at("terms_grown").get<long>();
  };
  std::vector<std::string> limited = thorough;
  limited.insert(limited.end(), {"--time-limit", "0.2"});
  const Outcome outcome = run_hewn(limited);
  REQUIRE_MESSAGE(outcome.exit_code == 0, outcome.err);
  CHECK(nlohmann::json::parse(content_of(report)).at("geometry").at("iou").get<double>() > 0.95);
  CHECK(content_of(folder / "out.scad").size() > 100);
  const long with_limit = terms_grown();
  REQUIRE(run_hewn(thorough).exit_code == 0);
  CHECK(with_limit < terms_grown());
  for (const char* bad : {"0", "-1", "soon"}) {
    const Outcome refused = run_hewn(
        {"reconstruct", HEWN_ASSETS "/knob.ply", "-o", folder / "no.scad", "--time-limit", bad});
    CHECK(refused.exit_code == 2);
    CHECK_MESSAGE(refused.says("--time-limit"), refused.err);
  }
}

}  // namespace
}  // namespace hewn::cli
