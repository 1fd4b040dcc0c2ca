#include "core/sample/cells.h"

#include <algorithm>
#include <map>

#include "core/compute/compute.h"
#include "core/compute/signatures.h"

namespace hewn {
namespace {

constexpr double kLargestMinority = 0.25;
constexpr std::size_t kLargeTable = 400;

bool is_clear(int inside, int outside, std::size_t cells) {
  const int total = inside + outside;
  if (std::min(inside, outside) > kLargestMinority * total) return false;
  return total >= 2 || cells <= kLargeTable;
}

/// Two zero bits after each of the lowest 21.
std::uint64_t spread_bits(std::uint64_t x) {
  x = (x | x << 32) & 0x001f00000000ffffull;
  x = (x | x << 16) & 0x001f0000ff0000ffull;
  x = (x | x << 8) & 0x100f00f00f00f00full;
  x = (x | x << 4) & 0x10c30c30c30c30c3ull;
  return (x | x << 2) & 0x1249249249249249ull;
}

/// Sorts cells along a Z-curve through their first points (Morton 1966). What a term covers then
/// lies in few blocks of a column.
void sort_along_curve(const SampleTable& table, const Cells& cells, std::vector<int>& kept) {
  const auto point_of = [&](int c) -> const Vec3& {
    return table.points[static_cast<std::size_t>(cells.first_point[c])];
  };
  Box3 box;
  for (const int c : kept) box.extend(point_of(c));
  const double scale = 2097151 / std::max(box.size().maxCoeff(), 1e-300);
  std::vector<std::pair<std::uint64_t, int>> order;
  order.reserve(kept.size());
  for (const int c : kept) {
    const Vec3 p = (point_of(c) - box.lo) * scale;
    std::uint64_t code = 0;
    for (int k = 0; k < 3; ++k) code |= spread_bits(static_cast<std::uint64_t>(p[k])) << k;
    order.emplace_back(code, c);
  }
  std::sort(order.begin(), order.end());
  for (std::size_t i = 0; i < kept.size(); ++i) kept[i] = order[i].second;
}

}  // namespace

long Cells::conflicting_points() const {
  long total = 0;
  for (std::size_t c = 0; c < size(); ++c) total += std::min(inside_count[c], outside_count[c]);
  return total;
}

Cells find_cells(const SampleTable& table, const RunContext& run) {
  Cells cells;
  const auto job = [&](Device& device) -> Result<void> {
    auto numbers = number_distinct_rows(device, table.signatures, table.stride);
    if (!numbers) return numbers.error();
    cells.cell_of_point = std::move(*numbers);
    return {};
  };
  const double seconds = seconds_for_rows(table.size(), table.stride);
  const Result<void> done = compute_of(run)->run(seconds, run, job);
  // No halfspace tells the points apart.
  if (!done || table.stride == 0) cells.cell_of_point.assign(table.size(), 0);
  for (std::size_t i = 0; i < table.size(); ++i) {
    const auto cell = static_cast<std::size_t>(cells.cell_of_point[i]);
    if (cell == cells.size()) {
      cells.first_point.push_back(static_cast<int>(i));
      cells.inside_count.push_back(0);
      cells.outside_count.push_back(0);
    }
    ++(table.is_inside[i] ? cells.inside_count : cells.outside_count)[cell];
  }
  return cells;
}

Cells find_cells(const SampleTable& table) {
  RunContext run;
  run.threads = 1;
  return find_cells(table, run);
}

ColumnTable::ColumnTable(const SampleTable& table, const Cells& cells, Labels labels)
    : halfspaces_(table.halfspaces), kept_index_(cells.size(), -1) {
  std::vector<int> kept;
  for (std::size_t c = 0; c < cells.size(); ++c) {
    const int inside = cells.inside_count[c];
    const int outside = cells.outside_count[c];
    const bool is_kept = labels == Labels::Exact ? std::min(inside, outside) == 0
                                                 : is_clear(inside, outside, cells.size());
    if (is_kept) kept.push_back(static_cast<int>(c));
  }
  sort_along_curve(table, cells, kept);
  for (std::size_t i = 0; i < kept.size(); ++i) kept_index_[kept[i]] = static_cast<int>(i);
  cells_ = kept.size();
  words_ = padded_words(cells_);
  columns_.assign(2 * halfspaces_ * words_, 0);
  wanted_.assign(words_, 0);
  all_.assign(words_, 0);
  for (std::size_t i = 0; i < cells_; ++i) {
    const int c = kept[i];
    set_bit(all_.data(), i);
    if (cells.inside_count[c] > cells.outside_count[c]) set_bit(wanted_.data(), i);
    const Word* signature = table.signature(static_cast<std::size_t>(cells.first_point[c]));
    for (std::size_t k = 0; k < halfspaces_; ++k) {
      set_bit(columns_.data() + (2 * k + (test_bit(signature, k) ? 1 : 0)) * words_, i);
    }
  }
  fill_pairs(table);
}

void ColumnTable::fill_pairs(const SampleTable& table) {
  std::map<int, std::vector<const SamplePair*>> by_group;
  for (const SamplePair& pair : table.pairs) by_group[pair.group].push_back(&pair);
  pair_masks_.assign(by_group.size(), 0);
  pair_words_.assign(4 * halfspaces_ * by_group.size(), 0);
  std::size_t g = 0;
  for (const auto& [group, pairs] : by_group) {
    const std::size_t count = std::min<std::size_t>(pairs.size(), 64);
    for (std::size_t b = 0; b < count; ++b) {
      pair_masks_[g] |= Word{1} << b;
      const int ends[2] = {pairs[b]->inside, pairs[b]->outside};
      for (std::size_t end = 0; end < 2; ++end) {
        const Word* signature = table.signature(static_cast<std::size_t>(ends[end]));
        for (std::size_t k = 0; k < halfspaces_; ++k) {
          const std::size_t side = test_bit(signature, k) ? 1 : 0;
          pair_words_[((2 * k + side) * by_group.size() + g) * 2 + end] |= Word{1} << b;
        }
      }
    }
    ++g;
  }
}

}  // namespace hewn
