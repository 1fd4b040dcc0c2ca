#include "core/synth/thin_features.h"

#include <algorithm>
#include <bit>
#include <numeric>

#include "core/csg/tree_ray.h"
#include "core/sample/equivalence.h"

namespace hewn {
namespace {

/// Labels of things that are joined step by step.
class DisjointSets {
 public:
  explicit DisjointSets(std::size_t n) : parent_(n) {
    std::iota(parent_.begin(), parent_.end(), std::size_t{0});
  }
  std::size_t find(std::size_t i) {
    while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
    return i;
  }
  void join(std::size_t a, std::size_t b) {
    parent_[std::max(find(a), find(b))] = find(std::min(a, b));
  }

 private:
  std::vector<std::size_t> parent_;
};

bool touch(const Arrangement& arrangement, std::size_t a, std::size_t b) {
  int differences = 0;
  for (std::size_t w = 0; w < arrangement.stride && differences < 2; ++w) {
    differences += std::popcount(arrangement.signature(a)[w] ^ arrangement.signature(b)[w]);
  }
  return differences == 1;
}

}  // namespace

std::vector<ThinFeature> thin_features(const Tree& tree, const Arrangement& arrangement,
                                       const Column& wanted, const Column& changed) {
  std::vector<std::size_t> cells;
  for_each_bit(changed, [&](std::size_t c) { cells.push_back(c); });
  const auto is_filled = [&](std::size_t i) { return !test_bit(wanted.data(), cells[i]); };
  DisjointSets sets(cells.size());
  for (std::size_t i = 0; i < cells.size(); ++i) {
    for (std::size_t k = 0; k < i; ++k) {
      if (is_filled(i) == is_filled(k) && touch(arrangement, cells[i], cells[k])) sets.join(i, k);
    }
  }
  const TreeRays rays(tree);
  TreeRayScratch scratch;
  std::vector<ThinFeature> by_root(cells.size());
  for (std::size_t i = 0; i < cells.size(); ++i) {
    ThinFeature& f = by_root[sets.find(i)];
    const Vec3& p = arrangement.points[cells[i]];
    const double thickness = 2 * distance_along_rays(rays, p, 0, scratch);
    if (f.cells == 0 || thickness > f.thickness) {
      f.at = p;
      f.thickness = thickness;
    }
    f.is_filled = is_filled(i);
    ++f.cells;
  }
  std::erase_if(by_root, [](const ThinFeature& f) { return f.cells == 0; });
  std::stable_sort(by_root.begin(), by_root.end(),
                   [](const auto& a, const auto& b) { return a.thickness > b.thickness; });
  return by_root;
}

}  // namespace hewn
