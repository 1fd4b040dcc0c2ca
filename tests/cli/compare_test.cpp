// Meshes, trees and designs compared with a mesh; what is refused and how.
#include <cstdlib>
#include <string>

#include <doctest/doctest.h>
#include <nlohmann/json.hpp>

#include "tests/cli/program.h"

namespace hewn::cli {
namespace {

constexpr int kFailed = 1, kUsage = 2, kNoInput = 3, kBadInput = 4;

/// Compares and returns the report.
nlohmann::json compared(const Folder& folder, const std::string& a, const std::string& b) {
  const std::string report = folder / "report.json";
  const Outcome outcome = run_hewn({"compare", a, b, "--points", "5000", "--report", report});
  REQUIRE_MESSAGE(outcome.exit_code == 0, outcome.err);
  CHECK(outcome.out.find("IoU") != std::string::npos);
  return nlohmann::json::parse(content_of(report));
}

TEST_CASE("cubes of sides 10 and 11 with a common corner") {
  const Folder folder;
  const std::string a = folder.write("a.off", cube_off(10));
  const auto report = compared(folder, a, folder.write("b.off", cube_off(11)));
  CHECK(report.at("iou").get<double>() == doctest::Approx(1000.0 / 1331).epsilon(0.02));
  // The far corners are 1 * sqrt 3 apart, the diagonal is 10 * sqrt 3.
  CHECK(report.at("hausdorff_rel").get<double>() == doctest::Approx(0.1).epsilon(1e-4));
  CHECK(report.at("diagonal").get<double>() == doctest::Approx(17.3205).epsilon(1e-4));
  const auto same = compared(folder, a, a);
  CHECK(same.at("iou") == 1);
  CHECK(same.at("hausdorff_rel").get<double>() < 1e-6);
}

TEST_CASE("a mesh and its tree") {
  const Folder folder;
  const std::string mesh = folder.write("cube.off", cube_off());
  const std::string tree = folder / "tree.json";
  REQUIRE(run_hewn({"reconstruct", mesh, "-o", tree}).exit_code == 0);
  const auto report = compared(folder, mesh, tree);
  CHECK(report.at("iou").get<double>() > 0.999);
  CHECK(report.at("hausdorff_rel").get<double>() < 1e-4);
  const auto other = compared(folder, folder.write("small.off", cube_off(5)), tree);
  CHECK(other.at("hausdorff_rel").get<double>() > 0.5);
  CHECK(other.at("iou").get<double>() < 0.2);
}

TEST_CASE("a mesh and a design, with and without openscad") {
  const Folder folder;
  const std::string mesh = folder.write("cube.off", cube_off());
  const std::string design = folder.write("cube.scad", "cube(10);\n");
  if (std::system("command -v openscad >/dev/null") == 0) {
    CHECK(compared(folder, mesh, design).at("hausdorff_rel").get<double>() < 1e-5);
    const Outcome broken = run_hewn({"compare", mesh, folder.write("broken.scad", "cube(10")});
    CHECK(broken.exit_code == kBadInput);
    CHECK_MESSAGE(broken.says("broken.scad"), broken.err);
  }
  const char* path = std::getenv("PATH");
  const std::string kept = path == nullptr ? "" : path;
  ::setenv("PATH", "/nowhere", 1);
  const Outcome without = run_hewn({"compare", mesh, design});
  ::setenv("PATH", kept.c_str(), 1);
  CHECK(without.exit_code == kFailed);
  CHECK_MESSAGE(without.says("install"), without.err);
  CHECK_MESSAGE(without.says(".json"), without.err);
}

TEST_CASE("what cannot be compared is refused") {
  const Folder folder;
  const std::string mesh = folder.write("cube.off", cube_off());
  const Outcome extension = run_hewn({"compare", mesh, folder.write("b.doc", cube_off())});
  CHECK(extension.exit_code == kUsage);
  for (const char* allowed : {".off", ".stl", ".obj", ".ply", ".scad", ".json"}) {
    CHECK_MESSAGE(extension.says(allowed), extension.err);
  }
  for (const char* name : {"no.off", "no.json", "no.scad"}) {
    CAPTURE(name);
    const Outcome missing = run_hewn({"compare", mesh, folder / name});
    CHECK(missing.exit_code == kNoInput);
    CHECK_MESSAGE(missing.says(name), missing.err);
  }
  const Outcome malformed = run_hewn({"compare", mesh, folder.write("cut.json", "{")});
  CHECK(malformed.exit_code == kBadInput);
  CHECK_MESSAGE(malformed.says("cut.json"), malformed.err);
  const std::string empty = R"({"format": "hewn-tree", "version": 1, "root": null})";
  CHECK(run_hewn({"compare", mesh, folder.write("empty.json", empty)}).exit_code == kBadInput);
  CHECK(run_hewn({"compare", mesh, mesh, "--points", "1"}).exit_code == kUsage);
  CHECK(run_hewn({"compare", mesh}).exit_code == kUsage);
  CHECK(run_hewn({"compare", folder / "a.json", mesh}).exit_code == kUsage);
}

}  // namespace
}  // namespace hewn::cli
