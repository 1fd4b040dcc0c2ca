#pragma once
/// Groups of indices that are joined pair by pair.
#include <algorithm>
#include <numeric>
#include <vector>

namespace hewn {

/// Union-find with path halving; the lowest index of a group is its root.
class IndexGroups {
 public:
  explicit IndexGroups(std::size_t n) : parent_(n) { std::iota(parent_.begin(), parent_.end(), 0); }
  int root(int i) {
    while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
    return i;
  }
  void join(int a, int b) {
    a = root(a);
    b = root(b);
    if (a != b) parent_[std::max(a, b)] = std::min(a, b);
  }

 private:
  std::vector<int> parent_;
};

}  // namespace hewn
