#pragma once
/// Reading meshes from files: OFF, STL (binary and ASCII), OBJ and PLY, repaired and checked.
#include <filesystem>
#include <string>
#include <vector>

#include "core/base/result.h"
#include "core/base/run_context.h"
#include "core/mesh/mesh.h"

namespace hewn {

/// What was found in a mesh and what was mended. Counts are of the mesh before each repair.
struct MeshReport {
  std::string format;  ///< "OFF", "STL (binary)", "STL (ASCII)", "OBJ", "PLY"
  int vertices_read = 0;
  int triangles_read = 0;
  int vertices_welded = 0;
  int zero_area_removed = 0;
  int duplicates_removed = 0;
  int triangles_flipped = 0;  ///< turned to agree with their neighbours
  bool was_inside_out = false;
  int components = 0;
  int boundary_edges = 0;
  int holes = 0;  ///< loops of boundary edges
  int non_manifold_edges = 0;
  int self_intersections = 0;  ///< pairs of triangles; counted up to a limit
  bool is_closed = false;
  /// How far vertices stray from the surfaces they were sampled from: the coordinates' rounding
  /// plus what the data shows, in model units.
  double noise = 0;
  std::vector<std::string> warnings;  ///< one readable sentence for each repair or defect
};

struct LoadedMesh {
  Mesh mesh;
  MeshReport report;
};

struct MeshLoadOptions {
  /// Vertices closer than this share of the bounding-box diagonal become one.
  double weld_tolerance = 1e-6;
  int max_triangles = 20'000'000;
};

/// Loads, welds, orients and checks a mesh. The type is taken from the content, not only the name.
/// Fails with: FileNotFound, Format (with line or byte), BadMesh (no triangle left, NaN or infinite
/// coordinates), TooLarge, Cancelled.
Result<LoadedMesh> load_mesh(const std::filesystem::path& path, const MeshLoadOptions& options,
                             const RunContext& run);

/// The same repairs and checks for triangles that are already in memory.
Result<LoadedMesh> repair_mesh(std::vector<Vec3> vertices, std::vector<Triangle> triangles,
                               const MeshLoadOptions& options, const RunContext& run);

/// Writes OFF, STL (binary), OBJ or PLY after the path's extension.
/// Fails with: InvalidArgument (unknown extension), FileWrite.
Result<void> save_mesh(const Mesh& mesh, const std::filesystem::path& path);

}  // namespace hewn
