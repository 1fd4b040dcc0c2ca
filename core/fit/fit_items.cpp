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

/// The centre of the triangles that lie on the surface when they make up enough of the group:
/// triangles across its edges belong to it only in part, and would shift a plane through it.
Vec3 carrying_center(const Mesh& mesh, const FaceGroup& group, double exact) {
  constexpr double kEnough = 0.25;
  Vec3 center = Vec3::Zero(), exact_center = Vec3::Zero();
  double area = 0, exact_area = 0;
  for (const int t : group.triangles) {
    const Vec3 moment = mesh.areas[t] * mesh.centroid(t);
    center += moment;
    area += mesh.areas[t];
    const bool is_exact = std::all_of(
        mesh.triangles[t].begin(), mesh.triangles[t].end(),
        [&](int v) { return std::abs(group.surface.signed_distance(mesh.vertices[v])) <= exact; });
    if (!is_exact) continue;
    exact_center += moment;
    exact_area += mesh.areas[t];
  }
  return exact_area > kEnough * area ? Vec3(exact_center / exact_area) : Vec3(center / area);
}

std::vector<Vec3> points_within(const FitItem& item, double limit) {
  std::vector<Vec3> near;
  for (const Vec3& p : item.points) {
    if (std::abs(item.surface.signed_distance(p)) <= limit) near.push_back(p);
  }
  return near;
}

double median_distance(const FitItem& item) {
  std::vector<double> distances;
  for (const Vec3& p : item.points) distances.push_back(std::abs(item.surface.signed_distance(p)));
  const auto middle = distances.begin() + static_cast<std::ptrdiff_t>(distances.size() / 2);
  std::nth_element(distances.begin(), middle, distances.end());
  return *middle;
}

/// Keeps the vertices that carry the fit: those exactly on the surface, or else those that are no
/// outliers (of triangles that lie across the surface's rim).
void select_points(FitItem& item, double exact) {
  constexpr double kOutlier = 4;  // medians
  const std::size_t enough = std::max<std::size_t>(
      2 * static_cast<std::size_t>(parameter_count(item.surface.kind)), item.points.size() / 20);
  std::vector<Vec3> kept = points_within(item, exact);
  if (kept.size() < enough) {
    kept = points_within(item, std::max(exact, kOutlier * median_distance(item)));
  }
  if (kept.size() >= enough) item.points = std::move(kept);
  if (item.points.size() <= kMaxPoints) return;
  const std::size_t n = item.points.size();
  for (std::size_t i = 0; i < kMaxPoints; ++i) item.points[i] = item.points[i * n / kMaxPoints];
  item.points.resize(kMaxPoints);
}

}  // namespace

double exact_reach(double diagonal, double noise) {
  return std::max(kRounding * diagonal, 5 * noise);
}

std::vector<FitItem> collect_items(const Mesh& mesh, const Segmentation& segmentation,
                                   bool keep_free_form) {
  const double exact = exact_reach(mesh.diagonal(), segmentation.noise);
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
    item.center = carrying_center(mesh, group, exact);
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
