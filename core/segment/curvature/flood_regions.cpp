#include "core/segment/curvature/flood_regions.h"

#include <algorithm>
#include <atomic>

#include "core/compute/parallel.h"

namespace hewn {

Result<std::vector<int>> flood_regions(const TriangleTopology& topology,
                                       const Boundaries& boundaries,
                                       const std::vector<CurvatureClass>& classes,
                                       const RunContext& run) {
  constexpr std::size_t kGrain = 4096;
  std::vector<int> labels(classes.size());
  for (std::size_t t = 0; t < labels.size(); ++t) {
    labels[t] = classes[t] == CurvatureClass::None ? -1 : static_cast<int>(t);
  }
  std::vector<int> next = labels;
  const auto lowest_around = [&](int t) {
    int label = labels[t];
    for (int k = 0; k < 3; ++k) {
      const int other = topology.neighbors[t][k];
      if (boundaries.is_marked[t][k] || other < 0 || classes[other] != classes[t]) continue;
      label = std::min(label, labels[other]);
    }
    return std::min(label, labels[label]);
  };
  std::atomic<bool> has_changed = true;
  while (has_changed) {
    if (run.is_cancelled()) return RunContext::cancelled();
    has_changed = false;
    for_each_chunk(run.threads, labels.size(), kGrain, [&](std::size_t begin, std::size_t end) {
      for (std::size_t t = begin; t < end; ++t) {
        next[t] = labels[t] < 0 ? -1 : lowest_around(static_cast<int>(t));
        if (next[t] != labels[t]) has_changed.store(true, std::memory_order_relaxed);
      }
    });
    labels.swap(next);
  }
  return labels;
}

}  // namespace hewn
