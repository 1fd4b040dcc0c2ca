// OFF, text. The variants with normals, colours or texture coordinates (COFF, NOFF, STOFF, ...) are
// read for their positions.
#include <cctype>

#include <fmt/format.h>

#include "core/mesh/raw_mesh.h"
#include "core/mesh/text_scanner.h"

namespace hewn {
namespace {

class OffReader {
 public:
  explicit OffReader(const ReadInput& input) : input_(input), scanner_(input.content) {}

  Result<RawMesh> read() {
    mesh_.format = "OFF";
    if (auto ok = read_header(); !ok) return ok.error();
    if (auto ok = read_vertices(); !ok) return ok.error();
    if (auto ok = read_faces(); !ok) return ok.error();
    warn_of_skipped_faces(skipped_, mesh_);
    return std::move(mesh_);
  }

 private:
  Error bad(std::string message) const {
    return {ErrorCode::Format, std::move(message), at_line(input_.name, scanner_.line())};
  }

  Error ended(std::string_view what, long long got, long long wanted) const {
    return {ErrorCode::Format,
            fmt::format("the file ends after {} of {} {}; it is truncated: get a whole copy", got,
                        wanted, what),
            at_line(input_.name, scanner_.line())};
  }

  Result<void> read_header() {
    if (!scanner_.next_line()) return bad("the file holds no text: an OFF file starts with 'OFF'");
    std::string_view head = scanner_.field();
    const std::size_t at = head.find("OFF");
    if (at == std::string_view::npos) {
      return bad(fmt::format("an OFF file starts with 'OFF', this one with {}", quote_field(head)));
    }
    if (head.substr(0, at).find_first_of("4n") != std::string_view::npos) {
      return bad("4-dimensional OFF is not supported; save the mesh with 3 coordinates a vertex");
    }
    // Some data sets glue the counts to the keyword: "OFF490 518 0".
    std::string_view first = head.substr(at + 3);
    if (first.empty() && !scanner_.at_line_end()) first = scanner_.field();
    if (first == "BINARY") return bad("binary OFF is not supported; save it as text");
    if (first.empty()) {
      if (!scanner_.next_line())
        return bad("the file ends before the counts of vertices and faces");
      first = scanner_.field();
    }
    return read_counts(first, scanner_.field());
  }

  Result<void> read_counts(std::string_view vertex_field, std::string_view face_field) {
    const auto vertices = parse_integer(vertex_field);
    const auto faces = parse_integer(face_field);
    if (!vertices || !faces || *vertices < 0 || *faces < 0) {
      return bad(fmt::format("expected the counts of vertices and faces, found {} {}",
                             quote_field(vertex_field), quote_field(face_field)));
    }
    const std::string where = at_line(input_.name, scanner_.line());
    auto ok = check_count({"vertices", static_cast<double>(*vertices), 6, where}, input_);
    if (ok) ok = check_count({"faces", static_cast<double>(*faces), 2, where}, input_);
    if (!ok) return ok.error();
    vertex_count_ = *vertices;
    face_count_ = *faces;
    return {};
  }

  Result<void> read_vertices() {
    mesh_.vertices.reserve(static_cast<std::size_t>(vertex_count_));
    for (long long i = 0; i < vertex_count_; ++i) {
      if (cancelled_at(i, input_.run)) return RunContext::cancelled();
      if (!scanner_.next_line()) return ended("vertices", i, vertex_count_);
      Vec3 p;
      std::string found;
      if (!read_point(scanner_, p, found)) {
        return bad(fmt::format("vertex {} needs 3 numbers, found {}", i, found));
      }
      if (!p.allFinite()) return not_finite(at_line(input_.name, scanner_.line()));
      mesh_.vertices.push_back(p);
    }
    return {};
  }

  Result<void> read_faces() {
    mesh_.triangles.reserve(static_cast<std::size_t>(face_count_));
    std::vector<int> loop;
    for (long long i = 0; i < face_count_; ++i) {
      if (cancelled_at(i, input_.run)) return RunContext::cancelled();
      if (!scanner_.next_line()) return ended("faces", i, face_count_);
      if (auto ok = read_loop(i, loop); !ok) return ok;
      if (loop.size() < 3) {
        ++skipped_;
        continue;
      }
      triangulate_polygon(mesh_.vertices, loop, mesh_.triangles);
    }
    return {};
  }

  Result<void> read_loop(long long face, std::vector<int>& loop) {
    loop.clear();
    const std::string_view count_field = scanner_.field();
    const auto count = parse_integer(count_field);
    if (!count || *count < 0) {
      return bad(fmt::format("face {} starts with its number of corners, found {}", face,
                             quote_field(count_field)));
    }
    for (long long k = 0; k < *count; ++k) {
      const std::string_view field = scanner_.field();
      const auto index = parse_integer(field);
      if (!index) {
        return bad(fmt::format("face {} needs {} vertex numbers, found {}", face, *count,
                               field.empty() ? "the end of the line" : quote_field(field)));
      }
      if (*index < 0 || *index >= vertex_count_) {
        return bad(fmt::format("face {} names vertex {}, but the vertices are 0 to {}", face,
                               *index, vertex_count_ - 1));
      }
      loop.push_back(static_cast<int>(*index));
    }
    return {};
  }

  const ReadInput& input_;
  TextScanner scanner_;
  RawMesh mesh_;
  long long vertex_count_ = 0, face_count_ = 0;
  int skipped_ = 0;
};

}  // namespace

Result<RawMesh> read_off(const ReadInput& input) { return OffReader(input).read(); }

}  // namespace hewn
