#include "core/csg/turned_faces.h"

#include <vector>

#include <doctest/doctest.h>

#include "core/base/math.h"
#include "tests/core/csg/box.h"

namespace hewn {
namespace {

Mat3 turned_about_z(double angle_rad) {
  return Eigen::AngleAxisd(angle_rad, Vec3::UnitZ()).toRotationMatrix();
}

using testing::box;

/// A plate at rest, so large that it sets the main axes together with a second one.
struct Fixture {
  Tree tree;
  Mat3 turn = turned_about_z(0.3);
  int plate = tree.add_literal(box({-5, -5, -3}, {5, 5, -2}));
  int second = tree.add_literal(box({-5, -5, -4}, {5, 5, -3}));
  int third = tree.add_literal(box({-5, -5, -5}, {5, 5, -4}));

  const Literal& literal(const Tree& t, int node) const {
    return t.literals[t.nodes[node].literal];
  }
};

TEST_CASE("a turned tool that ends flush with what it cuts reaches through") {
  Fixture f;
  const int bar = f.tree.add_literal(box({0, 0, 0}, {2, 2, 2}, f.turn));
  const int tool = f.tree.add_literal(box({1, 0.5, 0.5}, {2, 1.5, 1.5}, f.turn));
  const int cut = f.tree.add_node(Op::Difference, {bar, tool});
  f.tree.root = f.tree.add_node(Op::Union, {f.plate, f.second, f.third, cut});
  const Tree apart = with_turned_faces_apart(f.tree);
  CHECK(f.literal(apart, tool).size == Vec3(1.0001, 1, 1));
  CHECK(f.literal(apart, tool).origin == f.literal(f.tree, tool).origin);
  CHECK(f.literal(apart, bar).size == Vec3(2, 2, 2));
}

TEST_CASE("turned solids back to back overlap") {
  Fixture f;
  const int left = f.tree.add_literal(box({0, 0, 0}, {2, 2, 2}, f.turn));
  const int right = f.tree.add_literal(box({2, 0, 0}, {3, 2, 2}, f.turn));
  f.tree.root = f.tree.add_node(Op::Union, {f.plate, f.second, f.third, left, right});
  const Tree apart = with_turned_faces_apart(f.tree);
  CHECK(f.literal(apart, left).size.x() == 2.0001);
  CHECK(f.literal(apart, right).origin.x() == 2);
}

TEST_CASE("a solid put back over a turned cut covers the cut's end") {
  Fixture f;
  const int bar = f.tree.add_literal(box({0, 0, 0}, {4, 2, 2}, f.turn));
  const int tool = f.tree.add_literal(box({1, -1, -1}, {3, 3, 3}, f.turn));
  const int cut = f.tree.add_node(Op::Difference, {bar, tool});
  const int plug = f.tree.add_literal(box({2, 0, 0}, {3, 2, 2}, f.turn));
  f.tree.root = f.tree.add_node(Op::Union, {f.plate, f.second, f.third, cut, plug});
  const Tree apart = with_turned_faces_apart(f.tree);
  CHECK(f.literal(apart, plug).size.x() == 1.0001);
  CHECK(f.literal(apart, tool).size == Vec3(2, 4, 4));
}

TEST_CASE("what cuts over a face that was moved reaches further still") {
  Fixture f;
  const int bar = f.tree.add_literal(box({0, 0, 0}, {4, 2, 2}, f.turn));
  const int tool = f.tree.add_literal(box({1, -1, -1}, {3, 3, 3}, f.turn));
  const int cut = f.tree.add_node(Op::Difference, {bar, tool});
  const int plug = f.tree.add_literal(box({2, 0, 0}, {3, 2, 2}, f.turn));
  const int mended = f.tree.add_node(Op::Union, {cut, plug});
  const int bore = f.tree.add_literal(box({2.5, 0.5, -1}, {3, 1.5, 3}, f.turn));
  const int bored = f.tree.add_node(Op::Difference, {mended, bore});
  const int fourth = f.tree.add_literal(box({-5, -5, -6}, {5, 5, -5}));
  const int fifth = f.tree.add_literal(box({-5, -5, -7}, {5, 5, -6}));
  f.tree.root = f.tree.add_node(Op::Union, {f.plate, f.second, f.third, fourth, fifth, bored});
  const Tree apart = with_turned_faces_apart(f.tree);
  CHECK(f.literal(apart, plug).size.x() == doctest::Approx(1.0001).epsilon(1e-9));
  CHECK(f.literal(apart, bore).size.x() == doctest::Approx(0.5002).epsilon(1e-9));
  CHECK(f.literal(apart, tool).size == Vec3(2, 4, 4));
}

TEST_CASE(
    "round literals count for the frame of the boxes, however they are turned about their axes") {
  Fixture f;
  const int a = f.tree.add_literal(box({0, 0, 0}, {2, 2, 2}));
  const int b = f.tree.add_literal(box({2, 0, 0}, {3, 2, 2}));
  std::vector<int> parts{f.plate, f.second, f.third, a, b};
  for (int k = 0; k < 9; ++k) {
    Literal pin;
    pin.kind = SolidKind::Cylinder;
    pin.rotation = f.turn;
    pin.radius = pin.top_radius = 0.1;
    pin.height = 1;
    parts.push_back(f.tree.add_literal(pin));
  }
  f.tree.root = f.tree.add_node(Op::Union, parts);
  const Tree apart = with_turned_faces_apart(f.tree);
  CHECK(f.literal(apart, a).size == Vec3(2, 2, 2));
  CHECK(f.literal(apart, b).size == Vec3(1, 2, 2));
}

TEST_CASE("faces along the main axes, apart, or side by side stay") {
  Fixture f;
  const int bar = f.tree.add_literal(box({0, 0, -2}, {2, 2, 2}));  // on the plate
  const int turned = f.tree.add_literal(box({0, 3, 0}, {2, 5, 2}, f.turn));
  const int far = f.tree.add_literal(box({2, 8, 0}, {3, 9, 2}, f.turn));  // one plane, no overlap
  const int gap = f.tree.add_literal(box({2.01, 3, 0}, {3, 5, 2}, f.turn));
  f.tree.root = f.tree.add_node(Op::Union, {f.plate, f.second, f.third, bar, turned, far, gap});
  const Tree apart = with_turned_faces_apart(f.tree);
  for (std::size_t i = 0; i < apart.literals.size(); ++i) {
    CHECK(apart.literals[i].size == f.tree.literals[i].size);
    CHECK(apart.literals[i].origin == f.tree.literals[i].origin);
  }
}

/// A hexagonal bar from z = 0 to 4 around the origin, its sides 1 away, one of them facing -y.
Literal hexagonal_bar() {
  Literal s;
  s.kind = SolidKind::Prism;
  s.sides = 6;
  s.radius = 1;
  s.height = 4;
  return s;
}

TEST_CASE("the side of a prism stays and what meets it moves") {
  Fixture f;
  const Mat3 onto_side = turned_about_z(kPi / 6);  // x along the first side's normal
  const int block = f.tree.add_literal(box({-4, -4, 0}, {4, 4, 4}));
  SUBCASE("a tool beyond the side of a tool reaches into it") {
    const int bore = f.tree.add_literal(hexagonal_bar());
    const int slot = f.tree.add_literal(box({1, -0.2, 1}, {3, 0.2, 2}, onto_side));
    const int cut = f.tree.add_node(Op::Difference, {block, bore, slot});
    f.tree.root = f.tree.add_node(Op::Union, {f.plate, f.second, f.third, cut});
    const Tree apart = with_turned_faces_apart(f.tree);
    CHECK(f.literal(apart, slot).origin.x() == doctest::Approx(0.9999).epsilon(1e-9));
    CHECK(f.literal(apart, slot).size.x() == doctest::Approx(2.0001).epsilon(1e-9));
    CHECK(f.literal(apart, bore).radius == 1);
  }
  SUBCASE("a solid that a prism cuts flush ends short of it") {
    const int rib = f.tree.add_literal(box({0, -0.2, 1}, {1, 0.2, 2}, onto_side));
    const int bore = f.tree.add_literal(hexagonal_bar());
    const int cut = f.tree.add_node(Op::Difference, {rib, bore});
    f.tree.root = f.tree.add_node(Op::Union, {f.plate, f.second, f.third, block, cut});
    const Tree apart = with_turned_faces_apart(f.tree);
    CHECK(f.literal(apart, rib).size.x() == doctest::Approx(0.9999).epsilon(1e-9));
  }
  SUBCASE("along the main axes, too") {
    const int bar = f.tree.add_literal(hexagonal_bar());
    const int rib = f.tree.add_literal(box({-0.2, 1, 1}, {0.2, 3, 2}));
    f.tree.root = f.tree.add_node(Op::Union, {f.plate, f.second, f.third, bar, rib});
    const Tree apart = with_turned_faces_apart(f.tree);
    CHECK(f.literal(apart, rib).origin.y() == doctest::Approx(0.9999).epsilon(1e-9));
  }
  SUBCASE("beside the side is not on it") {
    const int bar = f.tree.add_literal(hexagonal_bar());
    const int rib = f.tree.add_literal(box({1, -0.2, 5}, {3, 0.2, 6}, onto_side));
    f.tree.root = f.tree.add_node(Op::Union, {f.plate, f.second, f.third, bar, rib});
    const Tree apart = with_turned_faces_apart(f.tree);
    CHECK(f.literal(apart, rib).size.x() == 2);
  }
}

TEST_CASE("the axes of most literals are the main ones, however the tree lies") {
  Fixture f;
  const int a = f.tree.add_literal(box({0, 0, 0}, {2, 2, 2}, f.turn));
  const int b = f.tree.add_literal(box({2, 0, 0}, {3, 2, 2}, f.turn));
  const int c = f.tree.add_literal(box({3, 0, 0}, {4, 2, 2}, f.turn));
  const int d = f.tree.add_literal(box({4, 0, 0}, {5, 2, 2}, f.turn));
  f.tree.root = f.tree.add_node(Op::Union, {f.plate, f.second, f.third, a, b, c, d});
  const Tree apart = with_turned_faces_apart(f.tree);
  CHECK(f.literal(apart, a).size.x() == 2);
  // Now the plates are the turned ones, but only their sides at an angle count.
  CHECK(f.literal(apart, f.plate).size.z() == 1);
}

TEST_CASE("an empty tree stays empty") { CHECK(with_turned_faces_apart(Tree{}).is_empty()); }

}  // namespace
}  // namespace hewn
