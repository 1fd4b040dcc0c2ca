#pragma once
/// Facts as JSON. Schema: docs/report.md
#include <string>

#include <nlohmann/json_fwd.hpp>

#include "core/session/reconstruct.h"

namespace hewn {

/// The version of the report's schema; grows when a key changes its meaning or goes away.
inline constexpr int kReportVersion = 1;

/// What was read and repaired.
nlohmann::json mesh_report_json(const MeshReport& report, const Mesh& mesh);

/// The surface's kind and values: radii, axis, position.
nlohmann::json surface_json(const Surface& surface);

/// The face groups, each with its surface, share of the area, a point on it and its triangles when
/// asked for.
nlohmann::json segmentation_json(const PreparedMesh& prepared, bool with_triangles);

nlohmann::json score_json(const TreeScore& score, double diagonal);

/// The whole report of a reconstruction.
nlohmann::json report_json(const Project& project, const Reconstruction& result);

/// A point well inside the group: on the triangle of largest area.
Vec3 point_on_group(const Mesh& mesh, const FaceGroup& group);

}  // namespace hewn
