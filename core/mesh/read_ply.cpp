// PLY: ASCII, binary little and big endian. Properties other than x, y, z and the faces' vertex
// list are stepped over, whatever their type.
#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>

#include <fmt/format.h>

#include "core/mesh/raw_mesh.h"
#include "core/mesh/text_scanner.h"

namespace hewn {
namespace {

enum class Encoding { Ascii, LittleEndian, BigEndian };
enum class Role { None, X, Y, Z, Loop };

struct ScalarType {
  int bytes = 0;
  char kind = 0;  ///< 'i' signed, 'u' unsigned, 'f' floating
};

struct Property {
  ScalarType type;
  ScalarType count_type;  ///< lists only
  bool is_list = false;
  Role role = Role::None;
};

struct Element {
  std::string name;
  long long count = 0;
  std::vector<Property> properties;
};

struct TypeName {
  std::string_view name;
  ScalarType type;
};
constexpr std::array<TypeName, 16> kTypes = {{{"char", {1, 'i'}},
                                              {"int8", {1, 'i'}},
                                              {"uchar", {1, 'u'}},
                                              {"uint8", {1, 'u'}},
                                              {"short", {2, 'i'}},
                                              {"int16", {2, 'i'}},
                                              {"ushort", {2, 'u'}},
                                              {"uint16", {2, 'u'}},
                                              {"int", {4, 'i'}},
                                              {"int32", {4, 'i'}},
                                              {"uint", {4, 'u'}},
                                              {"uint32", {4, 'u'}},
                                              {"float", {4, 'f'}},
                                              {"float32", {4, 'f'}},
                                              {"double", {8, 'f'}},
                                              {"float64", {8, 'f'}}}};

ScalarType type_named(std::string_view name) {
  for (const TypeName& t : kTypes) {
    if (t.name == name) return t.type;
  }
  return {};
}

Role role_of(const Element& element, std::string_view property, bool is_list) {
  if (element.name == "vertex" && !is_list) {
    if (property == "x") return Role::X;
    if (property == "y") return Role::Y;
    if (property == "z") return Role::Z;
  }
  if (element.name == "face" && is_list &&
      (property == "vertex_indices" || property == "vertex_index")) {
    return Role::Loop;
  }
  return Role::None;
}

double decode(const char* bytes, ScalarType type, bool swap) {
  std::uint64_t bits = 0;
  for (int k = 0; k < type.bytes; ++k) {
    const int from = swap ? k : type.bytes - 1 - k;
    bits = bits << 8 | static_cast<unsigned char>(bytes[from]);
  }
  if (type.kind == 'f') {
    return type.bytes == 8 ? std::bit_cast<double>(bits)
                           : double{std::bit_cast<float>(static_cast<std::uint32_t>(bits))};
  }
  if (type.kind == 'u') return static_cast<double>(bits);
  const int unused = 64 - 8 * type.bytes;
  return static_cast<double>(static_cast<std::int64_t>(bits << unused) >> unused);
}

class PlyReader {
 public:
  explicit PlyReader(const ReadInput& input) : input_(input), scanner_(input.content, '\0') {}

  Result<RawMesh> read() {
    mesh_.format = "PLY";
    if (auto ok = read_header(); !ok) return ok.error();
    if (auto ok = check_header(); !ok) return ok.error();
    for (const Element& element : elements_) {
      if (auto ok = read_element(element); !ok) return ok.error();
    }
    warn_of_skipped_faces(skipped_, mesh_);
    return std::move(mesh_);
  }

 private:
  std::string here() const {
    if (encoding_ == Encoding::Ascii) return at_line(input_.name, scanner_.line());
    return fmt::format("{}, byte {}", input_.name, byte_);
  }
  Error bad(std::string message) const { return {ErrorCode::Format, std::move(message), here()}; }

  Result<void> read_header() {
    const std::size_t end = input_.content.find("end_header");
    const std::size_t stop = end == std::string_view::npos ? end : input_.content.find('\n', end);
    if (stop == std::string_view::npos) {
      return bad("the header has no 'end_header' line; the file is truncated or no PLY");
    }
    TextScanner header(input_.content.substr(0, stop), '\0');
    while (header.next_line()) {
      if (auto ok = read_header_line(header); !ok) {
        return Error{ok.error().code, ok.error().message, at_line(input_.name, header.line())};
      }
    }
    const std::string_view body = input_.content.substr(stop + 1);
    scanner_ = TextScanner(body, '\0', header.line() + 1);
    byte_ = stop + 1;
    return {};
  }

  Result<void> read_header_line(TextScanner& header) {
    const std::string_view word = header.field();
    if (word == "format") {
      const std::string_view format = header.field();
      if (format == "binary_little_endian")
        encoding_ = Encoding::LittleEndian;
      else if (format == "binary_big_endian")
        encoding_ = Encoding::BigEndian;
      else if (format != "ascii")
        return bad(fmt::format("unknown PLY format {}", quote_field(format)));
    } else if (word == "element") {
      const std::string_view name = header.field();
      const std::string_view field = header.field();
      const auto count = parse_integer(field);
      if (!count || *count < 0) {
        return bad(fmt::format("element {} needs a count, found {}", quote_field(name),
                               quote_field(field)));
      }
      elements_.push_back({std::string(name), *count, {}});
    } else if (word == "property") {
      return read_property(header);
    }
    return {};
  }

