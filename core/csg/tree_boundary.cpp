#include "core/csg/tree_boundary.h"

#include "core/compute/parallel.h"
#include "core/csg/boundary/flush_faces.h"
#include "core/csg/boundary/patch_cutter.h"

namespace hewn {
namespace {

std::vector<std::int32_t> labels_of_ends(const BoundaryModel& model,
                                         const std::vector<int>& shown_as) {
  constexpr std::size_t kEnds = 6;
  std::vector<std::int32_t> shown;
  for (std::size_t l = 0; l < model.tree.literals.size(); ++l) {
    shown.insert(shown.end(), kEnds, static_cast<std::int32_t>(l));
  }
  for (std::size_t p = 0; p < model.patches.size(); ++p) {
    const BoundaryPatch& patch = model.patches[p];
    if (patch.shape != PatchShape::BoxSide && patch.shape != PatchShape::Cap) continue;
    shown[kEnds * static_cast<std::size_t>(patch.literal) + static_cast<std::size_t>(patch.part)] =
        shown_as[p];
  }
  return shown;
}

}  // namespace

Result<TreeBoundary> tree_boundary(const Tree& tree, double diagonal, const RunContext& run,
                                   BoundaryDetail detail) {
  TreeBoundary out;
  if (tree.is_empty()) return out;
  const double finest = diagonal / (detail == BoundaryDetail::Fine ? 300 : 100);
  const BoundaryModel model(tree, diagonal, finest);
  std::vector<PatchPart> parts(model.patches.size());
  for_each_index(run.threads, parts.size(), [&](std::size_t p) {
    if (!run.is_cancelled()) parts[p] = cut_patch(model, model.patches[p]);
  });
  if (run.is_cancelled()) return RunContext::cancelled();
  const std::vector<int> shown_as = shown_literals(model, parts);
  for (std::size_t p = 0; p < parts.size(); ++p) {
    const int label = shown_as[p];
    for (BoundaryCorner& c : parts[p].corners) c.label = label;
    for (BoundaryLine& l : parts[p].lines) l.label = label;
    out.corners.insert(out.corners.end(), parts[p].corners.begin(), parts[p].corners.end());
    out.lines.insert(out.lines.end(), parts[p].lines.begin(), parts[p].lines.end());
  }
  out.shown = labels_of_ends(model, shown_as);
  return out;
}

}  // namespace hewn
