// STL, binary and text. Vertices come three per triangle; welding joins them.
#include <bit>
#include <cstring>

#include <fmt/format.h>

#include "core/base/counted.h"
#include "core/mesh/raw_mesh.h"
#include "core/mesh/text_scanner.h"

namespace hewn {
namespace {

constexpr std::size_t kHeaderBytes = 84;
constexpr std::size_t kTriangleBytes = 50;

std::uint32_t load_u32(const char* bytes) {
  std::uint32_t value = 0;
  for (int k = 3; k >= 0; --k) value = value << 8 | static_cast<unsigned char>(bytes[k]);
  return value;
}

double load_float(const char* bytes) { return double{std::bit_cast<float>(load_u32(bytes))}; }

std::string at_byte(const ReadInput& input, std::size_t byte) {
  return fmt::format("{}, byte {}", input.name, byte);
}

std::string lower(std::string_view field) {
  std::string text(field);
  for (char& c : text) c = (c >= 'A' && c <= 'Z') ? static_cast<char>(c - 'A' + 'a') : c;
  return text;
}

}  // namespace

bool is_binary_stl(std::string_view content) {
  if (content.size() < kHeaderBytes) return false;
  const std::size_t count = load_u32(content.data() + 80);
  return count > 0 && content.size() == kHeaderBytes + kTriangleBytes * count;
}

Result<RawMesh> read_stl_binary(const ReadInput& input) {
  const std::string_view content = input.content;
  if (content.size() < kHeaderBytes) {
    return Error{ErrorCode::Format,
                 fmt::format("a binary STL has a header of 84 bytes, this file has {} bytes in all",
                             content.size()),
                 at_byte(input, content.size())};
  }
  const std::size_t count = load_u32(content.data() + 80);
  const std::size_t wanted = kHeaderBytes + kTriangleBytes * count;
  if (content.size() < wanted) {
    return Error{ErrorCode::Format,
                 fmt::format("the header promises {} triangles ({} bytes), but the file has {} "
                             "bytes; it is truncated or no STL: get a whole copy",
                             count, wanted, content.size()),
                 at_byte(input, 80)};
  }
  const auto ok = check_count(
      {"triangles", static_cast<double>(count), kTriangleBytes, at_byte(input, 80)}, input);
  if (!ok) return ok.error();
  RawMesh mesh;
  mesh.format = "STL (binary)";
  mesh.vertices.reserve(3 * count);
  mesh.triangles.reserve(count);
  for (std::size_t t = 0; t < count; ++t) {
    if (cancelled_at(t, input.run)) return RunContext::cancelled();
    const std::size_t offset = kHeaderBytes + kTriangleBytes * t;
    const char* bytes = content.data() + offset + 12;  // past the normal, which is recomputed
    for (int k = 0; k < 3; ++k, bytes += 12) {
      const Vec3 p(load_float(bytes), load_float(bytes + 4), load_float(bytes + 8));
      if (!p.allFinite()) return not_finite(at_byte(input, bytes - content.data()));
      mesh.vertices.push_back(p);
    }
    const int first = static_cast<int>(3 * t);
    mesh.triangles.push_back({first, first + 1, first + 2});
  }
  if (content.size() > wanted) {
    mesh.warnings.push_back(counted(content.size() - wanted, "byte", "bytes") +
                            " after the last triangle: ignored.");
  }
  return mesh;
}

namespace {

class AsciiStlReader {
 public:
  explicit AsciiStlReader(const ReadInput& input) : input_(input), scanner_(input.content, '\0') {}

  Result<RawMesh> read() {
    mesh_.format = "STL (ASCII)";
    bool is_open = false;
    for (std::size_t i = 0; scanner_.next_line(); ++i) {
      if (cancelled_at(i, input_.run)) return RunContext::cancelled();
      const std::string word = lower(scanner_.field());
      if (word == "solid") is_open = true;
      if (word == "endsolid") is_open = false;
      if (word == "vertex") {
        if (auto ok = read_vertex(); !ok) return ok.error();
      } else if (word == "endloop") {
        if (auto ok = close_loop(); !ok) return ok.error();
      } else if (!is_known(word)) {
        return bad(fmt::format("{} is no STL keyword; is the file damaged?", quote_field(word)));
      }
    }
    if (!loop_.empty())
      return bad("the file ends within a triangle; it is truncated: get a whole copy");
    if (is_open) return bad("the file ends without 'endsolid'; it is truncated: get a whole copy");
    return std::move(mesh_);
  }

 private:
  static bool is_known(const std::string& word) {
    return word == "solid" || word == "endsolid" || word == "facet" || word == "outer" ||
           word == "endfacet" || word == "color";
  }

  Error bad(std::string message) const {
    return {ErrorCode::Format, std::move(message), at_line(input_.name, scanner_.line())};
  }

  Result<void> read_vertex() {
    Vec3 p;
    std::string found;
    if (!read_point(scanner_, p, found)) {
      return bad(fmt::format("'vertex' needs 3 numbers, found {}", found));
    }
    if (!p.allFinite()) return not_finite(at_line(input_.name, scanner_.line()));
    loop_.push_back(static_cast<int>(mesh_.vertices.size()));
    mesh_.vertices.push_back(p);
    return {};
  }

  Result<void> close_loop() {
    if (loop_.size() < 3) {
      return bad(fmt::format("a facet with {} vertices; it needs 3", loop_.size()));
    }
    triangulate_polygon(mesh_.vertices, loop_, mesh_.triangles);
    loop_.clear();
    if (static_cast<int>(mesh_.triangles.size()) > input_.options.max_triangles) {
      return Error{ErrorCode::TooLarge,
                   fmt::format("the file holds more than {} triangles; simplify the mesh or raise "
                               "the limit",
                               input_.options.max_triangles),
                   at_line(input_.name, scanner_.line())};
    }
    return {};
  }

  const ReadInput& input_;
  TextScanner scanner_;
  RawMesh mesh_;
  std::vector<int> loop_;
};

}  // namespace

Result<RawMesh> read_stl_ascii(const ReadInput& input) { return AsciiStlReader(input).read(); }

}  // namespace hewn
