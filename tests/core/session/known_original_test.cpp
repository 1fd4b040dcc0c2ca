// The shipped designs: what was drawn must come back, dimension by dimension.
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <utility>

#include <doctest/doctest.h>

#include "core/session/reconstruct.h"

namespace hewn {
namespace {

constexpr double kClose = 1e-4;  // of the diagonal
constexpr double kRound = 1e-9;  // all dimensions were drawn round

/// The tree of a shipped mesh, asked for the original's surfaces.
class Found {
 public:
  explicit Found(const char* file) {
    Project project;
    project.mesh = std::filesystem::path(HEWN_ASSETS) / file;
    auto made = reconstruct(project, {});
    REQUIRE(made.has_value());
    tree_ = std::move(made->tree);
    close_ = kClose * made->prepared.mesh->diagonal();
  }

  bool has_cylinder(const Vec3& point, const Vec3& axis, double radius) const {
    return any([&](const Literal& s) {
      return is_upright(s) && s.radius == s.top_radius && lies_on_axis(s, point, axis) &&
             std::abs(s.radius - radius) < kRound;
    });
  }

  /// A cone whose cross-sections at two points of its axis have these radii.
  bool has_cone(const Vec3& a, double radius_a, const Vec3& b, double radius_b) const {
    return any([&](const Literal& s) {
      return is_upright(s) && s.radius != s.top_radius &&
             lies_on_axis(s, a, (b - a).normalized()) &&
             std::abs(radius_at(s, a) - radius_a) < close_ &&
             std::abs(radius_at(s, b) - radius_b) < close_;
    });
  }

  bool has_torus(const Vec3& center, const Vec3& axis, double major, double minor) const {
    return any([&](const Literal& s) {
      return s.kind == SolidKind::Torus && lies_on_axis(s, center, axis) &&
             (s.to_world(Vec3::Zero()) - center).norm() < close_ &&
             std::abs(s.major_radius - major) < kRound && std::abs(s.radius - minor) < kRound;
    });
  }

  /// A flat side at `offset` along a coordinate axis.
  bool has_plane(int axis, double offset) const {
    return any([&](const Literal& s) {
      for (int k = s.kind == SolidKind::Box ? 0 : 2; k < 3; ++k) {
        if (s.kind != SolidKind::Box && s.kind != SolidKind::Cylinder) return false;
        if (std::abs(s.rotation.col(k)[axis]) < 1 - 1e-9) continue;
        const double length = s.kind == SolidKind::Box ? s.size[k] : s.height;
        for (const double end : {0.0, length}) {
          const double at = s.to_world(Vec3::Unit(k) * end)[axis];
          if (std::abs(at - offset) < kRound) return true;
        }
      }
      return false;
    });
  }

 private:
  template <class Test>
  bool any(const Test& test) const {
    return std::any_of(tree_.literals.begin(), tree_.literals.end(), test);
  }

  static bool is_upright(const Literal& s) { return s.kind == SolidKind::Cylinder; }

  bool lies_on_axis(const Literal& s, const Vec3& point, const Vec3& axis) const {
    const Vec3 own = s.rotation.col(2);
    const Vec3 away = point - s.to_world(Vec3::Zero());
    return own.cross(axis).norm() < kClose && (away - own * own.dot(away)).norm() < close_;
  }

  static double radius_at(const Literal& s, const Vec3& point) {
    return s.radius + (s.top_radius - s.radius) * s.to_local(point).z() / s.height;
  }

  Tree tree_;
  double close_ = 0;
};

const Vec3 kX = Vec3::UnitX();
const Vec3 kY = Vec3::UnitY();
const Vec3 kZ = Vec3::UnitZ();

TEST_CASE("the flange's radii, bolt circle, taper and faces come back as drawn") {
  const Found flange("flange.off");
  for (const double radius : {40.0, 24.0, 17.0, 13.0}) {
    CHECK(flange.has_cylinder(Vec3::Zero(), kZ, radius));
  }
  for (int i = 0; i < 6; ++i) {
    const double angle = i * kPi / 3;
    CHECK(flange.has_cylinder({32 * std::cos(angle), 32 * std::sin(angle), 0}, kZ, 3.5));
  }
  CHECK(flange.has_cone({0, 0, -14}, 17, {0, 0, 0}, 22));
  for (const double z : {8.0, 10.0, -24.0}) CHECK(flange.has_plane(2, z));
}

TEST_CASE("the shaft's steps, tapers, bore and keyway come back as drawn") {
  const Found shaft("shaft.stl");
  for (const double radius : {8.0, 6.5, 12.0, 9.0, 2.5}) {
    CHECK(shaft.has_cylinder(Vec3::Zero(), kX, radius));
  }
  CHECK(shaft.has_cone({0, 0, 0}, 7, {1, 0, 0}, 8));
  CHECK(shaft.has_cone({40, 0, 0}, 12, {55, 0, 0}, 9));
  CHECK(shaft.has_cone({79, 0, 0}, 9, {80, 0, 0}, 8));
  for (const double x : {0.0, 12.0, 20.0, 22.0, 58.0, 72.0, 80.0}) CHECK(shaft.has_plane(0, x));
  for (const double y : {-2.5, 2.5}) CHECK(shaft.has_plane(1, y));
  CHECK(shaft.has_plane(2, 5.5));
}

TEST_CASE("the elbow's bend and flange come back as drawn") {
  const Found elbow("elbow.off");
  for (const double minor : {12.0, 9.0}) CHECK(elbow.has_torus(Vec3::Zero(), kZ, 30, minor));
  CHECK(elbow.has_cylinder({30, 0, 0}, kY, 18));
  CHECK(elbow.has_plane(1, -5));
  for (const double side : {-16.0, 16.0}) CHECK(elbow.has_plane(2, side));
  for (const double y : {14.0, 46.0}) CHECK(elbow.has_plane(1, y));
}

TEST_CASE("the bracket's fillet, countersinks and rounded ends come back as drawn") {
  const Found bracket("bracket.off");
  CHECK(bracket.has_cylinder({33, 15, 0}, kZ, 3));
  CHECK(bracket.has_cone({33, 15, 2.5}, 3, {33, 15, 5}, 5.5));
  CHECK(bracket.has_cylinder({13, 0, 13}, kY, 8));
  for (const double y : {6.0, 24.0}) CHECK(bracket.has_cylinder({39, y, 0}, kZ, 6));
  for (const double z : {0.0, 5.0}) CHECK(bracket.has_plane(2, z));
}

TEST_CASE("the clevis comes back as drawn though it lies on no axis") {
  const Found clevis("clevis.off");
  const Mat3 turn = (Eigen::AngleAxisd(35 * kPi / 180, kY) * Eigen::AngleAxisd(20 * kPi / 180, kX))
                        .toRotationMatrix();
  CHECK(clevis.has_cylinder(Vec3::Zero(), turn * kX, 6));
  CHECK(clevis.has_cone(turn * Vec3(-26, 0, 0), 4, turn * Vec3(-24, 0, 0), 6));
  for (const double radius : {10.0, 4.0}) {
    CHECK(clevis.has_cylinder(turn * Vec3(26, 0, 0), turn * kY, radius));
  }
}

}  // namespace
}  // namespace hewn
