// Welding on a hash grid, and removal of triangles that span nothing.
#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>

#include "core/mesh/edge_use.h"
#include "core/mesh/repair.h"

namespace hewn {
namespace {

/// Representatives in cells a few tolerances wide, chained per hash bucket. A chain may mix cells:
/// the distance decides, so collisions cost time only.
class WeldGrid {
 public:
  WeldGrid(const std::vector<Vec3>& vertices, const Box3& box, double tolerance)
      : vertices_(vertices), origin_(box.lo), tolerance_(tolerance) {
    cell_ = std::max(4 * tolerance, box.diagonal() * 0x1p-20);
    buckets_.assign(std::bit_ceil(vertices.size() + 1), -1);
    next_.assign(vertices.size(), -1);
  }

  /// The representative within the tolerance with the lowest index; -1 when there is none.
  int find(const Vec3& p) const {
    const auto lo = cell_of(p - Vec3::Constant(tolerance_));
    const auto hi = cell_of(p + Vec3::Constant(tolerance_));
    int best = -1;
    for (std::int64_t x = lo[0]; x <= hi[0]; ++x) {
      for (std::int64_t y = lo[1]; y <= hi[1]; ++y) {
        for (std::int64_t z = lo[2]; z <= hi[2]; ++z) best = search(bucket({x, y, z}), p, best);
      }
    }
    return best;
  }

  void add(int vertex) {
    const std::size_t b = bucket(cell_of(vertices_[vertex]));
    next_[vertex] = buckets_[b];
    buckets_[b] = vertex;
  }

 private:
  using Cell = std::array<std::int64_t, 3>;

  Cell cell_of(const Vec3& p) const {
    Cell cell;
    for (int k = 0; k < 3; ++k) {
      cell[k] = static_cast<std::int64_t>(std::floor((p[k] - origin_[k]) / cell_));
    }
    return cell;
  }

  std::size_t bucket(const Cell& cell) const {
    std::uint64_t hash = 0;
    for (const std::int64_t c : cell) {
      hash = (hash ^ static_cast<std::uint64_t>(c)) * 0x9E3779B97F4A7C15ull;
      hash ^= hash >> 29;
    }
    return hash & (buckets_.size() - 1);
  }

  int search(std::size_t bucket, const Vec3& p, int best) const {
    for (int i = buckets_[bucket]; i >= 0; i = next_[i]) {
      const bool is_better = best < 0 || i < best;
      if (is_better && (vertices_[i] - p).squaredNorm() <= tolerance_ * tolerance_) best = i;
    }
    return best;
  }

