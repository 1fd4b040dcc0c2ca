#include "core/synth/decompose/growth_start.h"

namespace hewn {

void GrowthStart::reset(const ColumnTable& columns, const std::vector<Word>& open,
                        const std::vector<Word>* gained, bool fills, const PairCounts* pairs) {
  columns_ = &columns;
  pairs_ = pairs;
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
    fresh.side = static_cast<int>(2 * halfspace + (inside ? 1 : 0));
    fresh.sides.clear();
  }
  return children_[static_cast<std::size_t>(child)];
}

void GrowthStart::count_insides(const CountedCells& counted, std::span<const Word* const> insides,
                                std::span<CommonCounts> out) const {
  if (pairs_ == nullptr) return counted.cells.count(insides, out);
  const auto first = static_cast<std::size_t>(counted.side / 2);
  for (std::size_t k = 0; k < out.size(); ++k) {
    const CommonCounts all = pairs_->of(k, k);
    const CommonCounts common = counted.side < 0 ? all : pairs_->of(first, k);
    const bool is_outside = counted.side >= 0 && counted.side % 2 == 0;
    out[k] = is_outside ? CommonCounts{all.a - common.a, all.b - common.b} : common;
  }
}

}  // namespace hewn
