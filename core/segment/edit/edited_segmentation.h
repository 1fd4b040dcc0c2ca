#pragma once
/// What every edit of a segmentation gives back.
#include <span>
#include <vector>

#include "core/base/result.h"
#include "core/fit/face_groups.h"
#include "core/mesh/mesh.h"

namespace hewn {

/// What an edit made, and where it came from.
struct EditedSegmentation {
  Mesh mesh;
  Segmentation segmentation;
  std::vector<int> source_triangle;  ///< for each triangle, that of the mesh before
  std::vector<int> source_group;     ///< for each group, (the first of) those before
};

/// Fails with InvalidArgument when one of `groups` does not exist.
Result<void> check_groups(const Segmentation& segmentation, std::span<const int> groups);

}  // namespace hewn