  const std::vector<Vec3>& vertices_;
  Vec3 origin_;
  double tolerance_;
  double cell_ = 0;
  std::vector<int> buckets_;
  std::vector<int> next_;
};

bool has_repeated_corner(const Triangle& t) { return t[0] == t[1] || t[1] == t[2] || t[2] == t[0]; }

/// The corner across the longest side when the triangle is lower than the tolerance; else -1.
int flat_corner(const Soup& soup, const Triangle& t, double tolerance) {
  int best = 0;
  double longest2 = -1;
  for (int k = 0; k < 3; ++k) {
    const Vec3 side = soup.vertices[t[(k + 2) % 3]] - soup.vertices[t[(k + 1) % 3]];
    if (side.squaredNorm() > longest2) {
      longest2 = side.squaredNorm();
      best = k;
    }
  }
  const Vec3& a = soup.vertices[t[0]];
  const double twice_area = (soup.vertices[t[1]] - a).cross(soup.vertices[t[2]] - a).norm();
  return twice_area <= tolerance * std::sqrt(longest2) ? best : -1;
}

/// The other triangle on the side across from corner `k` of `t`; -1 unless there is exactly one.
int partner_across(const std::vector<EdgeSide>& sides, const std::vector<Triangle>& triangles,
                   int t, int k) {
  const int a = triangles[t][(k + 1) % 3];
  const int b = triangles[t][(k + 2) % 3];
  EdgeSide probe;
  probe.key =
      static_cast<std::uint64_t>(std::min(a, b)) << 32 | static_cast<std::uint64_t>(std::max(a, b));
  int partner = -1;
  for (auto it = std::lower_bound(sides.begin(), sides.end(), probe);
       it != sides.end() && it->key == probe.key; ++it) {
    if (it->triangle() == t) continue;
    if (partner >= 0) return -1;
    partner = it->triangle();
  }
  return partner;
}

constexpr Triangle kGone = {-1, -1, -1};

/// The two triangles that replace a flat one and its partner.
struct Split {
  Triangle first = kGone, second = kGone;
};

/// The partner split at the flat triangle's middle corner `k`. The surface stays closed and moves
/// by less than the tolerance. Both are `kGone` when the two lie back to back.
Split split_partner(const Triangle& flat, int k, const Triangle& partner) {
  const int middle = flat[k];
  for (int j = 0; j < 3; ++j) {
    const int apex = partner[(j + 2) % 3];
    if (apex == flat[(k + 1) % 3] || apex == flat[(k + 2) % 3]) continue;
    if (apex == middle) break;  // the same triangle twice, back to back
    return {{partner[j], middle, apex}, {middle, partner[(j + 1) % 3], apex}};
  }
  return {};
}

struct Flatness {
  int flat = 0;       ///< how many of the two are flat
  double length = 0;  ///< sum of their longest sides
};

Flatness flatness_of(const Soup& soup, const Triangle& s, const Triangle& t, double tolerance) {
  Flatness sum;
  for (const Triangle& triangle : {s, t}) {
    if (triangle == kGone) continue;
    sum.flat += flat_corner(soup, triangle, tolerance) >= 0 ? 1 : 0;
    double longest = 0;
    for (int k = 0; k < 3; ++k) {
      const Vec3 side = soup.vertices[triangle[(k + 1) % 3]] - soup.vertices[triangle[k]];
      longest = std::max(longest, side.norm());
    }
    sum.length += longest;
  }
  return sum;
}

struct FlatTriangle {
  int triangle = 0;
  int corner = 0;  ///< opposite its longest side
};

std::vector<FlatTriangle> flat_triangles(const Soup& soup, double tolerance) {
  std::vector<FlatTriangle> flat;
  for (std::size_t t = 0; t < soup.triangles.size(); ++t) {
    const int k = flat_corner(soup, soup.triangles[t], tolerance);
    if (k >= 0) flat.push_back({static_cast<int>(t), k});
  }
  return flat;
}

/// One round over all triangles; each may take part once. Returns how many splits were made, and
/// adds the flat triangles that they did away with to `removed`.
int split_round(Soup& soup, double tolerance, int& removed) {
  const std::vector<FlatTriangle> flat = flat_triangles(soup, tolerance);
  if (flat.empty()) return 0;
  const std::vector<EdgeSide> sides = sorted_sides(soup.triangles);
  std::vector<char> is_touched(soup.triangles.size(), 0);
  int splits = 0;
  for (const auto& [t, k] : flat) {
    const int partner = partner_across(sides, soup.triangles, t, k);
    if (partner < 0 || is_touched[t] || is_touched[partner]) continue;
    Triangle& own = soup.triangles[t];
    Triangle& other = soup.triangles[partner];
    const Split split = split_partner(own, k, other);
    // Fewer flat ones, or as many with shorter sides: so rows of them cannot pass their middle
    // corners back and forth for ever.
    const Flatness before = flatness_of(soup, own, other, tolerance);
    const Flatness after = flatness_of(soup, split.first, split.second, tolerance);
    const bool is_shorter = after.flat == before.flat && after.length < 0.999 * before.length;
    if (after.flat >= before.flat && !is_shorter) continue;
    own = split.first;
    other = split.second;
    is_touched[t] = is_touched[partner] = 1;
    removed += before.flat - after.flat;
    ++splits;
  }
  std::erase(soup.triangles, kGone);
  return splits;
}

/// Removes flat triangles that have no single neighbour across their longest side: they close
/// nothing that is not open anyway.
int drop_loose_flat(Soup& soup, double tolerance) {
  const std::vector<FlatTriangle> flat = flat_triangles(soup, tolerance);
  if (flat.empty()) return 0;
  const std::vector<EdgeSide> sides = sorted_sides(soup.triangles);
  std::vector<int> loose;
  for (const auto& [t, k] : flat) {
    if (partner_across(sides, soup.triangles, t, k) < 0) loose.push_back(t);
  }
  for (const int t : loose) soup.triangles[t] = kGone;
  std::erase(soup.triangles, kGone);
  return static_cast<int>(loose.size());
}

}  // namespace

void drop_unused_vertices(Soup& soup) {
  std::vector<int> renamed(soup.vertices.size(), -1);
  for (const Triangle& t : soup.triangles) {
    for (const int i : t) renamed[i] = 0;
  }
  int used = 0;
  for (std::size_t i = 0; i < renamed.size(); ++i) {
    if (renamed[i] < 0) continue;
    soup.vertices[used] = soup.vertices[i];
    renamed[i] = used++;
  }
  soup.vertices.resize(used);
  for (Triangle& t : soup.triangles) {
    for (int& i : t) i = renamed[i];
  }
}

int weld_vertices(Soup& soup, double tolerance) {
  Box3 box;
  for (const Vec3& p : soup.vertices) box.extend(p);
  WeldGrid grid(soup.vertices, box, tolerance);
  std::vector<int> kept(soup.vertices.size());
  int welded = 0;
  for (std::size_t i = 0; i < soup.vertices.size(); ++i) {
    const int found = grid.find(soup.vertices[i]);
    kept[i] = found >= 0 ? found : static_cast<int>(i);
    if (found >= 0) ++welded;
    if (found < 0) grid.add(static_cast<int>(i));
  }
  for (Triangle& t : soup.triangles) {
    for (int& i : t) i = kept[i];
  }
  drop_unused_vertices(soup);
  return welded;
}

int remove_zero_area(Soup& soup, double tolerance) {
  int removed = static_cast<int>(std::erase_if(soup.triangles, has_repeated_corner));
  // Rows of several vertices take several rounds: they are peeled from outside.
  constexpr int kRounds = 100;
  for (int round = 0; round < kRounds; ++round) {
    if (split_round(soup, tolerance, removed) == 0) break;
  }
  removed += drop_loose_flat(soup, tolerance * 1e-3);
  drop_unused_vertices(soup);
  return removed;
}

}  // namespace hewn
