#include "app/hewn/pictures.h"

namespace hewn {

Result<Image> draw_groups(const PreparedMesh& prepared, bool is_dark, const RunContext& run) {
  run.report("picture", 0);
  PictureOptions options;
  options.is_dark = is_dark;
  return render_mesh(*prepared.query, prepared.segmentation.group_of_triangle,
                     prepared.mesh->bounds, options, run);
}

Result<Image> draw_input_and_result(const PreparedMesh& prepared, const Tree& tree, bool is_dark,
                                    const RunContext& run) {
  auto left = draw_groups(prepared, is_dark, run);
  if (!left) return left;
  run.report("picture", 0.5);
  PictureOptions options;
  options.is_dark = is_dark;
  auto right = render_tree(tree, prepared.mesh->bounds, options, run);
  if (!right) return right;
  return side_by_side(*left, *right);
}

}  // namespace hewn
