#pragma once
/// Sorting by places that are spread out, such as those along a line.
#include <algorithm>
#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

namespace hewn {

/// Sorts items by a place, in whatever order those at the same place. As many buckets as items
/// leave few comparisons to make: their outcome is what other sorts cannot foretell, and wait for.
/// Holds scratch memory: one per thread.
template <class Item>
class BucketSorter {
 public:
  /// By `place_of(item)`, a double. Cost: O(items) when they are spread out, else as other sorts.
  template <class PlaceOf>
  void operator()(std::vector<Item>& items, const PlaceOf& place_of) {
    const auto is_before = [&](const Item& a, const Item& b) { return place_of(a) < place_of(b); };
    if (items.size() < kFewest) return std::sort(items.begin(), items.end(), is_before);
    double lowest = place_of(items.front());
    double highest = lowest;
    for (const Item& item : items) {
      lowest = std::min(lowest, place_of(item));
      highest = std::max(highest, place_of(item));
    }
    const double per_place = static_cast<double>(items.size() - 1) / (highest - lowest);
    const bool is_spread = per_place > 0 && per_place <= std::numeric_limits<double>::max();
    if (!is_spread) return std::sort(items.begin(), items.end(), is_before);
    distribute(items, [&](const Item& item) {
      return static_cast<std::uint32_t>((place_of(item) - lowest) * per_place);
    });
    std::uint32_t begin = 0;
    for (const std::uint32_t end : ends_) {
      if (end - begin > kMany) std::sort(&items[begin], &items[begin] + (end - begin), is_before);
      begin = end;
    }
    insert_in_turn(items, is_before);
  }

 private:
  static constexpr std::size_t kFewest = 32;
  static constexpr std::uint32_t kMany = 16;  ///< in one bucket

  /// Puts the items in the order of their buckets.
  template <class BucketOf>
  void distribute(std::vector<Item>& items, const BucketOf& bucket_of) {
    bucket_.resize(items.size());
    ends_.assign(items.size(), 0);
    for (std::size_t i = 0; i < items.size(); ++i) ++ends_[bucket_[i] = bucket_of(items[i])];
    std::uint32_t begin = 0;
    for (std::uint32_t& end : ends_) begin += std::exchange(end, begin);
    sorted_.resize(items.size());
    for (std::size_t i = 0; i < items.size(); ++i) sorted_[ends_[bucket_[i]]++] = items[i];
    items.swap(sorted_);
  }

  /// Insertion sort: of items that are few steps from their places.
  template <class IsBefore>
  static void insert_in_turn(std::vector<Item>& items, const IsBefore& is_before) {
    for (std::size_t i = 1; i < items.size(); ++i) {
      const Item item = items[i];
      std::size_t to = i;
      for (; to > 0 && is_before(item, items[to - 1]); --to) items[to] = items[to - 1];
      items[to] = item;
    }
  }

  std::vector<Item> sorted_;
  std::vector<std::uint32_t> bucket_;  ///< of each item
  std::vector<std::uint32_t> ends_;    ///< of each bucket
};

}  // namespace hewn
