// Trees in, smaller trees out; what is refused and how.
#include <string>

#include <doctest/doctest.h>
#include <nlohmann/json.hpp>

#include "tests/cli/program.h"

namespace hewn::cli {
namespace {

constexpr int kUsage = 2, kNoInput = 3, kBadInput = 4, kNoOutput = 5;

/// A plate with a boss inside it, a hole, and a tool that misses.
constexpr const char* kDesign =
    "difference() {\n"
    "  union() { cube([40, 30, 5]); translate([10, 10, 1]) cube(3); }\n"
    "  translate([20, 15, -1]) cylinder(h = 9, r = 4, $fn = 48);\n"
    "  translate([90, 0, 0]) sphere(2);\n"
    "}\n";

TEST_CASE("a redundant design comes out smaller, with a report that proves it") {
  const Folder folder;
  const std::string input = folder.write("plate.scad", kDesign);
  const Outcome done =
      run_hewn({"optimise", input, "-o", folder / "out.scad", "--report", folder / "out.json"});
  REQUIRE_MESSAGE(done.exit_code == 0, done.err);
  CHECK(done.out.find("literals 4 -> 2, size 7 -> 3") != std::string::npos);
  const std::string design = content_of(folder / "out.scad");
  CHECK(design.find("cube([40, 30, 5])") != std::string::npos);
  CHECK(design.find("sphere") == std::string::npos);
  const auto report = nlohmann::json::parse(content_of(folder / "out.json"));
  CHECK(report.at("before").at("size") == 7);
  CHECK(report.at("after").at("size") == 3);
  CHECK(report.at("equivalence").at("points_different") == 0);
  CHECK(report.at("equivalence").at("cells_changed") == 0);
  CHECK(report.at("equivalence").at("points_compared").get<int>() > 45'000);
  CHECK(report.at("equivalence").at("largest_distance") == 0);
  // Reading its own output changes nothing more.
  const Outcome again = run_hewn({"optimise", folder / "out.scad", "-o", folder / "again.json"});
  CHECK(again.out.find("size 3 -> 3") != std::string::npos);
}

TEST_CASE("every method gives the same small tree of a design that is a chain") {
  const Folder folder;
  const std::string input = folder.write("plate.scad", kDesign);
  for (const std::string method : {"redundancy", "rewrite", "dominant", "quine-mccluskey",
                                   "espresso", "set-cover", "annealing", "genetic"}) {
    CAPTURE(method);
    const Outcome done =
        run_hewn({"optimise", input, "-o", folder / "out.json", "--method", method});
    REQUIRE_MESSAGE(done.exit_code == 0, done.err);
    CHECK(done.out.find("size 7 -> 3") != std::string::npos);
  }
  CHECK(run_hewn({"optimise", input, "-o", folder / "o.json", "--method", "magic"}).exit_code ==
        kUsage);
}

TEST_CASE("the front holds whole trees, the best of them the optimised one") {
  const Folder folder;
  const std::string input = folder.write("plate.scad", kDesign);
  const Outcome done = run_hewn({"optimise", input, "-o", folder / "out.json", "--front",
                                 folder / "front.json", "--qubo", folder / "q.json"});
  REQUIRE_MESSAGE(done.exit_code == 0, done.err);
  const auto front = nlohmann::json::parse(content_of(folder / "front.json"));
  REQUIRE_FALSE(front.at("members").empty());
  CHECK(front["members"][0].at("geometry") == 1);
  CHECK(front["members"][0].at("size") == 3);
  const std::string tree = folder.write("best.json", front["members"][0].at("tree").dump());
  CHECK(run_hewn({"export", tree, "-o", folder / "best.scad"}).exit_code == 0);
  CHECK(nlohmann::json::parse(content_of(folder / "q.json")).at("hewn-qubo") == 1);
}

TEST_CASE("an inflated design comes back to its size") {
  const Folder folder;
  const std::string input = folder.write("plate.scad", kDesign);
  const Outcome larger = run_hewn({"inflate", input, "-o", folder / "large.json", "--seed", "5"});
  REQUIRE_MESSAGE(larger.exit_code == 0, larger.err);
  const Outcome back = run_hewn({"optimise", folder / "large.json", "-o", folder / "out.json"});
  REQUIRE_MESSAGE(back.exit_code == 0, back.err);
  CHECK(back.out.find("-> 3,") != std::string::npos);
  CHECK(run_hewn({"inflate", input, "-o", folder / "x.json", "--absorption", "2"}).exit_code ==
        kUsage);
}

TEST_CASE("a solid that is empty says so") {
  const Folder folder;
  const std::string input =
      folder.write("gone.csg", "difference() { cube(1); translate([-1, -1, -1]) cube(4); }");
  const Outcome done = run_hewn({"optimise", input, "-o", folder / "out.json"});
  REQUIRE_MESSAGE(done.exit_code == 0, done.err);
  CHECK(done.out.find("the solid is empty") != std::string::npos);
  CHECK(content_of(folder / "out.json").find("\"root\": null") != std::string::npos);
}

TEST_CASE("bad trees are refused with their place, and nothing is written") {
  const Folder folder;
  const auto refused = [&](const std::string& name, const std::string& text, int code,
                           const std::string& part) {
    const std::string input = folder.write(name, text);
    const Outcome done = run_hewn({"optimise", input, "-o", folder / "out.scad"});
    CHECK_MESSAGE(done.exit_code == code, name << ": " << done.err);
    CHECK_MESSAGE(done.says(part), done.err);
    CHECK(content_of(folder / "out.scad").empty());
  };
  refused("zero.scad", "cube(1);\n cube([1, 0, 1]);", kBadInput, "zero.scad:2:2");
  refused("brace.csg", "union() { cube(1);", kBadInput, "brace.csg:1:19");
  refused("cycle.scad", "module a() { a(); }\na();", kBadInput, "cycle.scad:1:14");
  refused("nan.scad", "cube(nan);", kBadInput, "nan.scad:1:6");
  refused("empty.scad", "", kBadInput, "empty");
  refused("tree.json", R"({"format": "hewn-tree"})", kBadInput, "tree.json");
  refused("tree.stl", "solid", kUsage, ".scad, .csg or .json");
  const Outcome missing = run_hewn({"optimise", folder / "no.scad", "-o", folder / "out.scad"});
  CHECK(missing.exit_code == kNoInput);
  const std::string good = folder.write("good.scad", "cube(1);");
  CHECK(run_hewn({"optimise", good, "-o", folder / "no/out.scad"}).exit_code == kNoOutput);
  CHECK(run_hewn({"optimise", good, "-o", folder / "out.doc"}).exit_code == kUsage);
  CHECK(run_hewn({"optimise", good, "-o", folder / "o.scad", "--tolerance", "2"}).exit_code ==
        kUsage);
}

TEST_CASE("enormous trees are refused at once, and nothing is written") {
  const Folder folder;
  std::string many = "union() {\n";
  for (int i = 0; i < 10'000; ++i) {
    many += "translate([" + std::to_string(2 * (i % 100)) + ", " + std::to_string(2 * (i / 100)) +
            ", 0]) cube(1);\n";
  }
  const std::string large = folder.write("large.scad", many + "}\n");
  const Outcome refused = run_hewn({"optimise", large, "-o", folder / "out.scad"});
  CHECK(refused.exit_code == kBadInput);
  CHECK_MESSAGE(refused.says("more than 2000 primitives"), refused.err);
  CHECK(refused.says("large.scad:2002:"));
  CHECK(refused.seconds < 10);
  CHECK(content_of(folder / "out.scad").empty());
  std::string deep;
  for (int i = 0; i < 5'000; ++i) deep += "union() {\n";
  const Outcome nested =
      run_hewn({"optimise", folder.write("deep.scad", deep), "-o", folder / "out.scad"});
  CHECK(nested.exit_code == kBadInput);
  CHECK_MESSAGE(nested.says("deep.scad:402:1"), nested.err);
  CHECK(content_of(folder / "out.scad").empty());
}

}  // namespace
}  // namespace hewn::cli
