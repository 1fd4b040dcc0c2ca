// Wavefront OBJ: 'v' and 'f' lines; everything else (materials, groups, normals) has no bearing.
#include <fmt/format.h>

#include "core/mesh/raw_mesh.h"
#include "core/mesh/text_scanner.h"

namespace hewn {
namespace {

class ObjReader {
 public:
  explicit ObjReader(const ReadInput& input) : input_(input), scanner_(input.content) {}

  Result<RawMesh> read() {
    mesh_.format = "OBJ";
    for (std::size_t i = 0; scanner_.next_line(); ++i) {
      if (cancelled_at(i, input_.run)) return RunContext::cancelled();
      const std::string_view word = scanner_.field();
      Result<void> ok;
      if (word == "v") ok = read_vertex();
      if (word == "f") ok = read_face();
      if (!ok) return ok.error();
    }
    if (mesh_.triangles.empty()) return bad("the file holds no face ('f' line)");
    return std::move(mesh_);
  }

 private:
  Error bad(std::string message) const {
    return {ErrorCode::Format, std::move(message), at_line(input_.name, scanner_.line())};
  }

  Result<void> read_vertex() {
    Vec3 p;
    std::string found;
    if (!read_point(scanner_, p, found)) {
      return bad(fmt::format("'v' needs 3 numbers, found {}", found));
    }
    if (!p.allFinite()) return not_finite(at_line(input_.name, scanner_.line()));
    mesh_.vertices.push_back(p);
    return {};
  }

  Result<void> read_face() {
    loop_.clear();
    const auto count = static_cast<long long>(mesh_.vertices.size());
    while (!scanner_.at_line_end()) {
      const std::string_view field = scanner_.field();
      const auto index = parse_integer(field.substr(0, field.find('/')));
      if (!index) return bad(fmt::format("{} is no vertex number", quote_field(field)));
      // Positive numbers count from 1, negative ones back from the latest vertex.
      const long long i = *index > 0 ? *index - 1 : *index + count;
      if (*index == 0 || i < 0 || i >= count) {
        return bad(fmt::format("the face names vertex {}, but only {} vertices precede it", *index,
                               count));
      }
      loop_.push_back(static_cast<int>(i));
    }
    if (loop_.size() < 3) {
      return bad(fmt::format("the face has {} vertices; it needs at least 3", loop_.size()));
    }
    triangulate_polygon(mesh_.vertices, loop_, mesh_.triangles);
    if (static_cast<int>(mesh_.triangles.size()) <= input_.options.max_triangles) return {};
    return Error{ErrorCode::TooLarge,
                 fmt::format("the file holds more than {} triangles; simplify the mesh or raise "
                             "the limit",
                             input_.options.max_triangles),
                 at_line(input_.name, scanner_.line())};
  }

  const ReadInput& input_;
  TextScanner scanner_;
  RawMesh mesh_;
  std::vector<int> loop_;
};

}  // namespace

Result<RawMesh> read_obj(const ReadInput& input) { return ObjReader(input).read(); }

}  // namespace hewn
