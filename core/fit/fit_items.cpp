#include "core/fit/fit_items.h"

#include <algorithm>

namespace hewn {
namespace {

constexpr double kMinArea = 2e-7;   // share of the mesh's area; smaller groups are splinters
constexpr double kRounding = 8e-7;  // share of the diagonal
constexpr std::size_t kMaxPoints = 2000;

/// Collects each group's vertices once; `stamp` marks those seen.
std::vector<Vec3> vertices_of(const Mesh& mesh, const FaceGroup& group, int id,
                              std::vector<int>& stamp) {
  std::vector<Vec3> points;
  for (const int t : group.triangles) {
    for (const int v : mesh.triangles[t]) {
      if (stamp[v] != id) points.push_back(mesh.vertices[v]);
      stamp[v] = id;
    }
  }
  return points;
}

/// Keeps the vertices that carry the fit.
void select_points(FitItem& item, double exact) {
  std::vector<Vec3> on_surface;
  for (const Vec3& p : item.points) {
    if (std::abs(item.surface.signed_distance(p)) <= exact) on_surface.push_back(p);
  }
  const std::size_t enough = std::max<std::size_t>(
      2 * static_cast<std::size_t>(parameter_count(item.surface.kind)), item.points.size() / 20);
  if (on_surface.size() >= enough) item.points = std::move(on_surface);
  if (item.points.size() <= kMaxPoints) return;
  const std::size_t n = item.points.size();
  for (std::size_t i = 0; i < kMaxPoints; ++i) item.points[i] = item.points[i * n / kMaxPoints];
  item.points.resize(kMaxPoints);
}

}  // namespace

std::vector<FitItem> collect_items(const Mesh& mesh, const Segmentation& segmentation,
                                   bool keep_free_form) {
  const double exact = std::max(kRounding * mesh.diagonal(), 5 * segmentation.noise);
  std::vector<int> stamp(mesh.vertices.size(), -1);
  std::vector<FitItem> items;
  for (int g = 0; g < static_cast<int>(segmentation.groups.size()); ++g) {
    const FaceGroup& group = segmentation.groups[g];
    if (!group.is_fitted && !keep_free_form) continue;
    if (group.area < kMinArea * mesh.total_area) continue;
    FitItem item;
    item.group = g;
    item.surface = group.surface;
    item.area = group.area;
    item.points = vertices_of(mesh, group, g, stamp);
    Box3 box;
    for (const Vec3& p : item.points) box.extend(p);
    item.extent = box.diagonal();
    for (const int t : group.triangles) item.center += mesh.areas[t] * mesh.centroid(t);
    item.center /= group.area;
    select_points(item, exact);
    item.sigma = std::max(segmentation.noise, rms_distance(item.surface, item.points));
    item.deviation = fit_deviation(item.surface, item.points, item.sigma, false);
    items.push_back(std::move(item));
  }
  std::stable_sort(items.begin(), items.end(),
                   [](const FitItem& a, const FitItem& b) { return a.area > b.area; });
  return items;
}

}  // namespace hewn
