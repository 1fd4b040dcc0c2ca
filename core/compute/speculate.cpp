#include "core/compute/speculate.h"

#include <algorithm>
#include <atomic>

#include <tbb/parallel_for.h>

#include "core/compute/arena.h"
#include "core/compute/fork_join.h"
#include "core/compute/parallel.h"

namespace hewn {
namespace {

/// More are seldom all in vain, and seldom of use.
constexpr std::size_t kWidest = 8;

}  // namespace

std::size_t speculation_width(int threads) {
  return std::min(static_cast<std::size_t>(worker_count(threads)), kWidest);
}

std::size_t first_success(int threads, std::size_t n,
                          const std::function<bool(std::size_t)>& attempt) {
  if (threads == 1 || n < 2) {
    std::size_t i = 0;
    while (i < n && !attempt(i)) ++i;
    return i;
  }
  std::atomic<std::size_t> first{n};
  ForkJoin order;
  const auto make = [&](std::size_t i) {
    order.begin();
    if (first.load() >= i && attempt(i)) {
      std::size_t known = first.load();
      while (i < known && !first.compare_exchange_weak(known, i)) {
      }
    }
    order.end();
  };
  const auto all = [&] { tbb::parallel_for(std::size_t{0}, n, make, tbb::simple_partitioner()); };
  // Isolated: who waits for the rest must not begin with something long in the meantime.
  order.fork();
  in_arena(threads, [&all] { tbb::this_task_arena::isolate(all); });
  order.join();
  return first.load();
}

}  // namespace hewn
