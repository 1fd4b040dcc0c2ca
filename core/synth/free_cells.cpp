#include "core/synth/free_cells.h"

#include <algorithm>

namespace hewn {

void FreeCells::remove_from(Column& cells, const ArrangementSampler& sampler, double depth,
                            const RunContext& run) {
  const auto more = find_thin_cells(tree_, sampler.arrangement(), depths_.size(), depth, run);
  depths_.insert(depths_.end(), more.begin(), more.end());
  for (const auto& [cell, point] : held_) depths_[cell] = {false, point};
  for (std::size_t c = 0; c < depths_.size(); ++c) {
    if (depths_[c].is_thin) cells[c / 64] &= ~(Word{1} << (c % 64));
  }
}

void FreeCells::hold(const Vec3& point, const ArrangementSampler& sampler) {
  held_points_.push_back(point);
  mark(point, sampler);
}

void FreeCells::renumber(const ArrangementSampler& sampler) {
  depths_.clear();
  held_.clear();
  for (const Vec3& p : held_points_) mark(p, sampler);
}

void FreeCells::mark(const Vec3& point, const ArrangementSampler& sampler) {
  const std::size_t c = sampler.cell_of(point);
  if (c < sampler.arrangement().size()) held_[c] = point;
}

std::vector<Vec3> FreeCells::deep_points() const {
  std::vector<Vec3> points;
  for (const CellDepth& d : depths_) {
    if (!d.is_thin) points.push_back(d.point);
  }
  return points;
}

std::size_t FreeCells::count() const {
  return static_cast<std::size_t>(
      std::count_if(depths_.begin(), depths_.end(), [](const CellDepth& d) { return d.is_thin; }));
}

}  // namespace hewn
