#pragma once
/// Pictures of meshes and trees without a window: ray-cast, anti-aliased, the same on every run.
#include <cstdint>
#include <filesystem>
#include <vector>

#include "core/base/result.h"
#include "core/base/run_context.h"
#include "core/csg/tree.h"
#include "core/mesh/query.h"

namespace hewn {

/// Row by row from the top left, three bytes a pixel (sRGB).
struct Image {
  int width = 0, height = 0;
  std::vector<std::uint8_t> rgb;
};

struct PictureOptions {
  int width = 640, height = 640;
  int samples = 2;  ///< rays per pixel and direction
  bool is_dark = false;
  /// From the part towards the camera, in the part's coordinates.
  Vec3 view = Vec3(0.62, -1, 0.66);
};

/// The mesh, coloured by a number per triangle (its face group; negative is grey) with dark lines
/// between the colours. `scene` is the box to fit into the picture.
/// Fails with: InvalidArgument (no pixels), Cancelled.
Result<Image> render_mesh(const MeshQuery& query, const std::vector<int>& colour_of_triangle,
                          const Box3& scene, const PictureOptions& options, const RunContext& run);

/// The solid of the tree, coloured by literal. Fails with: InvalidArgument (no pixels), Cancelled.
Result<Image> render_tree(const Tree& tree, const Box3& scene, const PictureOptions& options,
                          const RunContext& run);

/// Two pictures of equal height next to each other.
Image side_by_side(const Image& left, const Image& right);

/// Fails with: FileWrite, Internal (libpng).
Result<void> save_png(const Image& image, const std::filesystem::path& path);

/// Colour number `index`, linear RGB: golden-angle hues of OKLCH lightness 0.74 and chroma 0.10.
Vec3 golden_colour(int index);

}  // namespace hewn
