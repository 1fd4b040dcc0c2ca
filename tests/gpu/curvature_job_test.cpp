/// Curvature on every device, bit by bit against the plainest one. What the values should be is
/// tested with the segmentation that uses them.
#include "core/compute/curvature_job.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <map>
#include <utility>

#include <doctest/doctest.h>

#include "tests/gpu/test_device.h"

namespace hewn {
namespace {

using testing::device_under_test;
using testing::plain_device;

/// Vertices and triangles with all that `MeshArrays` wants.
struct TestMesh {
  TestMesh(std::vector<Vec3> v, std::vector<std::array<int, 3>> t)
      : vertices(std::move(v)), triangles(std::move(t)), first_corner(vertices.size() + 1, 0) {
    std::map<std::pair<int, int>, int> side_of;
    for (int i = 0; i < static_cast<int>(triangles.size()); ++i) {
      const auto& [a, b, c] = triangles[static_cast<std::size_t>(i)];
      const Vec3 cross = (at(b) - at(a)).cross(at(c) - at(a));
      areas.push_back(cross.norm() / 2);
      normals.push_back(cross.norm() > 0 ? Vec3(cross.normalized()) : Vec3::Zero());
      side_of[{a, b}] = side_of[{b, c}] = side_of[{c, a}] = i;
      for (const int vertex : {a, b, c}) ++first_corner[static_cast<std::size_t>(vertex) + 1];
    }
    for (std::size_t i = 1; i < first_corner.size(); ++i) first_corner[i] += first_corner[i - 1];
    corners.resize(triangles.size() * 3);
    std::vector<int> next(first_corner.begin(), first_corner.end() - 1);
    for (std::size_t i = 0; i < triangles.size(); ++i) {
      std::array<int, 3> across{};
      for (std::size_t k = 0; k < 3; ++k) {
        const auto found = side_of.find({triangles[i][(k + 1) % 3], triangles[i][k]});
        across[k] = found == side_of.end() ? -1 : found->second;
        auto& place = next[static_cast<std::size_t>(triangles[i][k])];
        corners[static_cast<std::size_t>(place++)] = static_cast<int>(3 * i + k);
      }
      neighbors.push_back(across);
    }
  }
  const Vec3& at(int vertex) const { return vertices[static_cast<std::size_t>(vertex)]; }
  MeshArrays arrays() const {
    return {vertices, triangles, normals, areas, neighbors, corners, first_corner};
  }

