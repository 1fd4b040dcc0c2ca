#include <algorithm>

#include "core/base/counted.h"
#include "core/mesh/raw_mesh.h"

namespace hewn {
namespace {

/// Beyond this many corners ear clipping (quadratic) gives way to a fan.
constexpr std::size_t kMaxEarCorners = 4096;

double cross2(const Vec2& a, const Vec2& b, const Vec2& c) {
  return (b.x() - a.x()) * (c.y() - a.y()) - (b.y() - a.y()) * (c.x() - a.x());
}

bool is_inside(const Vec2& p, const Vec2& a, const Vec2& b, const Vec2& c) {
  return cross2(a, b, p) >= 0 && cross2(b, c, p) >= 0 && cross2(c, a, p) >= 0;
}

/// The polygon seen along its mean normal (Newell), counter-clockwise.
std::vector<Vec2> flatten(const std::vector<Vec3>& vertices, const std::vector<int>& loop) {
  Vec3 normal = Vec3::Zero();
  const Vec3& origin = vertices[loop[0]];
  for (std::size_t i = 0; i < loop.size(); ++i) {
    const Vec3 a = vertices[loop[i]] - origin;
    normal += a.cross(vertices[loop[(i + 1) % loop.size()]] - origin);
  }
  const auto [u, w] = tangents(normal.norm() > 0 ? Vec3(normal.normalized()) : Vec3(Vec3::UnitZ()));
  std::vector<Vec2> flat;
  flat.reserve(loop.size());
  for (const int i : loop) {
    const Vec3 d = vertices[i] - origin;
    flat.emplace_back(u.dot(d), w.dot(d));
  }
  return flat;
}

/// The position in `left` of the best ear: convex, empty, and the widest such.
std::size_t find_ear(const std::vector<Vec2>& flat, const std::vector<int>& left) {
  const std::size_t n = left.size();
  std::size_t best = 0;
  double best_quality = -kInfinity;
  for (std::size_t i = 0; i < n; ++i) {
    const int before = left[(i + n - 1) % n];
    const int after = left[(i + 1) % n];
    const Vec2& a = flat[before];
    const Vec2& b = flat[left[i]];
    const Vec2& c = flat[after];
    const double area = cross2(a, b, c);
    const double longest2 =
        std::max({(b - a).squaredNorm(), (c - b).squaredNorm(), (a - c).squaredNorm()});
    double quality = longest2 > 0 ? area / longest2 : 0;
    const bool is_blocked = quality > 0 && std::any_of(left.begin(), left.end(), [&](int k) {
                              if (k == before || k == left[i] || k == after) return false;
                              return is_inside(flat[k], a, b, c);
                            });
    if (is_blocked) quality -= 10;  // only when nothing better is left (self-crossing polygons)
    if (quality > best_quality) {
      best_quality = quality;
      best = i;
    }
    if (n > 64 && best_quality > 0.05) break;  // long polygons: good enough beats quadratic
  }
  return best;
}

}  // namespace

void warn_of_skipped_faces(int count, RawMesh& mesh) {
  if (count == 0) return;
  mesh.warnings.push_back(
      counted(count, "face with fewer than 3 corners was", "faces with fewer than 3 corners were") +
      " left out.");
}

int triangulate_polygon(const std::vector<Vec3>& vertices, const std::vector<int>& loop,
                        std::vector<Triangle>& out) {
  const int count = static_cast<int>(loop.size()) - 2;
  if (loop.size() == 3) {
    out.push_back({loop[0], loop[1], loop[2]});
    return count;
  }
  if (loop.size() > kMaxEarCorners) {
    for (std::size_t i = 2; i < loop.size(); ++i) out.push_back({loop[0], loop[i - 1], loop[i]});
    return count;
  }
  const std::vector<Vec2> flat = flatten(vertices, loop);
  std::vector<int> left(loop.size());
  for (std::size_t i = 0; i < loop.size(); ++i) left[i] = static_cast<int>(i);
  while (left.size() > 3) {
    const std::size_t i = find_ear(flat, left);
    const std::size_t n = left.size();
    out.push_back({loop[left[(i + n - 1) % n]], loop[left[i]], loop[left[(i + 1) % n]]});
    left.erase(left.begin() + static_cast<std::ptrdiff_t>(i));
  }
  out.push_back({loop[left[0]], loop[left[1]], loop[left[2]]});
  return count;
}

}  // namespace hewn
