#include "core/compute/first_loops.h"

#include <algorithm>
#include <vector>

#include <doctest/doctest.h>

#include "core/compute/parallel.h"
#include "tests/core/compute/begin_threads.h"

namespace hewn {
namespace {

TEST_CASE("what a loop does alone are its first ranges, and a loop goes on where they end") {
  std::vector<int> visits(100, 0);
  std::size_t longest = 0;
  const auto visit = [&](std::size_t begin, std::size_t end) {
    longest = std::max(longest, end - begin);
    for (std::size_t i = begin; i < end; ++i) ++visits[i];
  };
  const std::size_t done = begin_alone(visits.size(), 7, visit);
  CHECK(longest <= 7);
  for (std::size_t i = 0; i < visits.size(); ++i) CHECK(visits[i] == (i < done ? 1 : 0));
  for_each_chunk(2, visits.size() - done, 7, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = done + begin; i < done + end; ++i) ++visits[i];
  });
  CHECK(visits == std::vector<int>(100, 1));
}

TEST_CASE("nothing is done alone once the loops have taken as long as threads take to begin") {
  begin_threads();
  bool was_called = false;
  CHECK(begin_alone(10, 1, [&](std::size_t, std::size_t) { was_called = true; }) == 0);
  CHECK_FALSE(was_called);
}

}  // namespace
}  // namespace hewn
