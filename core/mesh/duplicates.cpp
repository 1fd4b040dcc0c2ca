// Triangles that are there more than once.
#include <algorithm>
#include <span>

#include "core/mesh/edge_use.h"
#include "core/mesh/index_groups.h"
#include "core/mesh/repair.h"

namespace hewn {
namespace {

constexpr Triangle kGone = {-1, -1, -1};

struct Copy {
  Triangle corners;  ///< ascending
  int triangle;
  auto operator<=>(const Copy&) const = default;
};

/// Sorted, so that copies are neighbours.
std::vector<Copy> sorted_copies(const std::vector<Triangle>& triangles) {
  std::vector<Copy> copies;
  copies.reserve(triangles.size());
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    Triangle corners = triangles[t];
    std::sort(corners.begin(), corners.end());
    copies.push_back({corners, static_cast<int>(t)});
  }
  std::sort(copies.begin(), copies.end());
  return copies;
}

template <class Visit>
void for_each_duplicate(std::span<const Copy> copies, const Visit& visit) {
  for (std::size_t begin = 0, end = 0; begin < copies.size(); begin = end) {
    for (end = begin + 1; end < copies.size() && copies[end].corners == copies[begin].corners;) {
      ++end;
    }
    if (end - begin > 1) visit(copies.subspan(begin, end - begin));
  }
}

/// Whether two triangles on one edge have the same third corner.
bool has_copies(const std::vector<Triangle>& triangles, std::span<const EdgeSide> sides) {
  bool has_any = false;
  std::vector<int> corners;
  for_each_edge(sides, [&](std::span<const EdgeSide> edge) {
    if (edge.size() < 2 || has_any) return;
    corners.clear();
    for (const EdgeSide& side : edge) {
      corners.push_back(triangles[side.triangle()][(side.corner() + 2) % 3]);
    }
    std::sort(corners.begin(), corners.end());
    has_any = std::adjacent_find(corners.begin(), corners.end()) != corners.end();
  });
  return has_any;
}

/// Per triangle: whether the whole connected part that it belongs to is there more than once.
std::vector<char> in_doubled_parts(std::size_t count, std::span<const Copy> copies,
                                   std::span<const EdgeSide> sides) {
  IndexGroups parts(count);
  for_each_edge(sides, [&](std::span<const EdgeSide> edge) {
    for (const EdgeSide& side : edge) parts.join(edge[0].triangle(), side.triangle());
  });
  std::vector<char> is_duplicate(count, 0);
  for_each_duplicate(copies, [&](std::span<const Copy> same) {
    for (const Copy& copy : same) is_duplicate[copy.triangle] = 1;
  });
  std::vector<char> is_doubled(count, 1);
  for (int t = 0; t < static_cast<int>(count); ++t) {
    if (is_duplicate[t] == 0) is_doubled[parts.root(t)] = 0;
  }
  for (int t = 0; t < static_cast<int>(count); ++t) is_doubled[t] = is_doubled[parts.root(t)];
  return is_doubled;
}

/// Whether the edges need one of the copies to be closed.
bool closes_edges(std::span<const Copy> same, std::span<const EdgeSide> sides) {
  const Triangle& c = same.front().corners;
  int odd_edges = 0;
  for (int k = 0; k < 3; ++k) {
    EdgeSide probe;
    probe.key = static_cast<std::uint64_t>(std::min(c[k], c[(k + 1) % 3])) << 32 |
                static_cast<std::uint64_t>(std::max(c[k], c[(k + 1) % 3]));
    auto it = std::lower_bound(sides.begin(), sides.end(), probe);
    std::size_t uses = 0;
    for (; it != sides.end() && it->key == probe.key; ++it) ++uses;
    odd_edges += (uses - same.size()) % 2 != 0 ? 1 : 0;
  }
  return odd_edges >= 2;
}

}  // namespace

int remove_duplicates(Soup& soup, std::span<const EdgeSide> sides) {
  if (!has_copies(soup.triangles, sides)) return 0;
  const std::vector<Copy> copies = sorted_copies(soup.triangles);
  const std::vector<char> is_doubled = in_doubled_parts(soup.triangles.size(), copies, sides);
  int removed = 0;
  for_each_duplicate(copies, [&](std::span<const Copy> same) {
    // A sheet within the solid goes whole.
    const bool keeps_one =
        same.size() % 2 != 0 || is_doubled[same.front().triangle] != 0 || closes_edges(same, sides);
    for (const Copy& copy : same.subspan(keeps_one ? 1 : 0)) {
      soup.triangles[copy.triangle] = kGone;
      ++removed;
    }
  });
  std::erase(soup.triangles, kGone);
  drop_unused_vertices(soup);
  return removed;
}

}  // namespace hewn
