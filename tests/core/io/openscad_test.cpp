#include "core/io/openscad.h"

#include <filesystem>

#include <doctest/doctest.h>

#include "core/base/file.h"
#include "tests/core/csg/box.h"
#include "tests/core/csg/random_tree.h"

namespace hewn {
namespace {

using testing::box;

Literal cylinder(double radius, double from, double to, const Mat3& rotation = Mat3::Identity()) {
  Literal s;
  s.kind = SolidKind::Cylinder;
  s.rotation = rotation;
  s.origin = Vec3(0, 0, from);
  s.height = to - from;
  s.radius = s.top_radius = radius;
  return s;
}

Mat3 about(const Vec3& axis, double degrees) {
  return Eigen::AngleAxisd(degrees * kPi / 180, axis).toRotationMatrix();
}

/// The text behind "$fn".
std::string body_of(const Tree& tree, const ScadOptions& options = {}) {
  const std::string text = to_openscad(tree, {}, options);
  return text.substr(text.find(";\n\n") + 3);
}

std::string body_of(const Literal& literal) {
  Tree tree;
  tree.root = tree.add_literal(literal);
  return body_of(tree);
}

TEST_CASE("a plate with a hole reads as a person would write it") {
  Tree tree;
  const int plate = tree.add_literal(box({-3, -3, -5}, {3.0000004, 3, 5}));
  const int hole = tree.add_literal(cylinder(0.74999904, -10, 10));
  tree.root = tree.add_node(Op::Difference, {plate, hole});
  ScadHeader header;
  header.part = "plate";
  header.proximity = 1.0;
  header.iou = 0.9999;
  CHECK(to_openscad(tree, header, {}) ==
        "// plate\n"
        "// 2 literals, 1 operation (size 3), proximity 1\n"
        "// Against the mesh: IoU 0.9999\n"
        "\n"
        "$fn = 96;\n"
        "\n"
        "difference() {\n"
        "  cube([6, 6, 10], center = true);\n"
        "  cylinder(h = 20, r = 0.75, center = true);\n"
        "}\n");
}

TEST_CASE("quarter turns disappear from boxes and become one angle for cylinders") {
  Mat3 turn;
  turn << Vec3::UnitY(), -Vec3::UnitX(), Vec3::UnitZ();
  CHECK(body_of(box({1, 2, 3}, {2, 4, 6}, turn)) == "translate([-4, 1, 3]) cube([2, 1, 3]);\n");
  Literal rod = cylinder(1, 2, 6, about(Vec3::UnitY(), 90));
  CHECK(body_of(rod) == "translate([2, 0, 0]) rotate([0, 90, 0]) cylinder(h = 4, r = 1);\n");
  rod.rotation = about(Vec3::UnitX(), 90);
  CHECK(body_of(rod) == "translate([0, -2, 0]) rotate([90, 0, 0]) cylinder(h = 4, r = 1);\n");
  rod.rotation = about(Vec3::UnitX(), -90);
  rod.top_radius = 0.5;
  CHECK(body_of(rod) ==
        "translate([0, 6, 0]) rotate([90, 0, 0]) cylinder(h = 4, r1 = 0.5, r2 = 1);\n");
}

TEST_CASE("a part turned as a whole is written upright under one rotation") {
  const Mat3 turn = about(Vec3::UnitZ(), 27);
  Tree tree;
  const int a = tree.add_literal(box({0, 0, 0}, {4, 2, 1}, turn));
  const int b = tree.add_literal(cylinder(0.5, -1, 3, turn * about(Vec3::UnitX(), 90)));
  tree.root = tree.add_node(Op::Difference, {a, b});
  CHECK(body_of(tree) ==
        "rotate([0, 0, 27]) difference() {\n"
        "  cube([4, 2, 1]);\n"
        "  translate([0, 1, 0]) rotate([90, 0, 0]) cylinder(h = 4, r = 0.5);\n"
        "}\n");
}

TEST_CASE("boxes that are square only within a tolerance keep their turn") {
  // The sides of a tilted spoke, as fits give them.
  Mat3 skew = about(Vec3::UnitZ(), 72) * about(Vec3::UnitY(), 5);
  skew.col(2) = (skew.col(2) + 6e-7 * skew.col(0)).normalized();
  Tree tree;
  const int hub = tree.add_literal(cylinder(2, 0, 3));
  const int spoke = tree.add_literal(box({0, -1, 0}, {9, 1, 1}, skew));
  tree.root = tree.add_node(Op::Union, {hub, spoke});
  CHECK(body_of(tree) ==
        "rotate([-5, 0, -18]) union() {\n"
        "  rotate([5, 0, 0]) cylinder(h = 3, r = 2);\n"
        "  translate([-1, 0, 0]) cube([2, 9, 1]);\n"
        "}\n");
}

TEST_CASE("spokes in many directions leave the design upright") {
  Tree tree;
  std::vector<int> parts = {tree.add_literal(cylinder(2, 0, 3))};
  for (int k = 0; k < 5; ++k) {
    const Mat3 turn = about(Vec3::UnitZ(), 10 + 72 * k) * about(Vec3::UnitY(), 5);
    parts.push_back(tree.add_literal(box({0, -1, 0}, {9, 1, 1}, turn)));
  }
  tree.root = tree.add_node(Op::Union, parts);
  const std::string body = body_of(tree);
  CHECK(body.starts_with("union() {\n  cylinder(h = 3, r = 2);\n"));
}

TEST_CASE("siblings of one turned frame share its rotation") {
  const Mat3 turn = about(Vec3::UnitZ(), 45);
  Tree tree;
  const int a = tree.add_literal(box({0, 0, 0}, {4, 2, 1}));
  const int b = tree.add_literal(box({0, 0, 0}, {1, 2, 3}, turn));
  const int c = tree.add_literal(box({1, 0, 0}, {2, 2, 3}, turn));
  tree.root = tree.add_node(Op::Difference, {a, b, c});
  // Lengthening the tools is another test's matter.
  const ScadOptions as_is = {.extend_tools = false};
  CHECK(body_of(tree, as_is) ==
        "difference() {\n"
        "  cube([4, 2, 1]);\n"
        "  rotate([0, 0, 45]) {\n"
        "    cube([1, 2, 3]);\n"
        "    translate([1, 0, 0]) cube([1, 2, 3]);\n"
        "  }\n"
        "}\n");
  tree.nodes[tree.root].op = Op::Intersection;
  CHECK(body_of(tree) ==
        "intersection() {\n"
        "  cube([4, 2, 1]);\n"
        "  rotate([0, 0, 45]) cube([1, 2, 3]);\n"
        "  rotate([0, 0, 45]) translate([1, 0, 0]) cube([1, 2, 3]);\n"
        "}\n");
}

TEST_CASE("a flush tool is lengthened where it leaves the solid") {
  Tree tree;
  const int plate = tree.add_literal(box({0, 0, 0}, {10, 10, 2}));
  Literal hole = cylinder(1, 0, 2);
  hole.origin += Vec3(5, 5, 0);
  tree.root = tree.add_node(Op::Difference, {plate, tree.add_literal(hole)});
  CHECK(body_of(tree) ==
        "difference() {\n"
        "  cube([10, 10, 2]);\n"
        "  translate([5, 5, -1]) cylinder(h = 4, r = 1);\n"
        "}\n");
}

TEST_CASE("a lone slanted rod stands on its base point") {
  Tree tree;
  const int a = tree.add_literal(box({0, 0, 0}, {4, 2, 1}));
  Literal rod = cylinder(0.5, 0, 3, about(Vec3::UnitY(), 30));
  rod.origin = rod.rotation.transpose() * Vec3(1, 1, 0.5);
  const int b = tree.add_literal(rod);
  tree.root = tree.add_node(Op::Union, {a, b});
  CHECK(body_of(tree) ==
        "union() {\n"
        "  cube([4, 2, 1]);\n"
        "  translate([1, 1, 0.5]) rotate([0, 30, 0]) cylinder(h = 3, r = 0.5);\n"
        "}\n");
}

TEST_CASE("faces that coincide print as the same number whatever the sizes") {
  Tree tree;
  const double face = 10.0 / 3;
  const int a = tree.add_literal(box({0.1234567, 0, 0}, {face, 9, 9}));
  const int b = tree.add_literal(box({face, 0, 0}, {5.7654321, 9, 9}));
  tree.root = tree.add_node(Op::Union, {a, b});
  CHECK(body_of(tree) ==
        "union() {\n"
        "  translate([0.12346, 0, 0]) cube([3.20987, 9, 9]);\n"
        "  translate([3.33333, 0, 0]) cube([2.4321, 9, 9]);\n"
        "}\n");
}

TEST_CASE("named nodes become modules, the inner ones first") {
  Tree tree;
  const int a = tree.add_literal(box({0, 0, 0}, {1, 1, 1}));
  const int b = tree.add_literal(box({2, 0, 0}, {3, 1, 1}));
  const int c = tree.add_literal(box({4, 0, 0}, {5, 1, 1}));
  tree.nodes[b].name = "pin";
  const int pair = tree.add_node(Op::Union, {a, b}, "two pins");
  tree.root = tree.add_node(Op::Union, {pair, c});
  CHECK(body_of(tree) ==
        "module pin() {\n"
        "  translate([2, 0, 0]) cube(1);\n"
        "}\n\n"
        "module two_pins() {\n"
        "  union() {\n"
        "    cube(1);\n"
        "    pin();\n"
        "  }\n"
        "}\n\n"
        "union() {\n"
        "  two_pins();\n"
        "  translate([4, 0, 0]) cube(1);\n"
        "}\n");
}

TEST_CASE("only matched facets print their own number of sides") {
  Literal rod = cylinder(2, 0, 5);
  rod.facets = {.sides = 30, .phase_rad = 5 * kPi / 180};
  Tree tree;
  tree.root = tree.add_literal(rod);
  CHECK(body_of(tree) == "cylinder(h = 5, r = 2);\n");
  CHECK(body_of(tree, {.match_facets = true}) ==
        "rotate([0, 0, 5]) cylinder(h = 5, r = 2, $fn = 30);\n");
}

TEST_CASE("a torus is revolved, and cut at its axis when it reaches it") {
  Literal torus;
  torus.kind = SolidKind::Torus;
  torus.major_radius = 3;
  torus.radius = 1;
  CHECK(body_of(torus) == "rotate_extrude() translate([3, 0]) circle(r = 1);\n");
  torus.major_radius = 0.5;
  CHECK(body_of(torus) ==
        "rotate_extrude() intersection() { translate([0.5, 0]) circle(r = 1); "
        "translate([0, -1]) square([1.5, 2]); }\n");
}

TEST_CASE("tiny designs are drawn in small units and scaled") {
  Literal s = box({0, 0, 0}, {0.001, 0.002, 0.003});
  Tree tree;
  tree.root = tree.add_literal(s);
  const std::string text = to_openscad(tree, {}, {});
  CHECK(text.find("Lengths are in units of 0.001") != std::string::npos);
  CHECK(text.find("scale(0.001) cube([1, 2, 3]);\n") != std::string::npos);
}

TEST_CASE("an empty tree gives a file that says so") {
  CHECK(to_openscad(Tree{}, {}, {}).find("The tree is empty") != std::string::npos);
}

TEST_CASE("what cannot be written is named") {
  Tree tree;
  tree.root = tree.add_literal(box({0, 0, 0}, {1, 1, HUGE_VAL}));
  const auto bad = write_openscad(tree, "/tmp/never.scad", {}, {});
  REQUIRE_FALSE(bad);
  CHECK(bad.error().code == ErrorCode::InvalidArgument);
  CHECK(bad.error().message.find("literal 0 (cube)") != std::string::npos);
  const auto few = write_openscad(Tree{}, "/tmp/never.scad", {}, {.segments = 2});
  REQUIRE_FALSE(few);
  const auto nowhere = write_openscad(Tree{}, "/no/such/folder/x.scad", {}, {});
  REQUIRE_FALSE(nowhere);
  CHECK(nowhere.error().code == ErrorCode::FileWrite);
  CHECK_FALSE(std::filesystem::exists("/tmp/never.scad"));
}

}  // namespace
}  // namespace hewn
