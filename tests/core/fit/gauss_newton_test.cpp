#include "core/fit/gauss_newton.h"

#include <vector>

#include <doctest/doctest.h>

#include "core/base/rng.h"

namespace hewn {
namespace {

constexpr SurfaceKind kAllKinds[] = {SurfaceKind::Plane, SurfaceKind::Sphere, SurfaceKind::Cylinder,
                                     SurfaceKind::Cone, SurfaceKind::Torus};

/// A surface of size one somewhere, with all values set.
Surface true_surface(SurfaceKind kind, const Vec3& shift) {
  Surface s;
  s.kind = kind;
  s.axis = Vec3(0.2, -0.5, 0.7).normalized();
  s.point = Vec3(0.3, 0.1, -0.4) + shift;
  s.offset = s.axis.dot(s.point);
  s.radius = 0.4;
  s.major_radius = 1.1;
  s.half_angle_rad = 0.5;
  return s;
}

/// Points of a third of the surface, moved by at most `noise` along the normal.
std::vector<Vec3> sample(const Surface& s, int count, double noise, Rng& rng) {
  const Tangents t = tangents(s.axis);
  std::vector<Vec3> points;
  for (int i = 0; i < count; ++i) {
    const double azimuth = rng.uniform(0, 2.2);
    const double v = rng.uniform(0.3, 1.3);
    const Vec3 e = t.u * std::cos(azimuth) + t.w * std::sin(azimuth);
    Vec3 p;
    switch (s.kind) {
      case SurfaceKind::Plane:
        p = s.point + t.u * azimuth + t.w * v;
        break;
      case SurfaceKind::Sphere:
        p = s.point + s.radius * (e * std::cos(v) + s.axis * std::sin(v));
        break;
      case SurfaceKind::Cylinder:
        p = s.point + s.radius * e + s.axis * v;
        break;
      case SurfaceKind::Cone:
        p = s.point + v * (s.axis + e * std::tan(s.half_angle_rad));
        break;
      case SurfaceKind::Torus:
        p = s.point + e * (s.major_radius + s.radius * std::cos(2 * v)) +
            s.axis * (s.radius * std::sin(2 * v));
        break;
    }
    const double shift = rng.uniform(-noise, noise);
    points.push_back(p + s.gradient(p) * shift);
  }
  return points;
}

Surface disturbed(Surface s, double amount, Rng& rng) {
  for (double& c : s.point) c += rng.uniform(-amount, amount);
  for (double& c : s.axis) c += rng.uniform(-amount, amount);
  s.axis.normalize();
  s.offset += rng.uniform(-amount, amount);
  s.radius += rng.uniform(-amount, amount);
  s.major_radius += rng.uniform(-amount, amount);
  s.half_angle_rad += rng.uniform(-amount, amount);
  return s;
}

/// Largest difference of the values that the kind has.
double difference(const Surface& a, const Surface& b) {
  double d = 0;
  const double sign = a.axis.dot(b.axis) < 0 ? -1 : 1;
  if (a.kind != SurfaceKind::Sphere) d = std::max(d, (a.axis - sign * b.axis).norm());
  if (a.kind == SurfaceKind::Plane) return std::max(d, std::abs(a.offset - sign * b.offset));
  const Vec3 apart = a.point - b.point;
  const bool slides = a.kind == SurfaceKind::Cylinder;
  d = std::max(d, slides ? Vec3(apart - b.axis * b.axis.dot(apart)).norm() : apart.norm());
  if (a.kind == SurfaceKind::Cone) {
    return std::max(d, std::abs(a.half_angle_rad - b.half_angle_rad));
  }
  d = std::max(d, std::abs(a.radius - b.radius));
  if (a.kind == SurfaceKind::Torus) d = std::max(d, std::abs(a.major_radius - b.major_radius));
  return d;
}

FitSettings exact() {
  FitSettings settings;
  settings.max_iterations = 50;
  settings.min_decrease = 1e-12;
  return settings;
}

TEST_CASE("a disturbed surface returns to exact points, near the origin and far from it") {
  Rng rng(1);
  for (const Vec3& shift : {Vec3(0, 0, 0), Vec3(100, -50, 70)}) {
    for (const SurfaceKind kind : kAllKinds) {
      for (int trial = 0; trial < 10; ++trial) {
        const Surface truth = true_surface(kind, shift);
        const std::vector<Vec3> points = sample(truth, 200, 0, rng);
        Surface s = disturbed(truth, 0.05, rng);
        CAPTURE(name_of(kind));
        REQUIRE(refine_surface(s, {points}, exact()));
        CHECK(difference(s, truth) < 1e-9);
      }
    }
  }
}

TEST_CASE("noisy points move a fit by no more than its stated deviation allows") {
  Rng rng(2);
  constexpr double kNoise = 1e-4;
  for (const SurfaceKind kind : kAllKinds) {
    const Surface truth = true_surface(kind, Vec3::Zero());
    for (int trial = 0; trial < 20; ++trial) {
      const std::vector<Vec3> points = sample(truth, 400, kNoise, rng);
      Surface s = disturbed(truth, 0.02, rng);
      CAPTURE(name_of(kind));
      REQUIRE(refine_surface(s, {points}, exact()));
      CHECK(rms_distance(s, points) <= kNoise);
      const FitDeviation d = fit_deviation(s, points, kNoise / std::sqrt(3.0), false);
      if (kind != SurfaceKind::Plane) CHECK((s.point - truth.point).norm() < 1);
      if (kind == SurfaceKind::Sphere || kind == SurfaceKind::Torus) {
        CHECK((s.point - truth.point).norm() <= 5 * d.position);
      }
      if (d.radius > 0) CHECK(std::abs(s.radius - truth.radius) <= 5 * d.radius);
      if (d.half_angle_rad > 0) {
        CHECK(std::abs(s.half_angle_rad - truth.half_angle_rad) <= 5 * d.half_angle_rad);
      }
      if (d.axis_rad > 0) CHECK(angle_between(s.axis, truth.axis) <= 5 * d.axis_rad);
    }
  }
}

TEST_CASE("normals alone pull a fit that the points leave open") {
  Rng rng(3);
  for (const SurfaceKind kind : kAllKinds) {
    const Surface truth = true_surface(kind, Vec3::Zero());
    const std::vector<Vec3> points = sample(truth, 60, 0, rng);
    std::vector<Vec3> normals;
    for (const Vec3& p : points) normals.push_back(truth.gradient(p));
    Surface s = disturbed(truth, 0.05, rng);
    FitSettings settings = exact();
    settings.normal_weight = 0.5;
    CAPTURE(name_of(kind));
    REQUIRE(refine_surface(s, {points, normals, points}, settings));
    CHECK(difference(s, truth) < 1e-8);
  }
}

TEST_CASE("a kept axis stays bit-identical") {
  Rng rng(4);
  for (const SurfaceKind kind : kAllKinds) {
    const Surface truth = true_surface(kind, Vec3::Zero());
    const std::vector<Vec3> points = sample(truth, 100, 1e-5, rng);
    Surface s = disturbed(truth, 0.02, rng);
    s.axis = truth.axis;
    FitSettings settings = exact();
    settings.keep_axis = true;
    CAPTURE(name_of(kind));
    REQUIRE(refine_surface(s, {points}, settings));
    CHECK((s.axis.array() == truth.axis.array()).all());
    CHECK(difference(s, truth) < 1e-4);
  }
}

TEST_CASE("robust fits ignore outliers") {
  Rng rng(5);
  const Surface truth = true_surface(SurfaceKind::Cylinder, Vec3::Zero());
  std::vector<Vec3> points = sample(truth, 200, 0, rng);
  for (int i = 0; i < 20; ++i) points[10 * i] += 0.05 * truth.gradient(points[10 * i]);
  Surface robust = truth;
  FitSettings settings = exact();
  settings.robust_scale = 1e-6;
  REQUIRE(refine_surface(robust, {points}, settings));
  CHECK(difference(robust, truth) < 1e-5);
}

TEST_CASE("many fits have the outcomes that they have one by one") {
  Rng rng(6);
  std::vector<std::vector<Vec3>> points;
  std::vector<FitTask> tasks;
  for (int i = 0; i < 40; ++i) {
    const Surface truth = true_surface(kAllKinds[i % 5], Vec3(i, 0, -i));
    // Every seventh fit has too few points.
    points.push_back(sample(truth, i % 7 == 6 ? 2 : 50 + i, 1e-4, rng));
    tasks.push_back({disturbed(truth, 0.05, rng), {}});
  }
  for (std::size_t i = 0; i < tasks.size(); ++i) tasks[i].data.points = points[i];
  std::vector<Surface> alone;
  std::vector<bool> is_fitted;
  for (const FitTask& task : tasks) {
    alone.push_back(task.surface);
    is_fitted.push_back(refine_surface(alone.back(), task.data));
  }
  REQUIRE(refine_surfaces(tasks, {}).has_value());
  for (std::size_t i = 0; i < tasks.size(); ++i) {
    CAPTURE(i);
    CHECK(tasks[i].is_fitted == is_fitted[i]);
    CHECK(difference(tasks[i].surface, alone[i]) == 0);
  }
  CHECK(refine_surfaces({}, {}).has_value());
}

TEST_CASE("points that do not determine a surface are refused and leave it alone") {
  const Surface truth = true_surface(SurfaceKind::Torus, Vec3::Zero());
  Surface s = truth;
  const std::vector<Vec3> few = {Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0)};
  CHECK_FALSE(refine_surface(s, {few}));
  CHECK(difference(s, truth) == 0);
  const std::vector<Vec3> one(20, Vec3(1, 2, 3));
  CHECK_FALSE(refine_surface(s, {one}));
  CHECK_FALSE(refine_surface(s, {}));
}

}  // namespace
}  // namespace hewn
