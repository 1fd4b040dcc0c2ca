#include "core/synth/free_cells.h"

#include <algorithm>

namespace hewn {

void FreeCells::remove_from(Column& cells, const ArrangementSampler& sampler, double depth,
                            const RunContext& run) {
  const Arrangement& arrangement = sampler.arrangement();
  depths_.resize(std::max(depths_.size(), arrangement.size()));
  std::vector<std::size_t> unknown;
  for_each_bit(cells, [&](std::size_t c) {
    if (c < arrangement.size() && !depths_[c]) unknown.push_back(c);
  });
  const auto found = find_thin_cells(tree_, arrangement, unknown, depth, run);
  for (std::size_t i = 0; i < unknown.size(); ++i) depths_[unknown[i]] = found[i];
  for (std::size_t c = 0; c < arrangement.size(); ++c) {
    if (depths_[c] && depths_[c]->is_thin) cells[c / 64] &= ~(Word{1} << (c % 64));
  }
}

void FreeCells::hold(const Vec3& point, const ArrangementSampler& sampler) {
  held_.push_back(point);
  mark(point, sampler);
}

void FreeCells::renumber(const ArrangementSampler& sampler) {
  depths_.clear();
  for (const Vec3& p : held_) mark(p, sampler);
}

void FreeCells::mark(const Vec3& point, const ArrangementSampler& sampler) {
  const std::size_t c = sampler.cell_of(point);
  if (c == sampler.arrangement().size()) return;
  depths_.resize(std::max(depths_.size(), c + 1));
  depths_[c] = CellDepth{false, point};
}

std::vector<Vec3> FreeCells::deep_points() const {
  std::vector<Vec3> points;
  for (const auto& d : depths_) {
    if (d && !d->is_thin) points.push_back(d->point);
  }
  return points;
}

std::size_t FreeCells::count() const {
  return static_cast<std::size_t>(
      std::count_if(depths_.begin(), depths_.end(), [](const auto& d) { return d && d->is_thin; }));
}

}  // namespace hewn
