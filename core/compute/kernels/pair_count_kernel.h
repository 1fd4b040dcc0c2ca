#pragma once
/// Counting for terms that grow: what does each pair of literals keep?
#include "core/compute/host_device.h"

namespace hewn {

/// For every pair of columns, how many bits of two sets lie in both. One item is one pair.
/// Cost: pairs x words.
struct PairCountKernel {
  const Word* a = nullptr;  ///< the sets
  const Word* b = nullptr;
  const Word* columns = nullptr;
  std::int64_t column_count = 0;
  std::int64_t words = 0;          ///< of each set and column
  bool is_transposed = false;      ///< the columns' first words come first, then their second ones
  CommonCounts* counts = nullptr;  ///< out: `column_count` rows of as many

  template <class Grain>
  HEWN_HD std::int64_t items() const {
    return column_count * column_count;
  }

  template <class Grain>
  HEWN_HD void run(std::int64_t item) const {
    const std::int64_t first = quotient(item, column_count);
    const std::int64_t second = item - first * column_count;
    // Of both orders, the other item does this one, too.
    if (second < first) return;
    const CommonCounts found = is_transposed
                                   ? common(columns + first, columns + second, column_count)
                                   : common(columns + first * words, columns + second * words, 1);
    counts[item] = found;
    counts[second * column_count + first] = found;
  }

 private:
  HEWN_HD CommonCounts common(const Word* first, const Word* second, std::int64_t step) const {
    CommonCounts found;
    for (std::int64_t w = 0; w < words; ++w) {
      const Word both = first[w * step] & second[w * step];
      found.a += count_bits(a[w] & both);
      found.b += count_bits(b[w] & both);
    }
    return found;
  }
};

}  // namespace hewn
