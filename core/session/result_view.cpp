#include "core/session/result_view.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/compute/parallel.h"
#include "core/io/stl.h"
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

/// Where faces of several literals coincide, the nearest one is a matter of chance: takes the first
/// without which the solid would not begin behind the triangle, as exact pictures do.
void settle_coincident(const Tree& tree, const TreeProgram& program, const Mesh& mesh,
                       std::vector<int>& labels, const RunContext& run) {
  const double same = 1e-6 * mesh.diagonal();
  const double behind = 2e-5 * mesh.diagonal();
  for_each_index(run.threads, labels.size(), [&](std::size_t i) {
    if (run.is_cancelled()) return;
    const int t = static_cast<int>(i);
    const Vec3 middle = mesh.centroid(t);
    const double nearest = std::abs(tree.literals[labels[t]].signed_distance(middle));
    std::vector<std::size_t> tied;
    std::vector<bool> inside;
    for (std::size_t l = 0; l < tree.literals.size(); ++l) {
      const double distance = std::abs(tree.literals[l].signed_distance(middle));
      if (distance <= nearest + same) tied.push_back(l);
      inside.push_back(tree.literals[l].signed_distance(middle - behind * mesh.normals[t]) < 0);
    }
    if (tied.size() < 2 || !program.answer(inside)) return;
    for (const std::size_t l : tied) {
      inside[l] = !inside[l];
      const bool matters = !program.answer(inside);
      inside[l] = !inside[l];
      if (!matters) continue;
      labels[t] = static_cast<int>(l);
      return;
    }
  });
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

Result<ResultView> build_result_view(const Reconstruction& found, const RunContext& run) {
  ResultView view;
  const Mesh& mesh = *found.prepared.mesh;
  auto program = encode_tree(found.tree);
  run.report("tessellate", 0);
  auto surface = tessellate(found.tree, TessellationOptions{}, run);
  if (run.is_cancelled()) return RunContext::cancelled();
  if (surface) {
    std::vector<int> labels = nearest_literals(found.tree, *surface, run);
    if (program) settle_coincident(found.tree, *program, *surface, labels, run);
    const std::vector<FlatFace> faces = unify_flat_faces(*surface, labels);
    if (program) program->shown = shown_labels(found.tree, faces, 1e-6 * mesh.diagonal());
    view.surface = build_display_mesh(*surface, labels);
  } else {
    view.problem = "the result cannot be shown as a surface: " + surface.error().message;
  }
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
