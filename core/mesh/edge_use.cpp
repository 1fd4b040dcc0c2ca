#include "core/mesh/edge_use.h"

#include <algorithm>

namespace hewn {

std::vector<EdgeSide> sorted_sides(std::span<const Triangle> triangles) {
  int vertices = 0;
  for (const Triangle& t : triangles) vertices = std::max({vertices, t[0] + 1, t[1] + 1, t[2] + 1});
  // By the lower vertex with a counting sort, then within each vertex's few sides: several times
  // faster than sorting millions of sides at once.
  std::vector<std::uint32_t> first(static_cast<std::size_t>(vertices) + 1, 0);
  for (const Triangle& t : triangles) {
    for (int k = 0; k < 3; ++k) ++first[std::min(t[k], t[(k + 1) % 3]) + 1];
  }
  for (std::size_t v = 1; v < first.size(); ++v) first[v] += first[v - 1];
  std::vector<EdgeSide> sides(triangles.size() * 3);
  std::vector<std::uint32_t> next(first.begin(), first.end() - 1);
  for (std::uint32_t t = 0; t < triangles.size(); ++t) {
    for (std::uint32_t k = 0; k < 3; ++k) {
      const int a = triangles[t][k];
      const int b = triangles[t][(k + 1) % 3];
      const auto low = static_cast<std::uint64_t>(std::min(a, b));
      const auto high = static_cast<std::uint64_t>(std::max(a, b));
      sides[next[low]++] = {low << 32 | high, (3 * t + k) << 1 | (a > b ? 1u : 0u)};
    }
  }
  for (std::size_t v = 0; v + 1 < first.size(); ++v) {
    std::sort(sides.begin() + first[v], sides.begin() + first[v + 1]);
  }
  return sides;
}

EdgeUse classify_edge_use(std::span<const Triangle> triangles) {
  EdgeUse use;
  const std::vector<EdgeSide> sides = sorted_sides(triangles);
  for_each_edge(sides, [&](std::span<const EdgeSide> edge) {
    if (edge.size() == 1) ++use.boundary_edges;
    if (edge.size() > 2) ++use.non_manifold_edges;
    if (edge.size() % 2 != 0) use.is_closed = false;
    int balance = 0;
    for (const EdgeSide& side : edge) balance += side.is_reversed() ? -1 : 1;
    if (edge.size() > 1 && edge.size() % 2 == 0 && balance != 0) use.is_oriented = false;
  });
  return use;
}

}  // namespace hewn
