#include "core/mesh/edge_use.h"

#include <algorithm>

namespace hewn {

std::vector<EdgeSide> sorted_sides(std::span<const Triangle> triangles) {
  std::vector<EdgeSide> sides;
  sides.reserve(triangles.size() * 3);
  for (std::uint32_t t = 0; t < triangles.size(); ++t) {
    for (std::uint32_t k = 0; k < 3; ++k) {
      const int a = triangles[t][k];
      const int b = triangles[t][(k + 1) % 3];
      const auto low = static_cast<std::uint64_t>(std::min(a, b));
      const auto high = static_cast<std::uint64_t>(std::max(a, b));
      sides.push_back({low << 32 | high, (3 * t + k) << 1 | (a > b ? 1u : 0u)});
    }
  }
  std::sort(sides.begin(), sides.end());
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
