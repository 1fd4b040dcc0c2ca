#pragma once
/// The reduction of signatures to cells: which points cannot be told apart?
#include "core/compute/host_device.h"

namespace hewn {

/// Finds the place of every point's signature in a hash table with open addressing. Points with
/// equal signatures get the same place; which one it is may differ from run to run. One item is one
/// point. Cost: O(points x stride) while the table is at most half full.
struct CellKernel {
  const Word* signatures = nullptr;
  std::int64_t stride = 0;
  std::int64_t points = 0;
  int* table = nullptr;     ///< `places` entries, -1 at first; out: one point of each cell, or -1
  std::int64_t places = 0;  ///< a power of two, more than `points`
  int* place_of_point = nullptr;  ///< out

  template <class Grain>
  HEWN_HD std::int64_t items() const {
    return points;
  }

  template <class Grain>
  HEWN_HD void run(std::int64_t item) const {
    const Word* own = signatures + item * stride;
    std::int64_t place = static_cast<std::int64_t>(hash(own)) & (places - 1);
    for (;; place = (place + 1) & (places - 1)) {
      const int known = exchange_if(table + place, -1, static_cast<int>(item));
      if (known < 0 || is_equal(own, signatures + known * stride)) break;
    }
    place_of_point[item] = static_cast<int>(place);
  }

 private:
  HEWN_HD Word hash(const Word* words) const {
    Word h = 1469598103934665603ull;
    for (std::int64_t i = 0; i < stride; ++i) {
      h = (h ^ words[i]) * 0x9E3779B97F4A7C15ull;
      h ^= h >> 31;
    }
    return h ^ h >> 17;
  }
  HEWN_HD bool is_equal(const Word* a, const Word* b) const {
    for (std::int64_t i = 0; i < stride; ++i) {
      if (a[i] != b[i]) return false;
    }
    return true;
  }
};

}  // namespace hewn
