#include "core/fit/initial_guess.h"

#include <algorithm>

#include <doctest/doctest.h>

namespace hewn {
namespace {

/// A patch of a surface of revolution about z: points with their exact normals.
struct Samples {
  std::vector<Vec3> points, normals;
};

Samples sample(const Surface& s) {
  Samples out;
  for (int i = 0; i < 6; ++i) {
    for (int j = 0; j < 5; ++j) {
      const double a = 0.2 * i;
      const double b = 0.3 + 0.2 * j;
      const Vec3 e(std::cos(a), std::sin(a), 0);
      Vec3 p = s.point;
      if (s.kind == SurfaceKind::Cylinder) p += s.radius * e + Vec3(0, 0, b);
      if (s.kind == SurfaceKind::Sphere)
        p += s.radius * (std::cos(b) * e + Vec3(0, 0, std::sin(b)));
      if (s.kind == SurfaceKind::Cone) p += b * (std::tan(s.half_angle_rad) * e + Vec3(0, 0, 1));
      if (s.kind == SurfaceKind::Torus) {
        p += (s.major_radius + s.radius * std::cos(b)) * e + Vec3(0, 0, s.radius * std::sin(b));
      }
      out.points.push_back(p);
      out.normals.push_back(s.gradient(p));
    }
  }
  return out;
}

TEST_CASE("exact patches give a guess of their own kind close to the truth") {
  for (const SurfaceKind kind :
       {SurfaceKind::Cylinder, SurfaceKind::Sphere, SurfaceKind::Cone, SurfaceKind::Torus}) {
    Surface truth;
    truth.kind = kind;
    truth.point = Vec3(0.3, -0.2, 0.5);
    truth.radius = 0.4;
    truth.major_radius = 1.2;
    truth.half_angle_rad = 0.5;
    const Samples s = sample(truth);
    const auto guesses = guess_surfaces({s.points, s.normals, s.points}, 3);
    double best = 1;
    for (const Surface& g : guesses) {
      if (g.kind != kind) continue;
      double worst = 0;
      for (const Vec3& p : s.points) worst = std::max(worst, std::abs(g.signed_distance(p)));
      best = std::min(best, worst);
    }
    CAPTURE(name_of(kind));
    CHECK(best < 1e-6);
  }
}

TEST_CASE("too little data gives no guess") {
  const std::vector<Vec3> two = {Vec3(0, 0, 0), Vec3(1, 0, 0)};
  CHECK(guess_surfaces({two, two, two}, 1).empty());
  const std::vector<Vec3> one_place(10, Vec3(1, 2, 3));
  CHECK(guess_surfaces({one_place, one_place, one_place}, 1).empty());
}

}  // namespace
}  // namespace hewn
