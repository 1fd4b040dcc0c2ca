#include <bit>
#include <cctype>
#include <cstdint>
#include <iterator>

#include <fmt/format.h>

#include "core/base/file.h"
#include "core/mesh/load.h"

namespace hewn {
namespace {

void append_u32(std::string& out, std::uint32_t value) {
  for (int k = 0; k < 4; ++k) out += static_cast<char>(value >> (8 * k) & 0xFF);
}

void append_vec(std::string& out, const Vec3& v) {
  for (const double c : v) append_u32(out, std::bit_cast<std::uint32_t>(static_cast<float>(c)));
}

std::string to_stl(const Mesh& mesh) {
  // The header must not start with "solid", or naive readers take the file for text.
  std::string out = "binary STL";
  out.resize(80, ' ');
  out.reserve(84 + 50 * mesh.triangles.size());
  append_u32(out, static_cast<std::uint32_t>(mesh.triangles.size()));
  for (int t = 0; t < static_cast<int>(mesh.triangles.size()); ++t) {
    append_vec(out, mesh.normals[t]);
    for (int k = 0; k < 3; ++k) append_vec(out, mesh.corner(t, k));
    out.append(2, '\0');
  }
  return out;
}

/// `{}` prints the shortest text that reads back as the same double.
void append_vertices(std::string& out, const Mesh& mesh, std::string_view prefix) {
  for (const Vec3& p : mesh.vertices) {
    fmt::format_to(std::back_inserter(out), "{}{} {} {}\n", prefix, p.x(), p.y(), p.z());
  }
}

void append_faces(std::string& out, const Mesh& mesh, std::string_view prefix, int base) {
  for (const auto& [a, b, c] : mesh.triangles) {
    fmt::format_to(std::back_inserter(out), "{} {} {} {}\n", prefix, a + base, b + base, c + base);
  }
}

std::string to_off(const Mesh& mesh) {
  std::string out = fmt::format("OFF\n{} {} 0\n", mesh.vertices.size(), mesh.triangles.size());
  append_vertices(out, mesh, "");
  append_faces(out, mesh, "3", 0);
  return out;
}

std::string to_obj(const Mesh& mesh) {
  std::string out;
  append_vertices(out, mesh, "v ");
  append_faces(out, mesh, "f", 1);
  return out;
}

std::string to_ply(const Mesh& mesh) {
  std::string out = fmt::format(
      "ply\nformat ascii 1.0\nelement vertex {}\nproperty double x\nproperty double y\n"
      "property double z\nelement face {}\nproperty list uchar int vertex_indices\nend_header\n",
      mesh.vertices.size(), mesh.triangles.size());
  append_vertices(out, mesh, "");
  append_faces(out, mesh, "3", 0);
  return out;
}

}  // namespace

Result<void> save_mesh(const Mesh& mesh, const std::filesystem::path& path) {
  std::string extension = path.extension().string();
  for (char& c : extension) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  if (extension == ".off") return write_file(path, to_off(mesh));
  if (extension == ".stl") return write_file(path, to_stl(mesh));
  if (extension == ".obj") return write_file(path, to_obj(mesh));
  if (extension == ".ply") return write_file(path, to_ply(mesh));
  return Error{ErrorCode::InvalidArgument,
               fmt::format("cannot tell the format from '{}'; name the file .off, .stl, .obj or "
                           ".ply",
                           extension),
               path.string()};
}

}  // namespace hewn
