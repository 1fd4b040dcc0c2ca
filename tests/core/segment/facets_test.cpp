#include "core/segment/facets.h"

#include <doctest/doctest.h>

#include "core/base/rng.h"
#include "core/segment/facet_noise.h"
#include "tests/support/solids.h"

namespace hewn {
namespace {

FacetGraph facets_of(const Mesh& mesh, double noise = 0) {
  const double d = mesh.diagonal();
  const auto neighbors = triangle_neighbors(mesh);
  return build_facets(FacetMerger(mesh, neighbors), {std::max(1.5e-5 * d, 4.5 * noise), noise});
}

double noise_of(const Mesh& mesh) {
  const auto neighbors = triangle_neighbors(mesh);
  return estimate_noise(FacetMerger(mesh, neighbors));
}

/// Moves every coordinate by up to `amount`.
Mesh jittered(const Mesh& mesh, double amount, std::uint64_t seed) {
  Rng rng(seed);
  std::vector<Vec3> vertices = mesh.vertices;
  for (Vec3& p : vertices) {
    for (double& c : p) c += rng.uniform(-amount, amount);
  }
  return make_mesh(vertices, mesh.triangles);
}

TEST_CASE("a finely cut box has six facets with four corners each") {
  const FacetGraph graph = facets_of(solids::box(Vec3(0, 0, 0), Vec3(1, 2, 3), 5));
  REQUIRE(graph.size() == 6);
  for (int f = 0; f < graph.size(); ++f) {
    CHECK(graph.corners(f).size() == 4);
    CHECK(graph.vertices(f).size() == 36);
    REQUIRE(graph.neighbors(f).size() == 4);
    for (const FacetNeighbor& n : graph.neighbors(f)) {
      CHECK(n.angle_rad == doctest::Approx(kPi / 2));
    }
  }
  CHECK(graph.interior_share > 0.5);
}

TEST_CASE("a tessellated cylinder has one facet for each side") {
  const Mesh mesh = solids::transformed(solids::cylinder(2, 3, 30, 4), solids::oblique_transform());
  const FacetGraph graph = facets_of(mesh);
  CHECK(graph.size() == 32);
  std::size_t triangles = 0;
  for (const Facet& facet : graph.facets) triangles += facet.triangles.size();
  CHECK(triangles == mesh.triangles.size());
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const Facet& facet = graph.facets[graph.facet_of_triangle[t]];
    CHECK(std::binary_search(facet.triangles.begin(), facet.triangles.end(), static_cast<int>(t)));
  }
}

TEST_CASE("jitter neither tears facets apart nor hides from the noise estimate") {
  const Mesh clean = solids::transformed(solids::box(Vec3(0, 0, 0), Vec3(1, 1, 1), 6),
                                         solids::oblique_transform());
  const double amount = 2e-5 * clean.diagonal();
  const Mesh mesh = jittered(clean, amount, 7);
  const double noise = noise_of(mesh);
  CHECK(noise > 0.3 * amount);
  CHECK(noise < 1.2 * amount);
  CHECK(facets_of(mesh, noise).size() == 6);
  CHECK(noise_of(clean) < 1e-7 * clean.diagonal());
}

TEST_CASE("the rounding of digits and of single precision is read from the coordinates") {
  const Mesh box = solids::box(Vec3(0, 0, 0), Vec3(1, 1, 1), 3);
  std::vector<Vec3> vertices;
  for (const Vec3& p : box.vertices) vertices.push_back(p * std::sqrt(2.0));
  CHECK(coordinate_rounding(make_mesh(vertices, box.triangles)) == 0);
  std::vector<Vec3> single = vertices, digits = vertices;
  for (Vec3& p : single) p = p.cast<float>().cast<double>();
  for (Vec3& p : digits) {
    for (double& c : p) c = std::round(c * 1e4) / 1e4;
  }
  const double of_single = coordinate_rounding(make_mesh(single, box.triangles));
  CHECK(of_single > 1e-8);
  CHECK(of_single < 1e-7);
  const double of_digits = coordinate_rounding(make_mesh(digits, box.triangles));
  CHECK(of_digits > 1e-5);
  CHECK(of_digits < 1e-4);
}

TEST_CASE("an open mesh keeps its rim as corners and has no neighbour across it") {
  const Mesh one = make_mesh({Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0)}, {Triangle{0, 1, 2}});
  const auto neighbors = triangle_neighbors(one);
  CHECK(neighbors[0] == std::array<int, 3>{-1, -1, -1});
  const FacetGraph graph = facets_of(one);
  REQUIRE(graph.size() == 1);
  CHECK(graph.corners(0).size() == 3);
  CHECK(graph.neighbors(0).empty());
}

}  // namespace
}  // namespace hewn
