#include "core/compute/speculate.h"

#include <atomic>
#include <vector>

#include <doctest/doctest.h>

#include "core/compute/parallel.h"

namespace hewn {
namespace {

TEST_CASE("the first success is found and everything before it was tried") {
  for (const int threads : {0, 1, 2, 8}) {
    for (const std::size_t wanted : {0, 1, 5, 9}) {
      std::vector<std::atomic<int>> tries(9);
      const std::size_t found = first_success(threads, tries.size(), [&](std::size_t i) {
        ++tries[i];
        return i >= wanted && i != 7;
      });
      CHECK(found == wanted);
      for (std::size_t i = 0; i < tries.size(); ++i) {
        CHECK(tries[i] <= 1);
        if (i <= found) CHECK(tries[i] == 1);
      }
    }
  }
}

TEST_CASE("one thread makes no attempt in vain") {
  int tries = 0;
  CHECK(first_success(1, 100, [&](std::size_t i) { return ++tries, i == 3; }) == 3);
  CHECK(tries == 4);
}

TEST_CASE("loops may hold attempts and attempts may hold loops") {
  std::vector<std::size_t> found(20);
  for_each_index(4, found.size(), [&](std::size_t i) {
    found[i] = first_success(4, 30, [&](std::size_t k) {
      std::vector<int> visits(50, 0);
      for_each_index(4, visits.size(), [&](std::size_t v) { ++visits[v]; });
      return visits == std::vector<int>(50, 1) && k == i;
    });
  });
  for (std::size_t i = 0; i < found.size(); ++i) CHECK(found[i] == i);
}

TEST_CASE("the width follows the threads, and is at least one") {
  CHECK(speculation_width(1) == 1);
  CHECK(speculation_width(0) >= 1);
  CHECK(speculation_width(1000) <= 8);
}

}  // namespace
}  // namespace hewn
