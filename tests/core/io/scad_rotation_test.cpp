#include "core/io/scad_rotation.h"

#include <cstdlib>

#include <doctest/doctest.h>

#include "tests/core/csg/random_tree.h"

namespace hewn {
namespace {

Mat3 matrix_of(const PrintedRotation& r) {
  const auto turn = [&](int axis) {
    const double degrees = std::strtod(r.angles[axis].c_str(), nullptr);
    return Eigen::AngleAxisd(degrees * kPi / 180, Vec3::Unit(axis)).toRotationMatrix();
  };
  return turn(2) * turn(1) * turn(0);
}

Mat3 about(const Vec3& axis, double degrees) {
  return Eigen::AngleAxisd(degrees * kPi / 180, axis).toRotationMatrix();
}

TEST_CASE("printed angles reproduce random rotations within the tolerance") {
  Rng rng(5);
  for (int i = 0; i < 300; ++i) {
    const Mat3 m = testing::random_rotation(rng);
    const double tolerance = std::pow(10.0, rng.uniform(-9, -3));
    const Mat3 printed = matrix_of(print_rotation(m, tolerance));
    CHECK((printed - m).cwiseAbs().maxCoeff() <= tolerance);
  }
}

TEST_CASE("turns about one axis print as that axis alone") {
  CHECK(print_rotation(about(Vec3::UnitX(), 30), 1e-7).text() == "rotate([30, 0, 0]) ");
  CHECK(print_rotation(about(Vec3::UnitY(), 120), 1e-7).text() == "rotate([0, 120, 0]) ");
  CHECK(print_rotation(about(Vec3::UnitY(), 90), 1e-7).text() == "rotate([0, 90, 0]) ");
  CHECK(print_rotation(about(Vec3::UnitZ(), -27), 1e-7).text() == "rotate([0, 0, -27]) ");
  CHECK(print_rotation(Mat3::Identity(), 1e-7).text().empty());
}

TEST_CASE("a frame's quarter turns all print the same") {
  Rng rng(6);
  for (int i = 0; i < 50; ++i) {
    const Mat3 frame = testing::random_rotation(rng);
    Mat3 turned;
    turned << frame.col(1), frame.col(2), frame.col(0);
    const auto a = print_rotation(readable_frame(frame, 1e-7), 1e-7);
    const auto b = print_rotation(readable_frame(turned, 1e-7), 1e-7);
    CHECK(a.angles == b.angles);
  }
  const Mat3 turned = about(Vec3::UnitZ(), 27) * about(Vec3::UnitY(), 90);
  CHECK(print_rotation(readable_frame(turned, 1e-7), 1e-7).text() == "rotate([0, 0, 27]) ");
}

TEST_CASE("an axis rotation takes z to the axis") {
  Rng rng(7);
  for (int i = 0; i < 300; ++i) {
    const Vec3 axis = testing::random_point(rng, 1).normalized();
    const bool may_flip = rng.coin();
    const AxisRotation r = print_axis_rotation(axis, may_flip, 1e-7);
    const Vec3 z = matrix_of(r.printed).col(2);
    CHECK((z - (r.is_flipped ? Vec3(-axis) : axis)).norm() < 1e-6);
    CHECK((r.matrix.col(2) - z).norm() < 1e-6);
    if (!may_flip) CHECK_FALSE(r.is_flipped);
  }
  CHECK(print_axis_rotation({0, std::sqrt(0.5), std::sqrt(0.5)}, true, 1e-7).printed.text() ==
        "rotate([-45, 0, 0]) ");
}

TEST_CASE("literals of a turned part share one frame") {
  Rng rng(8);
  const Mat3 turn = testing::random_rotation(rng);
  std::vector<Literal> literals(4);
  literals[0].rotation = turn;
  literals[1].rotation << turn.col(2), turn.col(0), turn.col(1);
  literals[2].kind = SolidKind::Cylinder;
  literals[2].rotation = turn * about(Vec3::UnitX(), 90) * about(Vec3::UnitZ(), 17);
  literals[3].kind = SolidKind::Sphere;
  const FrameSet set = find_frames(literals, 1e-7);
  CHECK(set.frames.size() == 2);
  CHECK(set.of_literal == std::vector<int>{1, 1, 1, 0});
  CHECK(set.members[1] == 3);
  CHECK(set.root == 1);
}

TEST_CASE("an upright part with turned details stays upright") {
  std::vector<Literal> literals(3);
  literals[1].rotation = about(Vec3::UnitZ(), 45);
  literals[2].rotation = about(Vec3::UnitZ(), 45);
  CHECK(find_frames(literals, 1e-7).root == 0);
}

}  // namespace
}  // namespace hewn
