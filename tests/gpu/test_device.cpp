#include "tests/gpu/test_device.h"

#include <cstdlib>
#include <fstream>
#include <string>

#include <doctest/doctest.h>

#include "gpu/cuda_device.h"

namespace hewn::testing {

std::unique_ptr<Device> device_under_test() {
  const char* wanted = std::getenv("HEWN_TEST_DEVICE");
  if (wanted == nullptr || std::string(wanted) != "cuda") return std::make_unique<CpuDevice>(2);
  auto opened = open_cuda_device(0);
  if (opened) return std::move(*opened);
  MESSAGE("SKIPPED: " << opened.error().message);
  return nullptr;
}

SurfaceForm random_surface(Rng& rng) {
  SurfaceForm s;
  s.kind = static_cast<SurfaceKind>(rng.below(5));
  Vec3 axis;
  for (int c = 0; c < 3; ++c) {
    s.point[c] = rng.uniform(-1, 1);
    axis[c] = rng.uniform(-1, 1);
  }
  axis.normalize();
  for (int c = 0; c < 3; ++c) s.axis[c] = axis[c];
  s.first = rng.uniform(0.1, 0.8);
  s.second =
      s.kind == SurfaceKind::Torus ? rng.uniform(0.2, 1.2) : std::sqrt(1 - s.first * s.first);
  return s;
}

std::vector<SurfaceForm> random_surfaces(std::size_t count, Rng& rng) {
  std::vector<SurfaceForm> surfaces;
  for (std::size_t k = 0; k < count; ++k) surfaces.push_back(random_surface(rng));
  return surfaces;
}

std::vector<Vec3> random_points(std::size_t count, Rng& rng) {
  std::vector<Vec3> points(count);
  for (Vec3& p : points) {
    for (double& c : p) c = rng.uniform(-2, 2);
  }
  return points;
}

SamplePart read_sample_part() {
  std::ifstream file(std::string(HEWN_ASSETS) + "/bracket.off");
  std::string format;
  std::size_t vertices = 0;
  std::size_t triangles = 0;
  std::size_t edges = 0;
  file >> format >> vertices >> triangles >> edges;
  SamplePart part;
  part.vertices.resize(vertices);
  for (Vec3& v : part.vertices) file >> v.x() >> v.y() >> v.z();
  for (std::size_t t = 0; t < triangles; ++t) {
    std::size_t sides = 0;
    std::size_t corner[3] = {0, 0, 0};
    file >> sides >> corner[0] >> corner[1] >> corner[2];
    part.triangles.push_back(
        {static_cast<int>(corner[0]), static_cast<int>(corner[1]), static_cast<int>(corner[2])});
    const Vec3& a = part.vertices.at(corner[0]);
    const Vec3 normal =
        (part.vertices.at(corner[1]) - a).cross(part.vertices.at(corner[2]) - a).normalized();
    part.planes.push_back(
        {SurfaceKind::Plane, {}, {normal.x(), normal.y(), normal.z()}, normal.dot(a), 0});
  }
  REQUIRE(file.good());
  REQUIRE(part.planes.size() > 100);
  return part;
}

}  // namespace hewn::testing
