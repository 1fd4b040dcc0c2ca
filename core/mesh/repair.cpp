#include "core/mesh/repair.h"

#include <memory>
#include <utility>

#include <fmt/format.h>

#include "core/base/counted.h"
#include "core/mesh/raw_mesh.h"

namespace hewn {
namespace {

/// Squares and cubes of lengths must stay within double's range.
constexpr double kLargestCoordinate = 1e60;
constexpr double kSmallestDiagonal = 1e-60;
constexpr int kSelfIntersectionLimit = 1000;

Result<void> check_input(const Soup& soup) {
  for (std::size_t i = 0; i < soup.vertices.size(); ++i) {
    if (!soup.vertices[i].allFinite()) return not_finite(fmt::format("vertex {}", i));
    if (soup.vertices[i].cwiseAbs().maxCoeff() > kLargestCoordinate) {
      return Error{ErrorCode::BadMesh, "a coordinate is beyond 1e60; rescale the mesh",
                   fmt::format("vertex {}", i)};
    }
  }
  const int count = static_cast<int>(soup.vertices.size());
  for (std::size_t t = 0; t < soup.triangles.size(); ++t) {
    for (const int i : soup.triangles[t]) {
      if (i >= 0 && i < count) continue;
      return Error{
          ErrorCode::BadMesh,
          fmt::format("a triangle names vertex {}, but the vertices are 0 to {}", i, count - 1),
          fmt::format("triangle {}", t)};
    }
  }
  return {};
}

double used_diagonal(const Soup& soup) {
  Box3 box;
  for (const Triangle& t : soup.triangles) {
    for (const int i : t) box.extend(soup.vertices[i]);
  }
  return box.diagonal();
}

Error nothing_left(const MeshReport& report) {
  return {ErrorCode::BadMesh,
          fmt::format("no triangle with an area is left of the {} read; the mesh is empty or all "
                      "its points lie in one place or in a row",
                      report.triangles_read)};
}

/// Leaves the sides of the triangles that are left.
Result<std::vector<EdgeSide>> clean(Soup& soup, const MeshLoadOptions& options, MeshReport& report,
                                    const RunContext& run) {
  soup.diagonal = used_diagonal(soup);
  if (!(soup.diagonal > kSmallestDiagonal)) return nothing_left(report);
  const double tolerance = options.weld_tolerance * soup.diagonal;
  report.vertices_welded = weld_vertices(soup, tolerance);
  if (run.is_cancelled()) return RunContext::cancelled();
  run.report("repairing", 0.3);
  report.zero_area_removed = remove_zero_area(soup, tolerance);
  std::vector<EdgeSide> sides = sorted_sides(soup.triangles);
  report.duplicates_removed = remove_duplicates(soup, sides);
  if (report.duplicates_removed > 0) sides = sorted_sides(soup.triangles);
  if (soup.triangles.empty()) return nothing_left(report);
  if (report.zero_area_removed > 0) {
    report.warnings.push_back(
        counted(report.zero_area_removed, "zero-area triangle was", "zero-area triangles were") +
        " removed.");
  }
  if (report.duplicates_removed > 0) {
    report.warnings.push_back(
        counted(report.duplicates_removed, "duplicate triangle was", "duplicate triangles were") +
        " removed.");
  }
  return sides;
}

}  // namespace

Error not_finite(std::string where) {
  return {ErrorCode::BadMesh,
          "a coordinate is infinite or not a number; export the mesh again from its source",
          std::move(where)};
}

Result<LoadedMesh> repair_mesh(std::vector<Vec3> vertices, std::vector<Triangle> triangles,
                               const MeshLoadOptions& options, const RunContext& run) {
  MeshReport report;
  report.vertices_read = static_cast<int>(vertices.size());
  report.triangles_read = static_cast<int>(triangles.size());
  if (report.triangles_read > options.max_triangles) {
    return Error{ErrorCode::TooLarge,
                 fmt::format("the mesh has {} triangles, the limit is {}; simplify it or raise the "
                             "limit",
                             report.triangles_read, options.max_triangles)};
  }
  Soup soup{std::move(vertices), std::move(triangles), 0};
  if (auto ok = check_input(soup); !ok) return ok.error();
  run.report("repairing", 0);
  auto sides = clean(soup, options, report, run);
  if (!sides) return sides.error();
  run.report("repairing", 0.5);
  const auto is_changed = orient_triangles(soup, *sides, report, run);
  if (!is_changed) return is_changed.error();
  if (*is_changed) *sides = sorted_sides(soup.triangles);
  run.report("repairing", 0.7);
  check_topology(soup, *sides, report);
  if (run.is_cancelled()) return RunContext::cancelled();
  LoadedMesh loaded{make_mesh(std::move(soup.vertices), std::move(soup.triangles)),
                    std::move(report)};
  loaded.report.noise = estimate_noise(loaded.mesh, *sides);
  run.report("repairing", 0.8);
  const auto crossings = count_self_intersections(loaded.mesh, *sides, kSelfIntersectionLimit, run);
  if (!crossings) return crossings.error();
  loaded.report.self_intersections = *crossings;
  if (*crossings > 0) {
    loaded.report.warnings.push_back(
        fmt::format("{}{} each other: what any of the solids holds is taken as inside.",
                    *crossings >= kSelfIntersectionLimit ? "At least " : "",
                    counted(*crossings, "pair of triangles crosses", "pairs of triangles cross")));
  }
  run.report("repairing", 1);
  return loaded;
}

}  // namespace hewn
