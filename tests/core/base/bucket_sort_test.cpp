#include "core/base/bucket_sort.h"

#include <algorithm>
#include <limits>
#include <utility>
#include <vector>

#include <doctest/doctest.h>

#include "core/base/math.h"
#include "core/base/rng.h"

namespace hewn {
namespace {

using Item = std::pair<double, int>;

/// Sorted, and the same items as before.
void check_sorted(std::vector<Item> items) {
  std::vector<Item> expected = items;
  std::sort(expected.begin(), expected.end());
  BucketSorter<Item>()(items, [](const Item& item) { return item.first; });
  const auto by_place = [](const Item& a, const Item& b) { return a.first < b.first; };
  CHECK(std::is_sorted(items.begin(), items.end(), by_place));
  std::sort(items.begin(), items.end());
  CHECK(items == expected);
}

std::vector<Item> numbered(const std::vector<double>& places) {
  std::vector<Item> items;
  for (const double place : places) items.emplace_back(place, static_cast<int>(items.size()));
  return items;
}

TEST_CASE("places come out in order, however they are spread") {
  Rng rng(1, 0);
  for (const std::size_t count : {0, 1, 2, 31, 32, 100, 1000}) {
    std::vector<double> even, squeezed, few, same(count, 0.25);
    for (std::size_t i = 0; i < count; ++i) {
      even.push_back(rng.uniform(-3, 5));
      squeezed.push_back(i == 0 ? 1e9 : rng.uniform(0, 1e-6));
      few.push_back(static_cast<double>(rng.below(5)));
    }
    for (const auto& places : {even, squeezed, few, same}) check_sorted(numbered(places));
  }
}

TEST_CASE("places at the ends of what a number can be come out in order") {
  constexpr double kLargest = std::numeric_limits<double>::max();
  constexpr double kSmallest = std::numeric_limits<double>::denorm_min();
  Rng rng(2, 0);
  for (const double unit : {kLargest, kSmallest, kInfinity}) {
    std::vector<double> places;
    for (int i = 0; i < 100; ++i) places.push_back((static_cast<double>(rng.below(3)) - 1) * unit);
    for (double& place : places) place = place == place ? place : 0;  // 0 times infinity
    check_sorted(numbered(places));
  }
}

TEST_CASE("one sorter sorts longer and shorter lists in turn") {
  BucketSorter<double> sort;
  Rng rng(3, 0);
  for (const std::size_t count : {200, 40, 300, 5}) {
    std::vector<double> places;
    for (std::size_t i = 0; i < count; ++i) places.push_back(rng.uniform());
    sort(places, [](double place) { return place; });
    CHECK(places.size() == count);
    CHECK(std::is_sorted(places.begin(), places.end()));
  }
}

}  // namespace
}  // namespace hewn
