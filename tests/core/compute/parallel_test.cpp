#include "core/compute/parallel.h"

#include <atomic>
#include <stdexcept>
#include <vector>

#include <doctest/doctest.h>

#include "tests/core/compute/begin_threads.h"

namespace hewn {
namespace {

TEST_CASE("every index is visited once, whatever the threads and the grain") {
  begin_threads();
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
  begin_threads();
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
  begin_threads();
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

TEST_CASE("a worker does one thing at a time, and together they do all") {
  begin_threads();
  for (const int threads : {1, 2, 8}) {
    const auto workers = static_cast<std::size_t>(worker_count(threads));
    std::vector<std::atomic<int>> busy(workers);
    std::vector<std::atomic<int>> visits(500);
    std::atomic<bool> is_shared{false};
    for_each_with_worker(threads, workers, visits.size(), [&](std::size_t worker, std::size_t i) {
      if (busy[worker]++ != 0) is_shared = true;
      ++visits[i];
      --busy[worker];
    });
    CHECK_FALSE(is_shared);
    for (const auto& count : visits) CHECK(count == 1);
  }
  CHECK(worker_count(1) == 1);
  CHECK(worker_count(0) >= worker_count(2));
}

}  // namespace
}  // namespace hewn
