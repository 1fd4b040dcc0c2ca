#pragma once
/// Which triangle sides share an edge: the one pass over sorted sides that welding, orientation and
/// checks build on. Lighter than `build_edges` on millions of triangles.
#include <cstdint>
#include <span>
#include <vector>

#include "core/mesh/mesh.h"

namespace hewn {

/// One side of a triangle as a sortable key.
struct EdgeSide {
  std::uint64_t key = 0;   ///< lower vertex << 32 | higher vertex
  std::uint32_t side = 0;  ///< 3 * triangle + corner << 1 | 1 when it runs from higher to lower

  int triangle() const { return static_cast<int>((side >> 1) / 3); }
  int corner() const { return static_cast<int>((side >> 1) % 3); }
  bool is_reversed() const { return (side & 1) != 0; }
  int low() const { return static_cast<int>(key >> 32); }
  int high() const { return static_cast<int>(key & 0xFFFFFFFFu); }
  bool operator<(const EdgeSide& other) const {
    return key != other.key ? key < other.key : side < other.side;
  }
};

/// All sides, sorted, so that the sides of one edge are neighbours. Cost: O(n log n).
/// Requires: fewer than 2^31 / 3 triangles.
std::vector<EdgeSide> sorted_sides(std::span<const Triangle> triangles);

/// Calls `visit(begin, end)` for the sides of every edge in turn.
template <class Visit>
void for_each_edge(std::span<const EdgeSide> sides, const Visit& visit) {
  for (std::size_t begin = 0; begin < sides.size();) {
    std::size_t end = begin + 1;
    while (end < sides.size() && sides[end].key == sides[begin].key) ++end;
    visit(sides.subspan(begin, end - begin));
    begin = end;
  }
}

struct EdgeUse {
  bool is_closed = true;    ///< every edge has an even number of sides
  bool is_oriented = true;  ///< at every edge with several sides, both directions occur alike
  int boundary_edges = 0;
  int non_manifold_edges = 0;  ///< more than two sides
};
EdgeUse classify_edge_use(std::span<const Triangle> triangles);

}  // namespace hewn
