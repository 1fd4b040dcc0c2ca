#include "core/csg/literal_boxes.h"

namespace hewn {

std::vector<Box3> literal_boxes(const Tree& tree) {
  const Box3 part = tree.bounds();
  std::vector<Box3> boxes;
  boxes.reserve(tree.literals.size());
  for (const Literal& literal : tree.literals) {
    const Box3 own = literal.bounds();
    boxes.push_back({own.lo.cwiseMax(part.lo), own.hi.cwiseMin(part.hi)});
  }
  return boxes;
}

}  // namespace hewn
