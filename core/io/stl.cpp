#include "core/io/stl.h"

#include <algorithm>
#include <memory>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "core/base/rng.h"
#include "core/io/brep/module.h"
#include "core/mesh/load.h"
#include "core/mesh/query.h"
#include "core/mesh/sampling.h"

namespace hewn {
namespace {

/// Share of the check points that mesh and tree classify differently, those near the surface aside.
double disagreement(const Tree& tree, const Mesh& mesh, const TessellationOptions& options) {
  const Box3 box = tree.bounds();
  const double band = 2 * options.deflection * box.diagonal();
  const MeshQuery query(std::make_shared<const Mesh>(mesh));
  Rng rng(1);
  int checked = 0;
  int wrong = 0;
  for (int i = 0; i < options.check_points; ++i) {
    const Vec3 x = sample_box(box, rng);
    const double d = tree.signed_distance(x);
    if (std::abs(d) <= band) continue;
    ++checked;
    wrong += query.contains(x) != (d < 0) ? 1 : 0;
  }
  return checked > 0 ? static_cast<double>(wrong) / checked : 0;
}

Result<Mesh> try_strategy(const BrepFunctions& functions, const Tree& tree,
                          BooleanStrategy strategy, const TessellationOptions& options,
                          const RunContext& run) {
  Result<TriangleSoup> soup = functions.triangulate({tree, tree.bounds()}, strategy,
                                                    options.angle_deg, options.deflection, run);
  if (!soup) return soup.error();
  if (soup->triangles.empty()) {
    return Error{ErrorCode::Internal, "the Booleans left no surface", "mesh export"};
  }
  Result<LoadedMesh> mesh =
      repair_mesh(std::move(soup->vertices), std::move(soup->triangles), MeshLoadOptions{}, run);
  if (!mesh) return mesh.error();
  if (!mesh->report.is_closed) {
    return Error{ErrorCode::Internal,
                 fmt::format("the mesh has {} open edges", mesh->report.boundary_edges),
                 "mesh export"};
  }
  const double wrong = disagreement(tree, mesh->mesh, options);
  constexpr double kMostWrong = 1e-3;
  if (wrong > kMostWrong) {
    return Error{ErrorCode::Internal,
                 fmt::format("{:.2g} % of the check points differ from the tree", wrong * 100),
                 "mesh export"};
  }
  return std::move(mesh->mesh);
}

}  // namespace

Result<Mesh> tessellate(const Tree& tree, const TessellationOptions& options,
                        const RunContext& run) {
  if (!(options.angle_deg > 0 && options.angle_deg <= 90 && options.deflection > 0)) {
    return Error{ErrorCode::InvalidArgument,
                 "the angle must be in (0, 90] degrees and the deflection positive", "mesh export"};
  }
  const Result<const BrepFunctions*> functions = brep_functions();
  if (!functions) return functions.error();
  const Tree plain = without_complements(tree);
  Error last;
  for (const BooleanStrategy strategy :
       {BooleanStrategy::Together, BooleanStrategy::Pairwise, BooleanStrategy::Fuzzy}) {
    Result<Mesh> mesh = try_strategy(**functions, plain, strategy, options, run);
    if (mesh) return mesh;
    last = mesh.error();
    if (last.code == ErrorCode::Cancelled || last.code == ErrorCode::InvalidArgument) return last;
    run.info("mesh export: " + last.message + "; trying a more forgiving way");
  }
  last.message += "; render the .scad in OpenSCAD instead";
  return last;
}

Result<void> write_mesh(const Tree& tree, const std::filesystem::path& path,
                        const TessellationOptions& options, const RunContext& run) {
  const Result<Mesh> mesh = tessellate(tree, options, run);
  if (!mesh) return mesh.error();
  return save_mesh(*mesh, path);
}

}  // namespace hewn