  Result<void> read_property(TextScanner& header) {
    if (elements_.empty()) return bad("'property' before the first 'element'");
    Property property;
    std::string_view type = header.field();
    if (type == "list") {
      property.is_list = true;
      property.count_type = type_named(header.field());
      type = header.field();
      if (property.count_type.bytes == 0 || property.count_type.kind == 'f') {
        return bad("a list needs an integer type for its length");
      }
    }
    property.type = type_named(type);
    if (property.type.bytes == 0) return bad(fmt::format("unknown type {}", quote_field(type)));
    property.role = role_of(elements_.back(), header.field(), property.is_list);
    elements_.back().properties.push_back(property);
    return {};
  }

  Result<void> check_header() {
    int axes = 0;
    bool has_loop = false;
    for (const Element& element : elements_) {
      std::size_t min_bytes = 0;
      for (const Property& p : element.properties) {
        axes += p.role == Role::X || p.role == Role::Y || p.role == Role::Z ? 1 : 0;
        has_loop = has_loop || p.role == Role::Loop;
        const int bytes = p.is_list ? p.count_type.bytes : p.type.bytes;
        min_bytes += encoding_ == Encoding::Ascii ? 2 : static_cast<std::size_t>(bytes);
      }
      if (element.properties.empty() && element.count > 0) {
        return bad(fmt::format("element {} has no property", quote_field(element.name)));
      }
      auto ok = check_count({element.name == "face" ? "faces" : element.name,
                             static_cast<double>(element.count), min_bytes, here()},
                            input_);
      if (!ok) return ok;
      if (element.name == "vertex") vertex_count_ = element.count;
    }
    if (axes != 3) return bad("the vertices need the properties x, y and z");
    if (!has_loop) return bad("the faces need the list 'vertex_indices'; is this a point cloud?");
    return {};
  }

  Result<void> read_element(const Element& element) {
    for (long long i = 0; i < element.count; ++i) {
      if (cancelled_at(i, input_.run)) return RunContext::cancelled();
      if (encoding_ == Encoding::Ascii && !scanner_.next_line()) {
        return bad(
            fmt::format("the file ends after {} of {} entries of '{}'; it is truncated: get "
                        "a whole copy",
                        i, element.count, element.name));
      }
      loop_.clear();
      for (const Property& property : element.properties) {
        if (auto ok = read_property_value(element, i, property); !ok) return ok;
      }
      if (element.name == "vertex") {
        if (!point_.allFinite()) return not_finite(here());
        mesh_.vertices.push_back(point_);
      } else if (element.name == "face") {
        if (auto ok = add_face(i); !ok) return ok;
      }
    }
    return {};
  }

  Result<void> read_property_value(const Element& element, long long i, const Property& property) {
    double value = 0;
    long long count = 1;
    if (property.is_list) {
      if (!next(property.count_type, value)) return ended(element, i);
      count = static_cast<long long>(value);
      if (count < 0 || count > static_cast<long long>(input_.content.size())) {
        return bad(fmt::format("entry {} of '{}' has a list of {} items", i, element.name, count));
      }
    }
    for (long long k = 0; k < count; ++k) {
      if (!next(property.type, value)) return ended(element, i);
      if (property.role == Role::X) point_.x() = value;
      if (property.role == Role::Y) point_.y() = value;
      if (property.role == Role::Z) point_.z() = value;
      if (property.role == Role::Loop) loop_.push_back(value);
    }
    return {};
  }

  Error ended(const Element& element, long long i) const {
    if (encoding_ == Encoding::Ascii) {
      return bad(
          fmt::format("entry {} of '{}' has too few numbers or one that is none", i, element.name));
    }
    return bad(
        fmt::format("the file ends within entry {} of {} of '{}'; it is truncated: get a "
                    "whole copy",
                    i, element.count, element.name));
  }

  bool next(ScalarType type, double& value) {
    if (encoding_ == Encoding::Ascii) {
      const auto parsed = parse_double(scanner_.field());
      if (parsed) value = *parsed;
      return parsed.has_value();
    }
    if (input_.content.size() - byte_ < static_cast<std::size_t>(type.bytes)) return false;
    value = decode(input_.content.data() + byte_, type, encoding_ == Encoding::BigEndian);
    byte_ += static_cast<std::size_t>(type.bytes);
    return true;
  }

  Result<void> add_face(long long face) {
    corners_.clear();
    for (const double index : loop_) {
      if (!(index >= 0 && index < static_cast<double>(vertex_count_))) {
        return bad(fmt::format("face {} names vertex {}, but the vertices are 0 to {}", face, index,
                               vertex_count_ - 1));
      }
      corners_.push_back(static_cast<int>(index));
    }
    if (corners_.size() < 3) {
      ++skipped_;
    } else if (mesh_.vertices.empty()) {
      return bad("the faces come before the vertices; write the vertices first");
    } else {
      triangulate_polygon(mesh_.vertices, corners_, mesh_.triangles);
    }
    return {};
  }

  const ReadInput& input_;
  TextScanner scanner_;
  Encoding encoding_ = Encoding::Ascii;
  std::vector<Element> elements_;
  std::size_t byte_ = 0;
  long long vertex_count_ = 0;
  Vec3 point_ = Vec3::Zero();
  std::vector<double> loop_;
  std::vector<int> corners_;
  RawMesh mesh_;
  int skipped_ = 0;
};

}  // namespace

Result<RawMesh> read_ply(const ReadInput& input) { return PlyReader(input).read(); }

}  // namespace hewn
