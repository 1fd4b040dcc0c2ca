#include "core/session/result_view.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/compute/parallel.h"
#include "core/csg/tree_boundary.h"
#include "core/session/flat_faces.h"
#include "core/session/score.h"

namespace hewn {
namespace {

/// The literal whose boundary is nearest to each triangle's middle.
std::vector<int> nearest_literals(const Tree& tree, const Mesh& mesh, const RunContext& run) {
  std::vector<int> labels(mesh.triangles.size(), -1);
  constexpr std::size_t kGrain = 256;
  for_each_index(
      run.threads, labels.size(),
      [&](std::size_t t) {
        if (run.is_cancelled()) return;
        const Vec3 middle = mesh.centroid(static_cast<int>(t));
        double best = kInfinity;
        for (std::size_t l = 0; l < tree.literals.size(); ++l) {
          const double distance = std::abs(tree.literals[l].signed_distance(middle));
          if (distance >= best) continue;
          best = distance;
          labels[t] = static_cast<int>(l);
        }
      },
      kGrain);
  return labels;
}

std::vector<double> vertex_deviations(const Tree& tree, const Mesh& mesh, const RunContext& run) {
  std::vector<double> values(mesh.vertices.size(), 0);
  constexpr std::size_t kGrain = 64;
  for_each_index(
      run.threads, values.size(),
      [&](std::size_t v) {
        if (run.is_cancelled()) return;
        values[v] = signed_distance_to_tree(tree, mesh.vertices[v], mesh.diagonal());
      },
      kGrain);
  return values;
}

}  // namespace

Result<ResultView> build_result_view(const Reconstruction& found, const RunContext& run,
                                     BoundaryDetail detail) {
  ResultView view;
  const Mesh& mesh = *found.prepared.mesh;
  auto program = encode_tree(found.tree);
  run.report("draw", 0);
  auto boundary = tree_boundary(found.tree, mesh.diagonal(), run, detail);
  if (!boundary) return boundary.error();
  view.surface = build_display_mesh(*boundary);
  if (program) program->shown = std::move(boundary->shown);
  if (program) {
    view.program = std::make_shared<const TreeProgram>(std::move(*program));
  } else {
    view.program_problem = program.error().message;
  }
  run.report("measure", 0.5);
  std::vector<int> labels = nearest_literals(found.tree, mesh, run);
  unify_flat_faces(mesh, labels);
  view.input = build_display_mesh(mesh, labels);
  const std::vector<double> deviations = vertex_deviations(found.tree, mesh, run);
  if (run.is_cancelled()) return RunContext::cancelled();
  for (std::size_t i = 0; i < view.input.corners.size(); ++i) {
    const int v = view.input.vertices[i];
    view.input.corners[i].value = static_cast<float>(deviations[v]);
    view.max_deviation = std::max(view.max_deviation, std::abs(deviations[v]));
  }
  return view;
}

}  // namespace hewn
