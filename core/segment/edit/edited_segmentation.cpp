#include "core/segment/edit/edited_segmentation.h"

#include <string>

namespace hewn {

Result<void> check_groups(const Segmentation& segmentation, std::span<const int> groups) {
  const int count = static_cast<int>(segmentation.groups.size());
  for (const int g : groups) {
    if (g >= 0 && g < count) continue;
    const std::string advice =
        count == 0 ? "segment the mesh first" : "choose one of 0 to " + std::to_string(count - 1);
    return Error{ErrorCode::InvalidArgument,
                 "there is no face group " + std::to_string(g) + "; " + advice};
  }
  return {};
}

}  // namespace hewn
