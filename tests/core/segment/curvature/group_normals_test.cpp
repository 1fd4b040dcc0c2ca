#include <doctest/doctest.h>

#include "tests/core/segment/curvature/stages.h"
#include "tests/support/solids.h"

namespace hewn {
namespace {

TEST_CASE("at a box's edges each side keeps its own normal") {
  const Mesh mesh = solids::box({0, 0, 0}, {1, 2, 3}, 3);
  const CurvatureStages s = run_stages(mesh);
  for (std::size_t corner = 0; corner < mesh.triangles.size() * 3; ++corner) {
    const Vec3 difference = s.normals.normal_of_corner[corner] - mesh.normals[corner / 3];
    CHECK(difference.norm() < 1e-15);
  }
}

TEST_CASE("normals on a cylinder's rim are radial on the flank and axial on the cap") {
  const Mesh mesh = solids::cylinder(1, 2, 36, 3);
  CurvatureOptions options;
  options.normal_weights = static_cast<int>(NormalWeights::Angle);
  const CurvatureStages s = run_stages(mesh, options);
  for (int corner = 0; corner < static_cast<int>(mesh.triangles.size()) * 3; ++corner) {
    const Vec3 p = mesh.corner(corner / 3, corner % 3);
    const Vec3& n = s.normals.normal_of_corner[corner];
    if (std::abs(mesh.normals[corner / 3].z()) > 0.5) {
      CHECK(std::abs(n.z()) == doctest::Approx(1));
    } else {
      CHECK((n - Vec3(p.x(), p.y(), 0).normalized()).norm() < 1e-12);
    }
  }
}

TEST_CASE("a sector is named by its own lowest corner") {
  const Mesh mesh = solids::plate_with_hole({3, 3, 1}, 1, 24);
  const CurvatureStages s = run_stages(mesh);
  for (int corner = 0; corner < static_cast<int>(mesh.triangles.size()) * 3; ++corner) {
    const int sector = s.normals.sector_of_corner[corner];
    CHECK(sector <= corner);
    CHECK(s.normals.sector_of_corner[sector] == sector);
    CHECK(mesh.triangles[sector / 3][sector % 3] == mesh.triangles[corner / 3][corner % 3]);
  }
}

}  // namespace
}  // namespace hewn
