#pragma once
/// The corner under the mouse, for tools that take hold of one.
#include <array>
#include <memory>
#include <vector>

#include "ui/studio_state.h"
#include "ui/view/pixels.h"
#include "ui/view/scene.h"

namespace hewn {

class CornerFinder {
 public:
  /// The nearest corner within 8 pixels of a window pixel that is seen: one of its groups is in the
  /// picture beside it. Null: there is none. Valid until the next call.
  const Corner* find(const Ui& ui, const ViewArea& area, const IdImage& ids,
                     const std::array<float, 2>& pixel);

 private:
  std::shared_ptr<const PreparedMesh> corners_of_;
  std::vector<Corner> corners_;
};

}  // namespace hewn
