#include "core/io/scad_read/scad_tree.h"

#include <string>

#include <doctest/doctest.h>

#include "core/io/json.h"
#include "core/io/openscad.h"
#include "tests/core/csg/random_tree.h"

namespace hewn {
namespace {

using testing::random_point;

Result<Tree> read(const std::string& text) { return tree_from_scad(text, "a.scad", {}, {}); }

Literal only_literal(const std::string& text) {
  const auto tree = read(text);
  REQUIRE(tree.has_value());
  REQUIRE(tree->literals.size() == 1);
  return tree->literals[0];
}

void check_fault(const std::string& text, ErrorCode code, const std::string& where,
                 const std::string& part) {
  const auto tree = read(text);
  REQUIRE_FALSE(tree.has_value());
  CHECK(tree.error().code == code);
  CHECK(tree.error().where == where);
  CHECK_MESSAGE(tree.error().message.find(part) != std::string::npos, tree.error().message);
}

TEST_CASE("primitives take named and positional arguments") {
  CHECK(only_literal("cube([1, 2, 3]);").size == Vec3(1, 2, 3));
  CHECK(only_literal("cube(size = 2, center = true);").origin == Vec3(-1, -1, -1));
  const Literal cone = only_literal("cylinder(4, 2, 1, true);");
  CHECK(cone.height == 4);
  CHECK(cone.radius == 2);
  CHECK(cone.top_radius == 1);
  CHECK(cone.origin.z() == -2);
  CHECK(only_literal("cylinder(h = 1, d = 3);").top_radius == 1.5);
  CHECK(only_literal("cylinder(h = 1, d1 = 3, r2 = 0);").radius == 1.5);
  CHECK(only_literal("sphere(d = 5);").radius == 2.5);
  CHECK(only_literal("sphere(2);").radius == 2);
  const Literal ring = only_literal("rotate_extrude($fn = 12) translate([5, 1, 0]) circle(r = 2);");
  CHECK(ring.kind == SolidKind::Torus);
  CHECK(ring.major_radius == 5);
  CHECK(ring.origin == Vec3(0, 0, 1));
}

TEST_CASE("quarter turns stay exact") {
  const Literal s = only_literal("rotate([180, 90, -90]) translate([1, 2, 3]) cube([4, 5, 6]);");
  for (int i = 0; i < 9; ++i) {
    const double x = s.rotation(i / 3, i % 3);
    CHECK((x == 0 || std::abs(x) == 1));
  }
  CHECK(s.size == Vec3(4, 5, 6));
}

TEST_CASE("transformations apply from the inside out") {
  const Literal s = only_literal("translate([1, 0, 0]) rotate(90) scale([1, 2, 1]) cube(1);");
  CHECK(s.signed_distance(Vec3(0, 0.5, 0.5)) < 0);
  CHECK(s.signed_distance(Vec3(-0.9, 0.5, 0.5)) < 0);
  CHECK(s.signed_distance(Vec3(-1.1, 0.5, 0.5)) > 0);
  const Literal m = only_literal(
      "multmatrix([[1, 0, 0, 5], [0, 1, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]]) mirror([1, 0, 0]) "
      "cube(1);");
  CHECK(m.signed_distance(Vec3(4.5, 0.5, 0.5)) < 0);
}

TEST_CASE("circles of few sides are prisms, others are true circles") {
  CHECK(only_literal("cylinder(r = 1, $fn = 6);").kind == SolidKind::Prism);
  CHECK(only_literal("$fn = 6; cylinder(r = 1);").kind == SolidKind::Prism);
  CHECK(only_literal("$fn = 4; cylinder(r1 = 1, r2 = 0);").kind == SolidKind::Polyhedron);
  const Literal tube = only_literal("cylinder(r = 1, $fn = 12);");
  CHECK(tube.kind == SolidKind::Cylinder);
  CHECK(tube.facets.sides == 12);
  const Literal nut = only_literal("cylinder(r = 1, h = 2, center = true, $fn = 6);");
  CHECK(nut.signed_distance(Vec3(0.99, 0, 0.99)) < 0);
  CHECK(nut.signed_distance(Vec3(0, 0.9, 0)) > 0);
  CHECK(nut.sides == 6);
  CHECK(nut.radius == doctest::Approx(std::sqrt(3.0) / 2));
}

TEST_CASE("operations, groups, constants, modules and modifiers make a tree") {
  const auto tree = read(
      "// plate\n$fn = 48; w = 4; /* hole */ module hole() { cylinder(r = w / 8, h = 3); }\n"
      "difference() { group() { cube([w, w * 2, 1]); } hole(); *sphere(9); %sphere(9); }\n");
  REQUIRE(tree.has_value());
  CHECK(literal_count(*tree) == 2);
  CHECK(tree->nodes[tree->root].op == Op::Difference);
  CHECK(tree->literals[1].radius == 0.5);
  CHECK(tree->nodes[tree->nodes[tree->root].children[1]].name == "hole");
}

TEST_CASE("the program's own .csg is understood") {
  const auto tree = read(
      "group() {\n\tmultmatrix([[1, 0, 0, 1], [0, 1, 0, 2], [0, 0, 1, 3], [0, 0, 0, 1]]) {\n"
      "\t\tcube(size = [1, 1, 1], center = false);\n\t}\n"
      "\tcylinder($fn = 0, $fa = 12, $fs = 2, h = 2, r1 = 1, r2 = 1, center = true);\n}\n");
  REQUIRE(tree.has_value());
  CHECK(literal_count(*tree) == 2);
  CHECK(tree->literals[0].origin == Vec3(1, 2, 3));
}

TEST_CASE("an operand without a solid is the empty set") {
  const auto tree = read("cube(1); intersection() { sphere(3); union() {} }");
  REQUIRE(tree.has_value());
  CHECK(tree->nodes[tree->root].op == Op::Literal);
}

TEST_CASE("faults name line and column") {
  check_fault("cube(1);\n  cube([1, 0, 2]);", ErrorCode::Format, "a.scad:2:3", "greater than zero");
  check_fault("union() {\n cube(1);\n", ErrorCode::Format, "a.scad:3:1", "'}' is missing");
  check_fault("union() { cube(1); } }", ErrorCode::Format, "a.scad:1:22", "cannot start");
  check_fault("cube(nan);", ErrorCode::Format, "a.scad:1:6", "finite");
  check_fault("cube(1e999);", ErrorCode::Format, "a.scad:1:6", "finite");
  check_fault("scale([1, 0, 1])\n cube(1);", ErrorCode::Format, "a.scad:1:1", "flattens");
  check_fault("cube(1) sphere", ErrorCode::Format, "a.scad:1:15", "'('");
  check_fault("/* never", ErrorCode::Format, "a.scad:1:1", "*/");
  check_fault("cube(@);", ErrorCode::Format, "a.scad:1:6", "no meaning");
  check_fault("module a() { b(); } module b() { a(); }\na();", ErrorCode::Format, "a.scad:1:34",
              "contains itself");
  check_fault("polyhedron([[0,0,0],[1,0,0],[0,1,0]], [[0,1,2]]);", ErrorCode::Format, "a.scad:1:1",
              "close");
  check_fault("", ErrorCode::Format, "a.scad", "empty");
}

TEST_CASE("what needs the program says so") {
  check_fault("for (i = [0:3]) cube(i);", ErrorCode::NotFound, "a.scad:1:1", "openscad");
  check_fault("cube(1);\nhull() { cube(1); sphere(1); }", ErrorCode::NotFound, "a.scad:2:1",
              "hull");
  check_fault("teapot();", ErrorCode::NotFound, "a.scad:1:1", "teapot");
  check_fault("module a(r) { sphere(r); } a(1);", ErrorCode::NotFound, "a.scad:1:1", "parameters");
  check_fault("cube(sin(30));", ErrorCode::NotFound, "a.scad:1:6", "sin");
}

TEST_CASE("what is not understood is rendered where there is a renderer") {
  ScadReadOptions options;
  std::string seen;
  options.render = [&seen](const std::string& text) -> Result<Mesh> {
    seen = text;
    return testing::tetrahedron(1);
  };
  const auto tree = tree_from_scad("translate([3, 0, 0]) hull() { cube(1); }", "a", options, {});
  REQUIRE(tree.has_value());
  CHECK(seen == "hull() { cube(1); }");
  CHECK(tree->signed_distance(Vec3(3.1, 0.1, 0.1)) < 0);
}

TEST_CASE("depth and number of solids are limited") {
  std::string deep;
  for (int i = 0; i < 1200; ++i) deep += "union() {";
  const auto nested = read(deep);
  REQUIRE_FALSE(nested.has_value());
  CHECK(nested.error().code == ErrorCode::TooLarge);
  std::string many;
  for (int i = 0; i < 10001; ++i) many += "cube(1);\n";
  const auto large = read(many);
  REQUIRE_FALSE(large.has_value());
  CHECK(large.error().code == ErrorCode::TooLarge);
  CHECK(large.error().where == "a.scad:10001:1");
}

/// A random tree whose literals may be stretched.
Tree stretched_tree(Rng& rng) {
  Tree tree = testing::random_tree(rng, {});
  for (Literal& s : tree.literals) {
    if (rng.below(3) != 0) continue;
    Affine3 map(testing::random_rotation(rng));
    for (int k = 0; k < 3; ++k) {
      const double factor = rng.uniform(0.4, 2);
      map.linear().row(k) *= factor;
    }
    if (s.kind != SolidKind::Torus || s.major_radius > s.radius) s = transformed(s, map);
  }
  return tree;
}

/// Printed lengths are rounded to a millionth of the size.
void check_same_solid(const Tree& a, const Tree& b, Rng& rng) {
  for (int i = 0; i < 300; ++i) {
    const Vec3 x = random_point(rng, 3);
    const double d = a.signed_distance(x);
    if (std::abs(d) < 1e-4) continue;
    REQUIRE((b.signed_distance(x) < 0) == (d < 0));
  }
}

TEST_CASE("what is written reads back as the same solid") {
  Rng rng(11);
  int trees = 0;
  for (int i = 0; i < 150; ++i) {
    const Tree tree = stretched_tree(rng);
    if (tree.bounds().is_empty()) continue;
    bool has_spindle = false;
    for (const Literal& s : tree.literals) {
      has_spindle |= s.kind == SolidKind::Torus && s.major_radius <= s.radius;
    }
    if (has_spindle) continue;  // printed as a clipped profile
    ++trees;
    ScadOptions exact;
    exact.extend_tools = false;
    const auto back = read(to_openscad(tree, {}, exact));
    REQUIRE(back.has_value());
    check_same_solid(tree, *back, rng);
    const auto json = tree_from_json(tree_to_json(tree), "a.json");
    REQUIRE(json.has_value());
    check_same_solid(tree, *json, rng);
  }
  CHECK(trees > 40);
}

TEST_CASE("any cut of a good text is refused or read, with a place") {
  const std::string text =
      "$fn = 48;\ndifference() {\n  translate([1, -2, 3e0]) cube([4, 5, 6], center = true);\n"
      "  rotate([0, 90, 0]) cylinder(h = 9, r1 = 1, r2 = 2); // hole\n}\n";
  for (std::size_t n = 0; n < text.size(); ++n) {
    const auto tree = read(text.substr(0, n));
    if (!tree.has_value()) CHECK(tree.error().where.rfind("a.scad", 0) == 0);
    std::string garbled = text;
    garbled[n] = ')';
    const auto odd = read(garbled);
    if (!odd.has_value()) CHECK_FALSE(odd.error().message.empty());
  }
}

}  // namespace
}  // namespace hewn
