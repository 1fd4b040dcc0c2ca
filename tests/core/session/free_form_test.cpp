#include "core/session/free_form.h"

#include <cmath>

#include <doctest/doctest.h>

#include "core/segment/segment.h"
#include "core/session/score.h"

namespace hewn {
namespace {

/// Waves of many directions, which no primitive follows; nothing at the rim.
double waves(double x, double y) {
  if (std::max(std::abs(x), std::abs(y)) >= 8) return 0;
  return 2 + std::sin(1.3 * x) * std::cos(0.9 * y) + 0.5 * std::sin(0.5 * x + 1.4 * y);
}

/// A block of 40 x 24 x 5 around the origin, its top a grid of unit / `fine` squares with waves in
/// the middle.
PreparedMesh wavy_block(int fine) {
  const int nx = 40 * fine;
  const int ny = 24 * fine;
  std::vector<Vec3> vertices;
  std::vector<Triangle> triangles;
  for (const bool is_top : {true, false}) {
    const int first = static_cast<int>(vertices.size());
    for (int i = 0; i <= nx; ++i) {
      for (int k = 0; k <= ny; ++k) {
        const double x = static_cast<double>(i) / fine - 20;
        const double y = static_cast<double>(k) / fine - 12;
        vertices.emplace_back(x, y, is_top ? waves(x, y) : -5);
      }
    }
    for (int i = 0; i < nx; ++i) {
      for (int k = 0; k < ny; ++k) {
        const int a = first + i * (ny + 1) + k;
        const int b = a + ny + 1;
        triangles.push_back(is_top ? Triangle{a, b, b + 1} : Triangle{a, b + 1, b});
        triangles.push_back(is_top ? Triangle{a, b + 1, a + 1} : Triangle{a, a + 1, b + 1});
      }
    }
  }
  const int below = static_cast<int>(vertices.size()) / 2;
  const auto wall = [&](int a, int b) {
    triangles.push_back({a, below + b, b});
    triangles.push_back({a, below + a, below + b});
  };
  for (int i = 0; i < nx; ++i) {
    wall(i * (ny + 1), (i + 1) * (ny + 1));
    wall((i + 1) * (ny + 1) + ny, i * (ny + 1) + ny);
  }
  for (int k = 0; k < ny; ++k) {
    wall(k + 1, k);
    wall(nx * (ny + 1) + k, nx * (ny + 1) + k + 1);
  }
  PreparedMesh prepared;
  prepared.mesh =
      std::make_shared<const Mesh>(make_mesh(std::move(vertices), std::move(triangles)));
  prepared.query = std::make_shared<const MeshQuery>(prepared.mesh);
  auto groups = segment(*prepared.mesh, {}, {});
  REQUIRE(groups.has_value());
  prepared.segmentation = std::move(*groups);
  return prepared;
}

TEST_CASE("a sculpted patch stays as a polyhedron beside a tree of the rest") {
  const PreparedMesh prepared = wavy_block(3);
  const auto patches = find_free_form_patches(*prepared.mesh, prepared.segmentation);
  REQUIRE(patches.size() == 1);
  const auto found = find_tree_beside(patches, prepared, {}, {}, {});
  REQUIRE(found.has_value());
  CHECK(found->area_share > 0.05);
  CHECK(found->area_share < 0.3);
  const Tree& tree = found->answer.tree;
  CHECK(literal_count(tree) == 4);  // block, box around the patch, mesh, box that it is cut to
  int polyhedra = 0;
  for (const Literal& s : tree.literals) polyhedra += s.kind == SolidKind::Polyhedron ? 1 : 0;
  CHECK(polyhedra == 1);
  const auto score = score_tree(*prepared.query, tree, {}, {});
  REQUIRE(score.has_value());
  CHECK(score->hausdorff < 1e-4);
  CHECK(score->agreement > 0.9999);
}

TEST_CASE("a part of primitives has no free-form patch") {
  PreparedMesh prepared = wavy_block(1);
  const auto patches = find_free_form_patches(*prepared.mesh, prepared.segmentation);
  for (FaceGroup& group : prepared.segmentation.groups) group.is_fitted = true;
  CHECK_FALSE(patches.empty());
  const auto none = find_free_form_patches(*prepared.mesh, prepared.segmentation);
  CHECK(none.empty());
  const auto found = find_tree_beside(none, prepared, {}, {}, {});
  REQUIRE_FALSE(found.has_value());
  CHECK(found.error().code == ErrorCode::NotFound);
}

}  // namespace
}  // namespace hewn
