// The tree in every format, from `export` and from `reconstruct`; what is refused and how.
#include <string>

#include <doctest/doctest.h>
#include <nlohmann/json.hpp>

#include "tests/cli/program.h"

namespace hewn::cli {
namespace {

constexpr int kUsage = 2, kNoInput = 3, kBadInput = 4, kNoOutput = 5;

/// The tree of a cube with side 10 as JSON.
std::string cube_tree(const Folder& folder) {
  const std::string tree = folder / "tree.json";
  const Outcome made = run_hewn({"reconstruct", folder.write("cube.off", cube_off()), "-o", tree});
  REQUIRE_MESSAGE(made.exit_code == 0, made.err);
  return tree;
}

TEST_CASE("a tree is exported as meshes of its volume") {
  const Folder folder;
  const std::string tree = cube_tree(folder);
  for (const std::string extension : {".stl", ".off", ".obj", ".ply", ".STL"}) {
    CAPTURE(extension);
    const std::string mesh = folder / ("out" + extension);
    const Outcome outcome = run_hewn({"export", tree, "-o", mesh});
    REQUIRE_MESSAGE(outcome.exit_code == 0, outcome.err);
    const auto info = nlohmann::json::parse(run_hewn({"info", mesh, "--json"}).out);
    CHECK(info.at("is_closed") == true);
    CHECK(info.at("volume").get<double>() == doctest::Approx(1000).epsilon(1e-5));
  }
}

TEST_CASE("a tree is exported as a design, as the same JSON and as STEP") {
  const Folder folder;
  const std::string tree = cube_tree(folder);
  REQUIRE(run_hewn({"export", tree, "-o", folder / "out.scad"}).exit_code == 0);
  CHECK(content_of(folder / "out.scad").find("cube(") != std::string::npos);
  CHECK(run_hewn({"export", tree, "-o", "-"}).out == content_of(folder / "out.scad"));
  REQUIRE(run_hewn({"export", tree, "-o", folder / "again.json"}).exit_code == 0);
  CHECK(content_of(folder / "again.json") == content_of(tree));
  const Outcome step = run_hewn({"export", tree, "-o", folder / "out.step"});
  REQUIRE_MESSAGE(step.exit_code == 0, step.err);
  CHECK(content_of(folder / "out.step").starts_with("ISO-10303-21"));
}

TEST_CASE("a design that was edited by hand is exported") {
  const Folder folder;
  const std::string design = folder.write(
      "nut.scad",
      "$fn = 96;\ndifference() {\n  union() {\n    cylinder(r = 10, h = 8, $fn = 6);\n    "
      "cylinder(r = 9.81495458, h = 12, $fn = 6);\n  }\n  translate([0, 0, -1]) cylinder(r = 5, h "
      "= 20);\n}\n");
  REQUIRE(run_hewn({"export", design, "-o", folder / "nut.scad.json"}).exit_code == 0);
  REQUIRE(run_hewn({"export", design, "-o", folder / "again.scad"}).exit_code == 0);
  // Its own output, module and all, is read without any program's help.
  REQUIRE(run_hewn({"export", folder / "again.scad", "-o", folder / "third.scad"}).exit_code == 0);
  for (const char* name : {"again.scad", "third.scad"}) {
    const std::string text = content_of(folder / name);
    // Each with the radius that is round: of the corners, and across the flats.
    CHECK(text.find("cylinder(h = 8, r = 10, $fn = 6)") != std::string::npos);
    CHECK(text.find("prism(sides = 6, r = 8.5, h = 12)") != std::string::npos);
  }
  const Outcome step = run_hewn({"export", design, "-o", folder / "nut.step"});
  CHECK_MESSAGE(step.exit_code == 0, step.err);
}

TEST_CASE("a knob with round dents is exported as a closed mesh that is like its input") {
  // Merging the faces of its sphere tore it open.
  const Folder folder;
  const std::string knob = HEWN_ASSETS "/knob.ply";
  const std::string mesh = folder / "knob.stl";
  const Outcome outcome = run_hewn({"reconstruct", knob, "-o", mesh});
  REQUIRE_MESSAGE(outcome.exit_code == 0, outcome.err);
  const auto info = nlohmann::json::parse(run_hewn({"info", mesh, "--json"}).out);
  CHECK(info.at("is_closed") == true);
  const auto input = nlohmann::json::parse(run_hewn({"info", knob, "--json"}).out);
  CHECK(info.at("volume").get<double>() ==
        doctest::Approx(input.at("volume").get<double>()).epsilon(0.02));
}

TEST_CASE("reconstruct writes meshes and STEP like export") {
  const Folder folder;
  const std::string input = folder.write("cube.off", cube_off());
  for (const std::string name : {"out.stl", "out.step"}) {
    const Outcome outcome = run_hewn({"reconstruct", input, "-o", folder / name});
    REQUIRE_MESSAGE(outcome.exit_code == 0, outcome.err);
    CHECK(content_of(folder / name).size() > 600);
  }
}

TEST_CASE("what export cannot write or read is refused") {
  const Folder folder;
  const std::string tree = cube_tree(folder);
  const auto before = folder.files();
  const Outcome extension = run_hewn({"export", tree, "-o", folder / "out.doc"});
  CHECK(extension.exit_code == kUsage);
  for (const char* allowed : {".scad", ".json", ".stl", ".off", ".obj", ".ply", ".step"}) {
    CHECK_MESSAGE(extension.says(allowed), extension.err);
  }
  const Outcome missing = run_hewn({"export", folder / "no.json", "-o", folder / "out.scad"});
  CHECK(missing.exit_code == kNoInput);
  CHECK_MESSAGE(missing.says("no.json"), missing.err);
  CHECK(run_hewn({"export", tree, "-o", folder / "no/out.stl"}).exit_code == kNoOutput);
  CHECK(run_hewn({"export", tree}).exit_code == kUsage);
  CHECK(folder.files() == before);
}

TEST_CASE("a malformed tree is refused by its place") {
  const Folder folder;
  const std::string out = folder / "out.stl";
  const Outcome cut = run_hewn({"export", folder.write("cut.json", R"({"format": )"), "-o", out});
  CHECK(cut.exit_code == kBadInput);
  CHECK_MESSAGE(cut.says("cut.json"), cut.err);
  const std::string text = R"({"format": "hewn-tree", "version": 1, "root": {"op": "lathe"}})";
  const Outcome wrong = run_hewn({"export", folder.write("op.json", text), "-o", out});
  CHECK(wrong.exit_code == kBadInput);
  CHECK_MESSAGE(wrong.says("/root"), wrong.err);
  CHECK(content_of(out).empty());
}

}  // namespace
}  // namespace hewn::cli
