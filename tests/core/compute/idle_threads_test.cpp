#include "core/compute/idle_threads.h"

#include <atomic>
#include <vector>

#include <doctest/doctest.h>

#include "core/compute/busy_threads.h"
#include "core/compute/parallel.h"
#include "tests/core/compute/begin_threads.h"

namespace hewn {
namespace {

TEST_CASE("every index is visited once, by workers that do one thing at a time") {
  begin_threads();
  for (const int threads : {0, 1, 2, 8}) {
    const std::size_t workers = idle_workers(threads);
    std::vector<std::atomic<int>> visits(100);
    std::vector<std::atomic<int>> busy(workers);
    std::atomic<bool> is_shared{false};
    for_each_with_idle(threads, workers, visits.size(), [&](std::size_t worker, std::size_t i) {
      if (busy[worker]++ != 0) is_shared = true;
      ++visits[i];
      --busy[worker];
    });
    CHECK_FALSE(is_shared);
    for (const auto& count : visits) CHECK(count == 1);
  }
}

TEST_CASE("such loops lie in bodies of others, and others in theirs") {
  begin_threads();
  std::vector<std::atomic<int>> visits(20);
  for_each_index(4, visits.size(), [&](std::size_t i) {
    for_each_with_idle(4, idle_workers(4), 30, [&](std::size_t, std::size_t) {
      for_each_index(4, 50, [&](std::size_t) { ++visits[i]; });
    });
  });
  for (const auto& count : visits) CHECK(count == 1500);
}

TEST_CASE("nothing longer is begun while the loop's end is waited for") {
  begin_threads();
  // A body of the outer loop that began within another one would find itself on the same thread.
  std::atomic<int> nested{0};
  thread_local bool is_inside = false;
  for_each_index(2, 40, [&](std::size_t) {
    if (is_inside) ++nested;
    is_inside = true;
    for (int k = 0; k < 50; ++k) {
      for_each_with_idle(2, idle_workers(2), 4, [](std::size_t, std::size_t) {});
    }
    is_inside = false;
  });
  CHECK(nested == 0);
}

TEST_CASE("a thread in the bodies of several loops is one busy thread") {
  begin_threads();
  CHECK(BusyThread::count() == 0);
  std::atomic<bool> is_counted{true};
  for_each_index(2, 40, [&](std::size_t) {
    for_each_index(2, 10, [&](std::size_t) {
      if (BusyThread::count() < 1 || BusyThread::count() > 2) is_counted = false;
    });
  });
  CHECK(is_counted);
  CHECK(BusyThread::count() == 0);
}

TEST_CASE("there is at least one worker, and no more than are of use") {
  CHECK(idle_workers(1) == 1);
  CHECK(idle_workers(0) >= 1);
  CHECK(idle_workers(1000) <= 8);
}

}  // namespace
}  // namespace hewn
