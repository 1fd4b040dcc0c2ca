#include "core/base/rng.h"

#include <algorithm>
#include <vector>

#include <doctest/doctest.h>

namespace hewn {
namespace {

TEST_CASE("the numbers of a seed never change") {
  // Trees in bug reports are found again only as long as these stay.
  Rng rng(1);
  const std::uint64_t first = rng.next();
  const std::uint64_t second = rng.next();
  Rng again(1);
  CHECK(again.next() == first);
  CHECK(again.next() == second);
  CHECK(Rng(1, 1).next() != first);
  CHECK(Rng(2).next() != first);
}

TEST_CASE("uniform numbers fill their range evenly") {
  Rng rng(3);
  std::vector<int> counts(10, 0);
  for (int i = 0; i < 10000; ++i) {
    const double x = rng.uniform();
    REQUIRE(x >= 0);
    REQUIRE(x < 1);
    ++counts[static_cast<std::size_t>(10 * x)];
  }
  const auto [least, most] = std::minmax_element(counts.begin(), counts.end());
  CHECK(*least > 850);
  CHECK(*most < 1150);
}

TEST_CASE("below stays below and reaches everything") {
  Rng rng(4);
  std::vector<int> counts(7, 0);
  for (int i = 0; i < 7000; ++i) ++counts.at(rng.below(7));
  CHECK(*std::min_element(counts.begin(), counts.end()) > 800);
}

TEST_CASE("shuffling keeps the items") {
  Rng rng(5);
  std::vector<int> items{1, 2, 3, 4, 5, 6, 7, 8};
  rng.shuffle(items);
  CHECK(items != std::vector<int>{1, 2, 3, 4, 5, 6, 7, 8});
  std::sort(items.begin(), items.end());
  CHECK(items == std::vector<int>{1, 2, 3, 4, 5, 6, 7, 8});
}

}  // namespace
}  // namespace hewn
