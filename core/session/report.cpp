#include "core/session/report.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "core/io/point_json.h"

namespace hewn {
namespace {

using Json = nlohmann::json;

Json partition_json(const PartitionResult& partition) {
  return {{"name", partition.name},
          {"op", partition.op},
          {"groups", partition.groups},
          {"area_share", partition.area_share},
          {"literals", literal_count(partition.answer.tree)},
          {"size", tree_size(partition.answer.tree)},
          {"agreement", partition.answer.agreement},
          {"is_polyhedron", partition.is_polyhedron},
          {"free_form_share", partition.free_form_share},
          {"search",
           {{"rounds", partition.answer.rounds},
            {"halfspaces", partition.answer.halfspaces},
            {"separating", partition.answer.separating},
            {"cells", partition.answer.cells},
            {"terms_grown", partition.answer.terms_grown},
            {"evaluations", partition.answer.evaluations}}}};
}

Json literal_counts(const Tree& tree) {
  Json counts = Json::object();
  for (const Literal& literal : tree.literals) {
    Json& count = counts[name_of(literal.kind)];
    count = count.is_null() ? 1 : count.get<int>() + 1;
  }
  return counts;
}

}  // namespace

Vec3 point_on_group(const Mesh& mesh, const FaceGroup& group) {
  int best = -1;
  for (const int t : group.triangles) {
    if (best < 0 || mesh.areas[t] > mesh.areas[best]) best = t;
  }
  return best < 0 ? Vec3(Vec3::Zero()) : mesh.centroid(best);
}

Json mesh_report_json(const MeshReport& report, const Mesh& mesh) {
  return {{"format", report.format},
          {"vertices_read", report.vertices_read},
          {"triangles_read", report.triangles_read},
          {"vertices", mesh.vertices.size()},
          {"triangles", mesh.triangles.size()},
          {"vertices_welded", report.vertices_welded},
          {"zero_area_removed", report.zero_area_removed},
          {"duplicates_removed", report.duplicates_removed},
          {"triangles_flipped", report.triangles_flipped},
          {"was_inside_out", report.was_inside_out},
          {"components", report.components},
          {"boundary_edges", report.boundary_edges},
          {"holes", report.holes},
          {"non_manifold_edges", report.non_manifold_edges},
          {"self_intersections", report.self_intersections},
          {"is_closed", report.is_closed},
          {"noise", report.noise},
          {"box", {{"min", point_json(mesh.bounds.lo)}, {"max", point_json(mesh.bounds.hi)}}},
          {"diagonal", mesh.diagonal()},
          {"area", mesh.total_area},
          {"volume", mesh.volume}};
}

Json surface_json(const Surface& surface) {
  Json out = {{"kind", name_of(surface.kind)}};
  if (surface.kind == SurfaceKind::Plane) {
    out["normal"] = point_json(surface.axis);
    out["offset"] = surface.offset;
    return out;
  }
  out["point"] = point_json(surface.point);
  if (surface.kind != SurfaceKind::Sphere) out["axis"] = point_json(surface.axis);
  if (surface.kind == SurfaceKind::Cone) {
    out["half_angle_deg"] = surface.half_angle_rad * 180 / kPi;
  } else {
    out["radius"] = surface.radius;
  }
  if (surface.kind == SurfaceKind::Torus) out["major_radius"] = surface.major_radius;
  return out;
}

Json segmentation_json(const PreparedMesh& prepared, bool with_triangles) {
  Json groups = Json::array();
  for (std::size_t g = 0; g < prepared.segmentation.groups.size(); ++g) {
    const FaceGroup& group = prepared.segmentation.groups[g];
    Json item = surface_json(group.surface);
    item["index"] = g;
    item["at"] = point_json(point_on_group(*prepared.mesh, group));
    item["area_share"] = group.area / prepared.mesh->total_area;
    item["is_boss"] = group.side > 0;
    item["is_fitted"] = group.is_fitted;
    item["max_deviation"] = group.max_deviation;
    item["rms_deviation"] = group.rms_deviation;
    if (with_triangles) {
      item["triangles"] = group.triangles;
    } else {
      item["triangles"] = group.triangles.size();
    }
    groups.push_back(std::move(item));
  }
  return groups;
}

Json score_json(const TreeScore& score, double diagonal) {
  return {{"agreement", score.agreement},
          {"iou", score.iou},
          {"hausdorff_rel", score.hausdorff},
          {"mean_rel", score.mean_distance},
          {"mesh_to_tree_max_rel", score.mesh_to_tree_max},
          {"tree_to_mesh_max_rel", score.tree_to_mesh_max},
          {"hausdorff", score.hausdorff * diagonal},
          {"mean", score.mean_distance * diagonal}};
}

Json report_json(const Project& project, const Reconstruction& result) {
  Json partitions = Json::array();
  for (const PartitionResult& p : result.partitions) partitions.push_back(partition_json(p));
  Json seconds = Json::object();
  double total = 0;
  for (const StageTime& time : result.times) {
    seconds[time.stage] = time.seconds;
    total += time.seconds;
  }
  seconds["total"] = total;
  const Mesh& mesh = *result.prepared.mesh;
  return {{"hewn-report", kReportVersion},
          {"input", mesh_report_json(result.mesh_report, mesh)},
          {"mesh", project.mesh.filename().string()},
          {"seed", project.seed},
          {"options", settings_to_json(project.settings)},
          {"groups", result.prepared.segmentation.groups.size()},
          {"halfspaces", result.surfaces.halfspaces.size()},
          {"partitions", std::move(partitions)},
          {"tree",
           {{"size", tree_size(result.tree)},
            {"literals", literal_count(result.tree)},
            {"operations", tree_size(result.tree) - literal_count(result.tree)},
            {"proximity", result.score.proximity},
            {"literal_kinds", literal_counts(result.tree)}}},
          {"geometry", score_json(result.score, mesh.diagonal())},
          {"unexplained_share", result.surfaces.unexplained_area},
          {"polyhedron_share", result.score.polyhedron_share},
          {"warnings", result.warnings},
          {"seconds", std::move(seconds)}};
}

}  // namespace hewn