  std::vector<Vec3> vertices, normals;
  std::vector<std::array<int, 3>> triangles, neighbors;
  std::vector<double> areas;
  std::vector<int> corners, first_corner;
};

/// A torus whose vertices are a little off: all classes, nothing exact.
TestMesh rough_torus(int around, int along) {
  Rng rng(31);
  std::vector<Vec3> vertices;
  std::vector<std::array<int, 3>> triangles;
  constexpr double kTurn = 2 * kPi;
  for (int i = 0; i < around; ++i) {
    for (int k = 0; k < along; ++k) {
      const double u = kTurn * i / around;
      const double w = kTurn * k / along;
      const double r = 3 + std::cos(w) + rng.uniform(-0.01, 0.01);
      vertices.emplace_back(r * std::cos(u), r * std::sin(u), std::sin(w));
      const int a = i * along + k;
      const int b = (i + 1) % around * along + k;
      const int c = (i + 1) % around * along + (k + 1) % along;
      const int d = i * along + (k + 1) % along;
      triangles.push_back({a, b, c});
      triangles.push_back({a, c, d});
    }
  }
  return {std::move(vertices), std::move(triangles)};
}

/// Many triangles around one vertex, with every third side folded sharply, and an open rim.
TestMesh pleated_disc(int triangles_around) {
  std::vector<Vec3> vertices{Vec3::Zero()};
  std::vector<std::array<int, 3>> triangles;
  for (int i = 0; i < triangles_around; ++i) {
    const double angle = 2 * kPi * i / triangles_around;
    vertices.emplace_back(std::cos(angle), std::sin(angle), i % 3 == 0 ? 0.3 : 0);
    triangles.push_back({0, 1 + i, 1 + (i + 1) % triangles_around});
  }
  // One without area.
  triangles.push_back({1, 2, 2});
  return {std::move(vertices), std::move(triangles)};
}

CurvatureJobOptions usual(bool by_angle) {
  return {0.44, 0.7, 1.05, by_angle, {0.01, 0.3, 0.3, 1.5}};
}

/// All that a job finds, as bytes.
std::vector<char> found_on(Device& device, const TestMesh& mesh, bool by_angle) {
  const RunContext run;
  CurvatureJob job(device, mesh.arrays(), usual(by_angle), run);
  std::vector<char> bytes;
  const auto append = [&bytes](const auto& values) {
    const auto* begin = reinterpret_cast<const char*>(values.data());
    bytes.insert(bytes.end(), begin, begin + values.size() * sizeof(values[0]));
  };
  append(job.vertex_classes());
  std::vector<std::array<bool, 3>> is_marked(mesh.triangles.size());
  job.take_marks({is_marked[0].data(), is_marked.size() * 3});
  append(is_marked);
  append(job.vertex_marks());
  append(job.normals());
  append(job.sectors());
  append(job.curvatures());
  append(job.classes());
  append(job.regions());
  REQUIRE(job.result().has_value());
  return bytes;
}

TEST_CASE("curvature, its classes and regions are the same to the bit") {
  const auto device = device_under_test();
  if (!device) return;
  auto plain = plain_device();
  const testing::SamplePart part = testing::read_sample_part();
  const TestMesh meshes[] = {
      {part.vertices, part.triangles}, rough_torus(200, 100), pleated_disc(3000)};
  for (const TestMesh& mesh : meshes) {
    for (const bool by_angle : {false, true}) {
      CHECK(found_on(*device, mesh, by_angle) == found_on(plain, mesh, by_angle));
    }
  }
}

TEST_CASE("every instruction set finds the same curvature") {
  const TestMesh mesh = rough_torus(60, 40);
  auto plain = plain_device();
  const std::vector<char> expected = found_on(plain, mesh, true);
  for (const BitPath path : {BitPath::Avx2, BitPath::Avx512}) {
    if (bit_kernels(path) == nullptr) continue;
    CpuDevice device(2, CpuDevice::kMemoryBudget, path);
    CHECK(found_on(device, mesh, true) == expected);
  }
}

TEST_CASE("sectors and regions are named by their lowest member") {
  const auto device = device_under_test();
  if (!device) return;
  const TestMesh mesh = pleated_disc(300);
  const RunContext run;
  CurvatureJob job(*device, mesh.arrays(), usual(false), run);
  const std::vector<int> sectors = job.sectors();
  const std::vector<int> regions = job.regions();
  REQUIRE(job.result().has_value());
  for (int c = 0; c < static_cast<int>(sectors.size()); ++c) {
    const int sector = sectors[static_cast<std::size_t>(c)];
    CHECK(sector <= c);
    CHECK(sectors[static_cast<std::size_t>(sector)] == sector);
  }
  for (int t = 0; t + 1 < static_cast<int>(regions.size()); ++t) {
    const int region = regions[static_cast<std::size_t>(t)];
    CHECK(region <= t);
    CHECK(regions[static_cast<std::size_t>(region)] == region);
  }
  CHECK(regions.back() == -1);
}

TEST_CASE("angles agree with the library's arc tangent") {
  Rng rng(32);
  double worst = 0;
  for (int i = 0; i < 100'000; ++i) {
    const double x = rng.uniform(-1, 1) * std::pow(10, rng.uniform(-8, 8));
    const double y = rng.uniform(0, 1) * std::pow(10, rng.uniform(-8, 8));
    worst = std::max(worst, std::abs(angle_of(x, y) - std::atan2(y, x)));
  }
  CHECK(worst < 2e-15);
  CHECK(angle_of(1, 0) == 0);
  CHECK(angle_of(-1, 0) == doctest::Approx(kPi));
  CHECK(angle_of(0, 2) == doctest::Approx(kPi / 2));
}

TEST_CASE("a cancelled job says so") {
  const auto device = device_under_test();
  if (!device) return;
  const TestMesh mesh = rough_torus(20, 10);
  RunContext run;
  run.cancel->cancel();
  CurvatureJob job(*device, mesh.arrays(), usual(false), run);
  REQUIRE_FALSE(job.result().has_value());
  CHECK(job.result().error().code == ErrorCode::Cancelled);
}

}  // namespace
}  // namespace hewn
