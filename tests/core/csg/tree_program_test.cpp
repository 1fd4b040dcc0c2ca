#include "core/csg/tree_program.h"

#include <cmath>
#include <string>

#include <doctest/doctest.h>

#include "tests/core/csg/random_tree.h"

namespace hewn {
namespace {

std::vector<bool> insides(const Tree& tree, const Vec3& x) {
  std::vector<bool> out;
  for (const Literal& s : tree.literals) out.push_back(s.signed_distance(x) < 0);
  return out;
}

/// The program's answer where `is_inside[l]` tells whether a point lies inside literal l.
bool answer(const TreeProgram& program, const std::vector<bool>& is_inside) {
  return program.run([&](std::uint32_t literal) { return is_inside[literal]; });
}

bool holds_polyhedron(const Tree& tree) {
  return std::any_of(tree.literals.begin(), tree.literals.end(),
                     [](const Literal& s) { return s.kind == SolidKind::Polyhedron; });
}

Literal ball(double radius) {
  Literal s;
  s.kind = SolidKind::Sphere;
  s.radius = radius;
  return s;
}

/// The solid's implicit function at local coordinates, negative inside, from a program's numbers.
double level(const ProgramLiteral& s, const Vec3& p) {
  const double a = s.shape[1];
  const double b = s.shape[2];
  const double c = s.shape[3];
  const double across = std::hypot(p.x(), p.y());
  switch (static_cast<SolidKind>(static_cast<int>(s.shape[0]))) {
    case SolidKind::Box:
      return (p - Vec3(a, b, c) / 2).cwiseAbs().cwiseQuotient(Vec3(a, b, c) / 2).maxCoeff() - 1;
    case SolidKind::Cylinder:
      return std::max({-p.z(), p.z() - c, across - (a + (b - a) * p.z() / c)});
    case SolidKind::Prism: {
      const double sector = 2 * kPi / c;
      const double angle = std::remainder(std::atan2(p.y(), p.x()) - sector / 2, sector);
      return std::max({-p.z(), p.z() - b, across * std::cos(angle) - a});
    }
    case SolidKind::Sphere:
      return p.norm() - a;
    case SolidKind::Torus:
      return std::hypot(across - a, p.z()) - b;
    case SolidKind::Polyhedron:
      break;
  }
  return kInfinity;
}

}  // namespace

TEST_CASE("a program answers as its tree does, for random trees with complements") {
  Rng rng(11);
  int compared = 0;
  int solid = 0;
  for (int i = 0; i < 300; ++i) {
    testing::TreeShape shape;
    shape.has_complements = true;
    Tree tree = testing::random_tree(rng, shape);
    // The answer has to do with the nodes alone: any bounded solid around it will do.
    const int box = tree.add_literal(ball(50));
    tree.root = tree.add_node(Op::Intersection, {box, tree.root});
    for (Literal& s : tree.literals) {
      if (s.kind == SolidKind::Polyhedron) s = ball(0.5);
    }
    const auto program = encode_tree(tree);
    if (!program) {  // operands of an intersection apart
      CHECK(program.error().message == "the solid is empty");
      continue;
    }
    for (int k = 0; k < 40; ++k) {
      const Vec3 x = testing::random_point(rng, 2.5);
      const bool expected = tree.contains(x);
      CHECK(answer(*program, insides(tree, x)) == expected);
      ++compared;
      solid += expected;
    }
  }
  CHECK(compared > 5000);
  CHECK(solid > compared / 20);
  CHECK(solid < compared * 19 / 20);
}

TEST_CASE("a program has one step a leaf, and steps lead only onwards") {
  Rng rng(12);
  for (int i = 0; i < 100; ++i) {
    const Tree tree = testing::random_tree(rng, {});
    if (holds_polyhedron(tree)) continue;
    const auto program = encode_tree(tree);
    if (!program) continue;  // an intersection of solids apart
    CHECK(static_cast<int>(program->steps.size()) == literal_count(tree));
    CHECK(program->start == 0);
    for (std::uint32_t at = 0; at < program->steps.size(); ++at) {
      CHECK(program->steps[at].inside > at);
      CHECK(program->steps[at].outside > at);
    }
  }
}

TEST_CASE("a program's numbers describe the literals, stretched ones as well") {
  Rng rng(13);
  int near_surface = 0;
  for (int i = 0; i < 400; ++i) {
    Literal s = testing::random_literal(rng);
    if (s.kind == SolidKind::Polyhedron) continue;
    if (i % 3 == 0) {
      Mat3 shear = Mat3::Identity();
      shear(0, 1) = rng.uniform(-0.5, 0.5);
      shear(2, 2) = rng.uniform(0.5, 1.5);
      s.stretch = Stretch::of(shear);
    }
    Tree tree;
    tree.root = tree.add_literal(s);
    const auto program = encode_tree(tree);
    REQUIRE(program);
    const ProgramLiteral& coded = program->literals[0];
    for (int k = 0; k < 30; ++k) {
      const Vec3 x = testing::random_point(rng, 2.5);
      if (std::abs(s.signed_distance(x)) < 1e-4) continue;  // single precision may tell otherwise
      const Vec3 y = x - program->origin;
      Vec3 local;
      for (int row = 0; row < 3; ++row) {
        const float* r = &coded.to_local[std::size_t{4} * static_cast<std::size_t>(row)];
        local[row] = r[0] * y.x() + r[1] * y.y() + r[2] * y.z() + r[3];
      }
      CHECK((level(coded, local) < 0) == (s.signed_distance(x) < 0));
      ++near_surface;
    }
  }
  CHECK(near_surface > 5000);
}

TEST_CASE("what the program cannot hold is refused with the reason") {
  const auto reason = [](const Tree& tree) {
    const auto program = encode_tree(tree);
    return program ? std::string() : program.error().message;
  };
  Tree tree;
  CHECK(reason(tree) == "the tree is empty");
  tree.root =
      tree.add_literal(polyhedron_literal(std::make_shared<const Mesh>(testing::tetrahedron(1))));
  CHECK(reason(tree) == "it holds a polyhedron");

  Tree fine;
  Literal prism;
  prism.kind = SolidKind::Prism;
  prism.radius = prism.height = 1;
  prism.sides = kMostProgramSides + 1;
  fine.root = fine.add_literal(prism);
  CHECK(reason(fine).find("65 sides") != std::string::npos);

  Tree many;
  std::vector<int> leaves;
  for (int i = 0; i <= kMostStretches; ++i) leaves.push_back(many.add_literal(ball(1)));
  many.root = many.add_node(Op::Union, leaves);
  CHECK(reason(many).find("129 literals") != std::string::npos);

  Tree outside;
  outside.root = outside.add_node(Op::Complement, {outside.add_literal(ball(1))});
  CHECK(reason(outside) == "the solid is unbounded");
}

TEST_CASE("a torus may be crossed twice by one ray") {
  Tree tree;
  Literal ring;
  ring.kind = SolidKind::Torus;
  ring.major_radius = 3;
  ring.radius = 1;
  const int a = tree.add_literal(ring);
  tree.root = tree.add_node(Op::Union, {a, tree.add_literal(ball(1))});
  const auto program = encode_tree(tree);
  REQUIRE(program);
  CHECK(program->stretches == 3);
  CHECK(program->bounds.hi.x() == doctest::Approx(4));
}

}  // namespace hewn
