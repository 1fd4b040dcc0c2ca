/// Gauss-Newton fits in batches against the same fits alone, on every device.
#include "core/compute/fit_batch.h"

#include <cstring>

#include <doctest/doctest.h>

#include "core/compute/compute.h"
#include "tests/gpu/failing_device.h"
#include "tests/gpu/test_device.h"

namespace hewn {
namespace {

using testing::device_under_test;

constexpr double kNoise = 1e-3;

struct Fit {
  FitTarget target;
  SurfaceForm truth, guess;
  std::vector<PlainVec> points, normals;

  FitRows rows() const { return {points, normals}; }
};

template <SurfaceKind K>
PlainVec normal_of(const SurfaceForm& s, const PlainVec& x) {
  const RowFrame frame = row_frame(s);
  return normal_at<K>(frame, localise(frame, x));
}
PlainVec normal_of(const SurfaceForm& s, const PlainVec& x) {
  switch (s.kind) {
    case SurfaceKind::Plane:
      return normal_of<SurfaceKind::Plane>(s, x);
    case SurfaceKind::Sphere:
      return normal_of<SurfaceKind::Sphere>(s, x);
    case SurfaceKind::Cylinder:
      return normal_of<SurfaceKind::Cylinder>(s, x);
    case SurfaceKind::Cone:
      return normal_of<SurfaceKind::Cone>(s, x);
    case SurfaceKind::Torus:
      return normal_of<SurfaceKind::Torus>(s, x);
  }
  return {};
}

double distance_from(const SurfaceForm& s, const PlainVec& p) {
  return signed_distance(s, p.x, p.y, p.z);
}

/// A surface through the unit cube, points next to it with some normals, and a guess near it.
Fit random_fit(std::size_t points, Rng& rng) {
  Fit fit;
  fit.truth = testing::random_surface(rng);
  if (fit.truth.kind == SurfaceKind::Torus) fit.truth.second = fit.truth.first + 0.5;
  while (fit.points.size() < points) {
    const Vec3 start = testing::random_points(1, rng)[0] / 2;
    PlainVec p{start.x(), start.y(), start.z()};
    p = p - normal_of(fit.truth, p) * (distance_from(fit.truth, p) + rng.uniform(-kNoise, kNoise));
    if (std::abs(distance_from(fit.truth, p)) > 1.01 * kNoise) continue;  // beyond an apex
    fit.points.push_back(p);
  }
  const std::size_t normals = rng.below(2) == 0 ? 0 : points / 3;
  for (std::size_t i = 0; i < normals; ++i) {
    const PlainVec p = fit.points[3 * i];
    fit.points.push_back(p);
    fit.normals.push_back(normal_of(fit.truth, p) * (rng.below(2) == 0 ? 1.0 : -1.0));
  }
  fit.guess = fit.truth;
  fit.guess.first += rng.uniform(-0.05, 0.05);
  for (double& c : fit.guess.point) c += rng.uniform(-0.05, 0.05);
  if (fit.guess.kind == SurfaceKind::Cone) {
    const double l = std::hypot(fit.guess.first, fit.guess.second);
    fit.guess.first /= l;
    fit.guess.second /= l;
  }
  fit.target.kind = fit.truth.kind;
  fit.target.max_iterations = 1 + static_cast<int>(rng.below(15));
  fit.target.robust_scale = rng.below(2) == 0 ? 0 : 5e-4;
  fit.target.normal_weight2 = 0.01;
  fit.target.keeps_axis = rng.below(3) == 0;
  return fit;
}

std::vector<Fit> random_fits(std::size_t count, Rng& rng) {
  std::vector<Fit> fits;
  for (std::size_t i = 0; i < count; ++i) {
    fits.push_back(random_fit(std::size_t{1} << (3 + i % 7), rng));
  }
  return fits;
}

FitBatch batch_of(const std::vector<Fit>& fits) {
  FitBatch batch;
  for (const Fit& fit : fits) batch.add(fit.target, fit.guess, fit.rows());
  return batch;
}

bool are_same(const SurfaceForm& a, const SurfaceForm& b) {
  return a.kind == b.kind && std::memcmp(a.point, b.point, sizeof(a.point)) == 0 &&
         std::memcmp(a.axis, b.axis, sizeof(a.axis)) == 0 && a.first == b.first &&
         a.second == b.second;
}

void check_same_as_alone(const std::vector<Fit>& fits, const FitBatch& batch) {
  for (std::size_t i = 0; i < fits.size(); ++i) {
    CAPTURE(i);
    CHECK(are_same(batch.surface(i), fit_alone(fits[i].target, fits[i].guess, fits[i].rows())));
  }
}

TEST_CASE("a fit in a batch has the outcome, to the bit, that it has alone") {
  const auto device = device_under_test();
  if (!device) return;
  Rng rng(61);
  const std::vector<Fit> fits = random_fits(200, rng);
  FitBatch batch = batch_of(fits);
  REQUIRE(batch.solve(*device, {}).has_value());
  check_same_as_alone(fits, batch);
}

TEST_CASE("fits have the same bits with every instruction set") {
  Rng rng(66);
  const std::vector<Fit> fits = random_fits(100, rng);
  for (const BitPath path : {BitPath::Portable, BitPath::Avx2, BitPath::Avx512}) {
    if (bit_kernels(path) == nullptr) continue;
    CpuDevice device(1, CpuDevice::kMemoryBudget, path);
    FitBatch batch = batch_of(fits);
    REQUIRE(batch.solve(device, {}).has_value());
    check_same_as_alone(fits, batch);
  }
}

TEST_CASE("a fit is nearer to the points than the noise that moved them") {
  const auto device = device_under_test();
  if (!device) return;
  Rng rng(62);
  std::vector<Fit> fits;
  for (int i = 0; i < 50; ++i) {
    fits.push_back(random_fit(2000, rng));
    fits.back().target.max_iterations = 30;
    fits.back().target.keeps_axis = false;
  }
  FitBatch batch = batch_of(fits);
  REQUIRE(batch.solve(*device, {}).has_value());
  for (std::size_t i = 0; i < fits.size(); ++i) {
    double sum = 0;
    for (const PlainVec& p : fits[i].points) {
      const double d = distance_from(batch.surface(i), p);
      sum += d * d;
    }
    CAPTURE(i);
    CHECK(std::sqrt(sum / static_cast<double>(fits[i].points.size())) < kNoise);
  }
}

TEST_CASE("fits that do not fit into the memory together take turns") {
  Rng rng(63);
  const std::vector<Fit> fits = random_fits(40, rng);
  CpuDevice small(1, 20'000);
  FitBatch batch = batch_of(fits);
  REQUIRE(batch.solve(small, {}).has_value());
  check_same_as_alone(fits, batch);
}

TEST_CASE("no fits are done at once, and data that determine nothing leave the guess") {
  const auto device = device_under_test();
  if (!device) return;
  FitBatch none;
  CHECK(none.solve(*device, {}).has_value());
  const std::vector<PlainVec> one_place(20, PlainVec{0.5, 0, 0});
  FitTarget target;
  target.kind = SurfaceKind::Cylinder;
  SurfaceForm guess;
  guess.kind = SurfaceKind::Cylinder;
  guess.first = 0.5;
  FitBatch batch;
  batch.add(target, guess, {one_place});
  REQUIRE(batch.solve(*device, {}).has_value());
  CHECK(are_same(batch.surface(0), guess));
}

TEST_CASE("a device lost at any call leaves the same fits") {
  Rng rng(64);
  const std::vector<Fit> fits = random_fits(10, rng);
  testing::lose_at_every_call([&](Compute& compute, const RunContext& run) {
    FitBatch batch = batch_of(fits);
    REQUIRE(compute.run(1, run, [&](Device& d) { return batch.solve(d, run); }).has_value());
    check_same_as_alone(fits, batch);
  });
}

TEST_CASE("a cancelled batch says so") {
  Rng rng(65);
  CpuDevice device(1);
  RunContext run;
  run.cancel->cancel();
  FitBatch batch = batch_of(random_fits(3, rng));
  const auto done = batch.solve(device, run);
  REQUIRE_FALSE(done.has_value());
  CHECK(done.error().code == ErrorCode::Cancelled);
}

}  // namespace
}  // namespace hewn
