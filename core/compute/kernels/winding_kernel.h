#pragma once
/// Inside tests on a mesh: winding numbers from the triangles above each point.
#include "core/compute/kernels/plain_vec.h"

namespace hewn {

enum class Inside : std::uint8_t {
  No,
  Yes,
  Unsure  ///< the ray upwards passes an edge, or begins on the surface, to within rounding
};

/// A triangle in the frame of `WindingKernel`.
struct RaisedTriangle {
  PlainVec a, b, c;
};

/// A box of triangles that is open downwards, in the frame of `WindingKernel`. Boxes lie in depth
/// first order: a node's first child follows it.
struct ShadowNode {
  float low_x = 0, high_x = 0, low_y = 0, high_y = 0, high_z = 0;
  std::int32_t next = 0;            ///< the node to go on with where this one is of no interest
  std::int32_t first_triangle = 0;  ///< of a leaf
  std::int32_t triangles = 0;       ///< 0: not a leaf
};

/// Which points lie inside, by the signed crossings of the ray upwards from each. All is in a frame
/// in which the mesh has about unit size and its faces and edges seldom stand upright, so that the
/// ray is x and y alone. One item is one point.
///
/// Cost: O(log triangles + triangles above the point). The same bits on every device.
struct WindingKernel {
  const PlainVec* points = nullptr;  ///< in the mesh's own frame
  std::int64_t point_count = 0;
  PlainVec center;             ///< of the frame
  PlainVec across, along, up;  ///< the frame's axes, divided by its unit
  const ShadowNode* nodes = nullptr;
  std::int32_t node_count = 0;
  const RaisedTriangle* triangles = nullptr;
  bool is_oriented = true;   ///< else every second crossing changes sides
  Inside* inside = nullptr;  ///< out

  /// Coordinates are about 1, hence the areas' rounding errors some 1e-16.
  static constexpr double kAreaMargin = 1e-14;
  static constexpr double kHeightMargin = 1e-9;

  template <class Grain>
  HEWN_HD std::int64_t items() const {
    return point_count;
  }

  template <class Grain>
  HEWN_HD void run(std::int64_t item) const {
    const PlainVec offset = points[item] - center;
    const PlainVec p{dot(across, offset), dot(along, offset), dot(up, offset)};
    int winding = 0;
    bool is_sure = true;
    for (std::int32_t n = 0; n < node_count;) {
      const ShadowNode& node = nodes[n];
      if (!is_above(node, p)) {
        n = node.next;
        continue;
      }
      for (std::int32_t t = 0; t < node.triangles; ++t) {
        winding += crossing(triangles[node.first_triangle + t], p, is_sure);
      }
      ++n;
    }
    const bool is_inside = is_oriented ? winding > 0 : (winding & 1) != 0;
    inside[item] = !is_sure ? Inside::Unsure : is_inside ? Inside::Yes : Inside::No;
  }

 private:
  static HEWN_HD bool is_above(const ShadowNode& node, const PlainVec& p) {
    return node.low_x <= p.x && p.x <= node.high_x && node.low_y <= p.y && p.y <= node.high_y &&
           p.z <= node.high_z;
  }

  /// 1 where the ray leaves the solid through the triangle, -1 where it enters, 0 where it passes
  /// by.
  static HEWN_HD int crossing(const RaisedTriangle& t, const PlainVec& p, bool& is_sure) {
    const PlainVec a = t.a - p;
    const PlainVec b = t.b - p;
    const PlainVec c = t.c - p;
    const double of_a = b.x * c.y - b.y * c.x;
    const double of_b = c.x * a.y - c.y * a.x;
    const double of_c = a.x * b.y - a.y * b.x;
    const double least = fmin(of_a, fmin(of_b, of_c));
    const double most = fmax(of_a, fmax(of_b, of_c));
    if (least < -kAreaMargin && most > kAreaMargin) return 0;
    const double area = of_a + of_b + of_c;
    const double volume = of_a * a.z + of_b * b.z + of_c * c.z;
    // The triangle's height above the point is volume / area.
    const double margin = kHeightMargin * fabs(area) + kAreaMargin;
    const double side = area < 0 ? -volume : volume;
    if (side < -margin) return 0;
    if (side <= margin || (least <= kAreaMargin && most >= -kAreaMargin)) is_sure = false;
    return area > 0 ? 1 : -1;
  }
};

}  // namespace hewn
