#include "core/mesh/query.h"

#include <algorithm>
#include <atomic>
#include <functional>

#include <doctest/doctest.h>

#include "core/compute/parallel.h"
#include "core/mesh/closest_on_triangle.h"
#include "core/mesh/sampling.h"
#include "tests/gpu/failing_device.h"
#include "tests/support/solids.h"

namespace hewn {
namespace {

MeshQuery query_of(Mesh mesh) { return MeshQuery(std::make_shared<const Mesh>(std::move(mesh))); }

/// Checks points pushed off the surface by `offset` diagonals on both sides. Faces are planar, so
/// the answer is known wherever no other face is near.
void check_sides(const Mesh& mesh, double offset, int count) {
  const MeshQuery query = query_of(mesh);
  const SurfaceSampler sampler(mesh);
  const double step = offset * mesh.diagonal();
  Rng rng(11);
  int tested = 0;
  for (int i = 0; i < count; ++i) {
    const SurfacePoint s = sampler.draw(rng);
    for (const double side : {-1.0, 1.0}) {
      const Vec3 p = s.position + side * step * s.normal;
      // Beside a concave edge the step may run through another face.
      if (query.closest(p).distance < 0.999 * step) continue;
      ++tested;
      CHECK(query.contains(p) == (side < 0));
    }
  }
  CHECK(tested > count);
}

TEST_CASE("points 1e-4 and 1e-6 of the diagonal off the surface fall on the right side") {
  const Affine3 oblique = solids::oblique_transform();
  for (const double offset : {1e-4, 1e-5, 1e-6}) {
    check_sides(solids::plate_with_hole({4, 4, 1}, 1, 64, 4), offset, 3000);
    check_sides(solids::transformed(solids::torus(2, 0.5, 64, 32), oblique), offset, 3000);
    check_sides(solids::block_with_fillet({3, 2, 1}, 0.4, 12), offset, 3000);
  }
}

TEST_CASE("rays along edges and through vertices do not confuse the inside test") {
  const MeshQuery box = query_of(solids::box({-1, -1, -1}, {1, 1, 1}, 8));
  // Grid points lie on the planes of the mesh's own edges; diagonals run through its vertices.
  for (int i = -7; i <= 7; ++i) {
    for (int j = -7; j <= 7; ++j) {
      for (int k = -7; k <= 7; ++k) {
        const Vec3 p = Vec3(i, j, k) / 6.0;
        const double reach = p.cwiseAbs().maxCoeff();
        if (std::abs(reach - 1) > 1e-9) CHECK(box.contains(p) == (reach < 1));
      }
    }
  }
}

TEST_CASE("a ray aimed straight at a vertex of the mesh finds its way to the right answer") {
  const Mesh sphere = solids::sphere(1, 32, 16);
  const MeshQuery query = query_of(sphere);
  const Vec3 first = Vec3(0.5773991, 0.3317541, 0.7460673).normalized();
  for (const Vec3& v : sphere.vertices) {
    for (const double back : {0.01, 0.3, 1.2, 2.5}) {
      const Vec3 p = v - back * first;
      const double r = p.norm();
      if (r < 0.97) CHECK(query.contains(p));
      if (r > 1.0001) CHECK(!query.contains(p));
    }
  }
}

TEST_CASE("scale and place of a part do not change the answers") {
  const Mesh mesh = solids::plate_with_hole({4, 4, 1}, 1, 48, 2);
  const MeshQuery reference = query_of(mesh);
  for (const double scale : {1e-6, 1e-3, 1e3, 1e9}) {
    Affine3 move = Affine3::Identity();
    move.translate(100 * scale * mesh.diagonal() * Vec3(1, -1, 1)).scale(scale);
    const MeshQuery moved = query_of(solids::transformed(mesh, move));
    Rng rng(4);
    for (int i = 0; i < 2000; ++i) {
      const Vec3 p = sample_box(mesh.bounds, rng);
      const double distance = reference.closest(p).distance;
      if (distance < 1e-6) continue;
      CHECK(moved.contains(move * p) == reference.contains(p));
      CHECK(moved.closest(move * p).distance / scale == doctest::Approx(distance).epsilon(1e-6));
    }
  }
}

TEST_CASE("the closest point is the one that brute force finds") {
  for (const Mesh& mesh : {solids::torus(2, 0.5, 24, 12), solids::cone(1, 0, 2, 24),
                           solids::plate_with_hole({4, 4, 1}, 1, 32)}) {
    const MeshQuery query = query_of(mesh);
    Box3 box = mesh.bounds;
    box.extend(mesh.bounds.hi + Vec3::Constant(2));
    box.extend(mesh.bounds.lo - Vec3::Constant(2));
    Rng rng(6);
    for (int i = 0; i < 1000; ++i) {
      const Vec3 p = sample_box(box, rng);
      double best = kInfinity;
      for (int t = 0; t < static_cast<int>(mesh.triangles.size()); ++t) {
        const Vec3 c =
            closest_on_triangle(p, mesh.corner(t, 0), mesh.corner(t, 1), mesh.corner(t, 2));
        best = std::min(best, (c - p).norm());
      }
      const ClosestPoint found = query.closest(p);
      CHECK(found.distance == doctest::Approx(best).epsilon(1e-12));
      CHECK((found.point - p).norm() == doctest::Approx(best).epsilon(1e-9));
    }
  }
}

TEST_CASE("of two equally near triangles the lower one is given") {
  const Mesh box = solids::box({-1, -1, -1}, {1, 1, 1});
  const MeshQuery query = query_of(box);
  const ClosestPoint corner = query.closest({2, 2, 2});
  int lowest = -1;
  for (int t = 11; t >= 0; --t) {
    for (int k = 0; k < 3; ++k) {
      if (box.corner(t, k) == Vec3(1, 1, 1)) lowest = t;
    }
  }
  CHECK(corner.triangle == lowest);
  CHECK(corner.distance == doctest::Approx(std::sqrt(3.0)));
}

TEST_CASE("a cast ray hits where the plane is, in lengths of the direction") {
  const MeshQuery box = query_of(solids::box({0, 0, 0}, {1, 1, 1}));
  const RayHit hit = box.cast({0.3, 0.4, 3}, {0, 0, -0.5});
  CHECK(hit.t == doctest::Approx(4).epsilon(1e-12));
  CHECK(box.mesh().normals[hit.triangle].z() == 1);
  CHECK(box.cast({0.3, 0.4, 3}, {0, 0, 1}).triangle == -1);
  CHECK(box.cast({0.3, 0.4, 3}, {0, 0, 0}).triangle == -1);
}

TEST_CASE("the signed distance of a sphere is its radius short of the point") {
  const MeshQuery sphere = query_of(solids::sphere(1, 128, 64));
  CHECK(sphere.signed_distance({0, 0, 0.25}) == doctest::Approx(-0.75).epsilon(2e-3));
  CHECK(sphere.signed_distance({0, 2, 0}) == doctest::Approx(1).epsilon(2e-3));
}

TEST_CASE("an open mesh is decided by the majority of rays") {
  Mesh box = solids::box({-1, -1, -1}, {1, 1, 1});
  std::erase_if(box.triangles, [&](const Triangle& t) {
    return std::all_of(t.begin(), t.end(), [&](int i) { return box.vertices[i].z() > 0; });
  });
  const MeshQuery query = query_of(make_mesh(box.vertices, box.triangles));
  CHECK(query.contains({0.1, 0.2, -0.5}));
  CHECK(query.contains({-0.6, 0.6, -0.9}));
  CHECK(!query.contains({0, 0, 1.5}));
}

TEST_CASE("many threads get the answers that one gets") {
  const Mesh mesh = solids::torus(2, 0.5, 64, 32);
  const MeshQuery query = query_of(mesh);
  std::vector<Vec3> points;
  Rng rng(8);
  for (int i = 0; i < 20000; ++i) points.push_back(sample_box(mesh.bounds, rng));
  std::vector<char> alone(points.size());
  std::vector<char> together(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) alone[i] = query.contains(points[i]) ? 1 : 0;
  for_each_index(
      8, points.size(), [&](std::size_t i) { together[i] = query.contains(points[i]) ? 1 : 0; },
      64);
  CHECK(alone == together);
  CHECK(std::count(alone.begin(), alone.end(), 1) > 1000);
}

TEST_CASE("a device tells of many points what the processor tells, and may be lost") {
  const Mesh mesh = solids::torus(2, 0.5, 32, 16);
  const MeshQuery query = query_of(mesh);
  std::vector<Vec3> points{mesh.vertices[0], mesh.vertices[7]};
  Rng rng(9);
  for (int i = 0; i < 9000; ++i) points.push_back(sample_box(mesh.bounds, rng));
  const std::vector<char> expected = query.contains(points, {});
  for (std::size_t i = 0; i < points.size(); ++i) {
    REQUIRE((expected[i] != 0) == query.contains(points[i]));
  }
  for (const int good_calls : {1000, 3}) {
    testing::FailingDevice* device = nullptr;
    RunContext run;
    run.compute = std::make_shared<Compute>(1, DeviceChoice{DeviceChoice::Kind::Cuda, 0},
                                            testing::opens(device, good_calls, testing::kLost));
    CHECK(query.contains(points, run) == expected);
    CHECK(run.compute->accelerated_jobs() == (good_calls > 100 ? 1 : 0));
  }
}

TEST_CASE("an empty mesh contains nothing") {
  const MeshQuery query = query_of(Mesh());
  CHECK(!query.contains({0, 0, 0}));
  CHECK(query.closest({0, 0, 0}).triangle == -1);
  CHECK(query.cast({0, 0, 0}, {1, 0, 0}).triangle == -1);
}

}  // namespace
}  // namespace hewn
