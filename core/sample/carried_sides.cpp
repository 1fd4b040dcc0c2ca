#include "core/sample/carried_sides.h"

#include <algorithm>

#include "core/csg/literal_set.h"

namespace hewn {

CarriedSides::CarriedSides(const Arrangement& from, const Arrangement& to)
    : from_(from), to_(to), place_(from.literals.size(), to.literals.size()) {
  std::vector<LiteralBounds> bounds;
  std::vector<double> reach;
  for (std::size_t k = 0; k < to.literals.size(); ++k) {
    const auto is_same = [&](const Literal& s) { return is_same_solid(s, to.literals[k]); };
    const auto known = std::find_if(from.literals.begin(), from.literals.end(), is_same);
    if (known != from.literals.end()) {
      place_[static_cast<std::size_t>(known - from.literals.begin())] = k;
      continue;
    }
    fresh_.push_back(k);
    bounds.push_back(to.bounds[k]);
    reach.push_back(to.uncertain[k]);
  }
  near_ = BoundsTable(bounds, reach);
}

bool CarriedSides::classify(std::size_t cell, Word* signature) const {
  std::fill_n(signature, to_.stride, 0);
  for_each_bit({from_.signature(cell), from_.stride}, [&](std::size_t k) {
    if (place_[k] < to_.literals.size()) set_bit(signature, place_[k]);
  });
  bool is_certain = true;
  near_.visit_near(from_.points[cell], [&](std::size_t k) {
    is_certain = take_side(to_, fresh_[k], from_.points[cell], signature);
    return is_certain;
  });
  return is_certain;
}

}  // namespace hewn
