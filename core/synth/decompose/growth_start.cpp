#include "core/synth/decompose/growth_start.h"

namespace hewn {

void GrowthStart::reset(const ColumnTable& columns, const std::vector<Word>& open,
                        const std::vector<Word>* gained, bool fills) {
  columns_ = &columns;
  is_known_ = true;
  root_.cells.reset(columns, open, gained, fills);
  root_.left = root_.cells.count();
  root_.sides.clear();
  child_of_side_.assign(2 * columns.halfspaces(), -1);
  children_used_ = 0;
}

CountedCells& GrowthStart::after(std::size_t halfspace, bool inside) {
  int& child = child_of_side_[2 * halfspace + (inside ? 1 : 0)];
  if (child < 0) {
    child = static_cast<int>(children_used_++);
    if (children_.size() < children_used_) children_.emplace_back();
    CountedCells& fresh = children_[static_cast<std::size_t>(child)];
    fresh.cells.take_in(root_.cells, columns_->column(halfspace, inside));
    fresh.left = fresh.cells.count();
    fresh.sides.clear();
  }
  return children_[static_cast<std::size_t>(child)];
}

}  // namespace hewn
