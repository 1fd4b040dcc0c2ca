// Two triangles cross exactly when a side of one passes through the other: every edge is cast as a
// short ray.
#include <algorithm>
#include <set>
#include <utility>

#include "core/mesh/edge_use.h"
#include "core/mesh/query.h"
#include "core/mesh/repair.h"

namespace hewn {
namespace {

/// Big meshes get this many edges tried, evenly spread over the list.
constexpr std::size_t kMaxEdges = 300'000;

bool shares_vertex(const Triangle& t, int a, int b) {
  return std::any_of(t.begin(), t.end(), [&](int i) { return i == a || i == b; });
}

/// Whether segment ab passes through the triangle, by more than `margin` on both sides of its
/// plane: touching and rounding do not count.
bool passes_through(const Mesh& mesh, int triangle, const Vec3& a, const Vec3& b, double margin) {
  const Vec3& normal = mesh.normals[triangle];
  const Vec3 p = mesh.corner(triangle, 0);
  const double da = normal.dot(a - p);
  const double db = normal.dot(b - p);
  if (!(std::min(da, db) < -margin && std::max(da, db) > margin)) return false;
  const Vec3 x = a + (b - a) * (da / (da - db));
  for (int k = 0; k < 3; ++k) {
    const Vec3 from = mesh.corner(triangle, k);
    const Vec3 side = mesh.corner(triangle, (k + 1) % 3) - from;
    if (normal.cross(side).dot(x - from) < 0) return false;
  }
  return true;
}

}  // namespace

Result<int> count_self_intersections(const Mesh& mesh, std::span<const EdgeSide> sides, int limit,
                                     const RunContext& run) {
  const double margin = 2e-6 * mesh.diagonal();
  const MeshQuery query(std::shared_ptr<const Mesh>(std::shared_ptr<void>(), &mesh));
  const std::size_t stride = std::max<std::size_t>(1, sides.size() / 2 / kMaxEdges);
  std::set<std::pair<int, int>> pairs;
  bool is_cancelled = false;
  std::size_t index = 0;
  std::vector<int> crossed;
  for_each_edge(sides, [&](std::span<const EdgeSide> edge) {
    if (is_cancelled || index++ % stride != 0 || static_cast<int>(pairs.size()) >= limit) return;
    if (index % 4096 == 0) is_cancelled = run.is_cancelled();
    const int low = edge[0].low();
    const int high = edge[0].high();
    crossed.clear();
    query.crossed_by(mesh.vertices[low], mesh.vertices[high], crossed);
    for (const int t : crossed) {
      if (shares_vertex(mesh.triangles[t], low, high)) continue;
      if (!passes_through(mesh, t, mesh.vertices[low], mesh.vertices[high], margin)) continue;
      for (const EdgeSide& side : edge) {
        pairs.insert({std::min(t, side.triangle()), std::max(t, side.triangle())});
      }
    }
  });
  if (is_cancelled) return RunContext::cancelled();
  return std::min(limit, static_cast<int>(pairs.size()));
}

}  // namespace hewn
