#include "core/compute/parallel.h"

#include <atomic>
#include <stdexcept>
#include <vector>

#include <doctest/doctest.h>

namespace hewn {
namespace {

TEST_CASE("every index is visited once, whatever the threads and the grain") {
  for (const int threads : {0, 1, 2, 8}) {
    for (const std::size_t grain : {0, 1, 7, 1000}) {
      std::vector<int> visits(501, 0);
      for_each_index(
          threads, visits.size(), [&](std::size_t i) { ++visits[i]; }, grain);
      CHECK(visits == std::vector<int>(501, 1));
    }
  }
}

TEST_CASE("chunks are never longer than the grain") {
  std::atomic<std::size_t> longest{0};
  for_each_chunk(4, 1000, 64, [&](std::size_t begin, std::size_t end) {
    std::size_t seen = longest;
    while (end - begin > seen && !longest.compare_exchange_weak(seen, end - begin)) {
    }
  });
  CHECK(longest <= 64);
  CHECK(longest > 0);
}

TEST_CASE("an exception of a body reaches the caller") {
  const auto throwing = [](std::size_t i) {
    if (i == 40) throw std::runtime_error("stop");
  };
  CHECK_THROWS_AS(for_each_index(1, 100, throwing), std::runtime_error);
  CHECK_THROWS_AS(for_each_index(4, 100, throwing), std::runtime_error);
}

TEST_CASE("nothing is called for an empty range") {
  bool was_called = false;
  for_each_chunk(2, 0, 16, [&](std::size_t, std::size_t) { was_called = true; });
  CHECK(!was_called);
}

}  // namespace
}  // namespace hewn
