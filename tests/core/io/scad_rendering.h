#pragma once
/// Runs the real OpenSCAD on a design and reads the mesh it makes.
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <optional>
#include <sstream>
#include <string>

#include "core/base/file.h"
#include "core/mesh/mesh.h"
#include "scratch_folder.h"

namespace hewn::testing {

/// Reads OpenSCAD's OFF output; faces with more than three corners are fanned.
inline Mesh read_off(const std::filesystem::path& path) {
  std::ifstream in(path);
  std::string magic;
  int vertex_count = 0;
  int face_count = 0;
  int edge_count = 0;
  in >> magic >> vertex_count >> face_count >> edge_count;
  std::vector<Vec3> vertices(static_cast<std::size_t>(vertex_count));
  for (Vec3& v : vertices) in >> v.x() >> v.y() >> v.z();
  std::vector<Triangle> triangles;
  for (int f = 0; f < face_count && in; ++f) {
    int corners = 0;
    in >> corners;
    std::vector<int> face(static_cast<std::size_t>(corners));
    for (int& v : face) in >> v;
    std::string colour;
    std::getline(in, colour);
    for (std::size_t k = 2; k < face.size(); ++k) {
      triangles.push_back({face[0], face[k - 1], face[k]});
    }
  }
  return make_mesh(std::move(vertices), std::move(triangles));
}

/// The rendered mesh, or nothing when OpenSCAD fails or warns.
inline std::optional<Mesh> render(const std::string& scad, const ScratchFolder& folder) {
  const auto source = folder / "design.scad";
  const auto target = folder / "design.off";
  const auto log = folder / "log.txt";
  std::filesystem::remove(target);
  if (!write_file(source, scad)) return std::nullopt;
  const std::string command = std::string(HEWN_OPENSCAD) + " -o '" + target.string() + "' '" +
                              source.string() + "' > '" + log.string() + "' 2>&1";
  if (std::system(command.c_str()) != 0) return std::nullopt;
  const auto messages = read_file(log);
  const bool is_clean = messages && messages->find("WARNING") == std::string::npos &&
                        messages->find("ERROR") == std::string::npos;
  if (!is_clean) return std::nullopt;
  return read_off(target);
}

}  // namespace hewn::testing
