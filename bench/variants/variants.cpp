#include "bench/variants/variants.h"

#include <utility>

#include "bench/variants/remesh.h"
#include "core/base/rng.h"
#include "core/mesh/load.h"

namespace hewn {
namespace {

/// In units of the diagonal.
constexpr double kMove = 100;
constexpr double kJitter = 1e-5;

Vec3 draw_in_ball(Rng& rng) {
  Vec3 p;
  do {
    for (double& c : p) c = rng.uniform(-1, 1);
  } while (p.squaredNorm() > 1);
  return p;
}

Vec3 draw_direction(Rng& rng) {
  Vec3 p = draw_in_ball(rng);
  while (p.norm() < 0.1) p = draw_in_ball(rng);
  return p.normalized();
}

Mesh moved(const Mesh& mesh, const Affine3& transform) {
  std::vector<Vec3> vertices = mesh.vertices;
  for (Vec3& v : vertices) v = transform * v;
  return make_mesh(std::move(vertices), mesh.triangles);
}

Affine3 draw_rotation(Rng& rng) {
  const Vec3 axis = draw_direction(rng);
  const double angle = rng.uniform(0.3, 2.8);
  return Affine3(Eigen::AngleAxisd(angle, axis));
}

Affine3 scaling(double factor) { return Affine3(Eigen::Scaling(factor)); }

Mesh jittered(const Mesh& mesh, Rng& rng) {
  std::vector<Vec3> vertices = mesh.vertices;
  for (Vec3& v : vertices) v += kJitter * mesh.diagonal() * draw_in_ball(rng);
  return make_mesh(std::move(vertices), mesh.triangles);
}

}  // namespace

Result<std::vector<Variant>> make_variants(const Mesh& mesh, const RunContext& run) {
  Rng rng(run.seed, 77);
  std::vector<Variant> variants;
  variants.push_back({"rotated", ".off", moved(mesh, draw_rotation(rng))});
  variants.push_back({"scaled-up", ".off", moved(mesh, scaling(1000))});
  variants.push_back({"scaled-down", ".off", moved(mesh, scaling(0.001))});
  const Vec3 shift = kMove * mesh.diagonal() * draw_direction(rng);
  variants.push_back({"moved", ".off", moved(mesh, Affine3(Eigen::Translation3d(shift)))});
  variants.push_back({"binary", ".stl", mesh});
  variants.push_back({"jittered", ".off", jittered(mesh, rng)});
  Result<Mesh> remeshed = remesh_isotropic(mesh, {}, run);
  if (!remeshed) return remeshed.error();
  variants.push_back({"remeshed", ".off", *std::move(remeshed)});
  return variants;
}

Result<std::vector<std::filesystem::path>> write_variants(const Mesh& mesh,
                                                          const std::filesystem::path& folder,
                                                          const std::string& stem,
                                                          const RunContext& run) {
  const Result<std::vector<Variant>> variants = make_variants(mesh, run);
  if (!variants) return variants.error();
  std::vector<std::filesystem::path> paths;
  for (const Variant& variant : *variants) {
    paths.push_back(folder / (stem + "-" + variant.name + variant.extension));
    if (auto ok = save_mesh(variant.mesh, paths.back()); !ok) return ok.error();
  }
  return paths;
}

}  // namespace hewn
