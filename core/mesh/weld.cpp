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

/// Drops vertices that no triangle uses.
void compact(Soup& soup) {
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

/// Splits the partner of flat triangle `t` at the flat triangle's middle corner; `t` becomes one
/// half. The surface stays closed and moves by less than the tolerance.
bool split_partner(std::vector<Triangle>& triangles, int t, int k, int partner) {
  const int middle = triangles[t][k];
  const int a = triangles[t][(k + 1) % 3];
  const int b = triangles[t][(k + 2) % 3];
  const Triangle old = triangles[partner];
  for (int j = 0; j < 3; ++j) {
    const int from = old[j];
    const int to = old[(j + 1) % 3];
    if (std::min(from, to) != std::min(a, b) || std::max(from, to) != std::max(a, b)) continue;
    const int apex = old[(j + 2) % 3];
    if (apex == middle) {  // the same triangle twice, back to back
      triangles[t] = triangles[partner] = kGone;
      return true;
    }
    triangles[partner] = {from, middle, apex};
    triangles[t] = {middle, to, apex};
    return true;
  }
  return false;
}

/// One round over all triangles; each may take part once. Returns how many flat ones went.
int split_round(Soup& soup, double tolerance) {
  std::vector<std::pair<int, int>> flat;
  for (std::size_t t = 0; t < soup.triangles.size(); ++t) {
    const int k = flat_corner(soup, soup.triangles[t], tolerance);
    if (k >= 0) flat.emplace_back(static_cast<int>(t), k);
  }
  if (flat.empty()) return 0;
  const std::vector<EdgeSide> sides = sorted_sides(soup.triangles);
  std::vector<char> is_touched(soup.triangles.size(), 0);
  int resolved = 0;
  for (const auto& [t, k] : flat) {
    const int partner = partner_across(sides, soup.triangles, t, k);
    if (partner < 0 || is_touched[t] || is_touched[partner]) continue;
    if (!split_partner(soup.triangles, t, k, partner)) continue;
    is_touched[t] = is_touched[partner] = 1;
    ++resolved;
  }
  std::erase(soup.triangles, kGone);
  return resolved;
}

}  // namespace

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
  compact(soup);
  return welded;
}

int remove_zero_area(Soup& soup, double tolerance) {
  int removed = static_cast<int>(std::erase_if(soup.triangles, has_repeated_corner));
  // A split may leave another flat triangle (several vertices in one row): a few rounds settle it.
  constexpr int kRounds = 12;
  for (int round = 0; round < kRounds; ++round) {
    const int resolved = split_round(soup, tolerance);
    removed += resolved;
    if (resolved == 0) break;
  }
  // What is left has no single neighbour to split. Only the truly flat ones go.
  removed += static_cast<int>(std::erase_if(soup.triangles, [&](const Triangle& t) {
    return flat_corner(soup, t, tolerance * 1e-3) >= 0;
  }));
  compact(soup);
  return removed;
}

int remove_duplicates(Soup& soup) {
  struct Key {
    Triangle corners;
    int triangle;
    auto operator<=>(const Key&) const = default;
  };
  std::vector<Key> keys;
  keys.reserve(soup.triangles.size());
  for (std::size_t t = 0; t < soup.triangles.size(); ++t) {
    Triangle corners = soup.triangles[t];
    std::sort(corners.begin(), corners.end());
    keys.push_back({corners, static_cast<int>(t)});
  }
  std::sort(keys.begin(), keys.end());
  std::vector<EdgeSide> sides;  // made only when there is a duplicate
  int removed = 0;
  for (std::size_t begin = 0, end = 0; begin < keys.size(); begin = end) {
    for (end = begin + 1; end < keys.size() && keys[end].corners == keys[begin].corners;) ++end;
    const int copies = static_cast<int>(end - begin);
    if (copies == 1) continue;
    if (sides.empty()) sides = sorted_sides(soup.triangles);
    // One copy stays where its edges need it to be closed; a sheet within the solid goes whole.
    int odd_edges = 0;
    for (int k = 0; k < 3; ++k) {
      EdgeSide probe;
      const Triangle& c = keys[begin].corners;
      probe.key = static_cast<std::uint64_t>(std::min(c[k], c[(k + 1) % 3])) << 32 |
                  static_cast<std::uint64_t>(std::max(c[k], c[(k + 1) % 3]));
      auto it = std::lower_bound(sides.begin(), sides.end(), probe);
      int uses = 0;
      for (; it != sides.end() && it->key == probe.key; ++it) ++uses;
      odd_edges += (uses - copies) % 2 != 0 ? 1 : 0;
    }
    const bool keeps_one = odd_edges >= 2 || copies % 2 != 0;
    for (std::size_t i = begin + (keeps_one ? 1 : 0); i < end; ++i) {
      soup.triangles[keys[i].triangle] = kGone;
      ++removed;
    }
  }
  std::erase(soup.triangles, kGone);
  compact(soup);
  return removed;
}

}  // namespace hewn
