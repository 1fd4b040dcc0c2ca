#include "core/io/json.h"

#include <cmath>
#include <initializer_list>
#include <optional>
#include <utility>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "core/base/file.h"
#include "core/csg/prism.h"
#include "core/io/point_json.h"
#include "core/mesh/query.h"

namespace hewn {
namespace {

// Fields keep the order in which they are written, for people who read the file.
using Json = nlohmann::ordered_json;

constexpr const char* kFormat = "hewn-tree";

const char* name_of(Op op) {
  switch (op) {
    case Op::Union:
      return "union";
    case Op::Intersection:
      return "intersection";
    case Op::Difference:
      return "difference";
    case Op::Complement:
      return "complement";
    case Op::Literal:
      break;
  }
  return "literal";
}

void put_shape(const Literal& s, Json& out) {
  switch (s.kind) {
    case SolidKind::Box:
      out["size"] = point_json<Json>(s.size);
      break;
    case SolidKind::Cylinder:
      out["height"] = s.height;
      out["radius"] = s.radius;
      out["top_radius"] = s.top_radius;
      break;
    case SolidKind::Prism:
      out["sides"] = s.sides;
      out["height"] = s.height;
      out["radius"] = s.radius;
      break;
    case SolidKind::Torus:
      out["major_radius"] = s.major_radius;
      [[fallthrough]];
    case SolidKind::Sphere:
      out["radius"] = s.radius;
      break;
    case SolidKind::Polyhedron: {
      Json vertices = Json::array();
      Json triangles = Json::array();
      if (s.polyhedron) {
        for (const Vec3& v : s.polyhedron->vertices) vertices.push_back(point_json<Json>(v));
        for (const Triangle& t : s.polyhedron->triangles) triangles.push_back(t);
      }
      out["vertices"] = std::move(vertices);
      out["triangles"] = std::move(triangles);
      break;
    }
  }
}

Json to_json(const Literal& s) {
  Json out;
  out["op"] = name_of(s.kind);
  Json rotation = Json::array();
  for (int i = 0; i < 9; ++i) rotation.push_back(s.rotation(i / 3, i % 3));
  out["rotation"] = std::move(rotation);
  out["origin"] = point_json<Json>(s.origin);
  if (s.stretch) {
    Json stretch = Json::array();
    for (int i = 0; i < 9; ++i) stretch.push_back(s.stretch->matrix(i / 3, i % 3));
    out["stretch"] = std::move(stretch);
  }
  put_shape(s, out);
  if (s.facets.sides != 0 || s.facets.tube_sides != 0) {
    out["facets"] = {{"sides", s.facets.sides},
                     {"phase_rad", s.facets.phase_rad},
                     {"tube_sides", s.facets.tube_sides},
                     {"tube_phase_rad", s.facets.tube_phase_rad}};
  }
  return out;
}

Json to_json(const Tree& tree, int index) {
  const Node& node = tree.nodes[index];
  if (node.op == Op::Literal) {
    Json out = to_json(tree.literals[node.literal]);
    if (!node.name.empty()) out["name"] = node.name;
    return out;
  }
  Json out;
  out["op"] = name_of(node.op);
  if (!node.name.empty()) out["name"] = node.name;
  Json children = Json::array();
  for (const int child : node.children) children.push_back(to_json(tree, child));
  out["children"] = std::move(children);
  return out;
}

/// Reads one document; the first fault is kept and stops the rest.
class TreeReader {
 public:
  explicit TreeReader(std::string source) : source_(std::move(source)) {}

  Result<Tree> run(const Json& document) {
    if (!document.is_object() || text_of(document, "format") != kFormat) {
      fail("", R"(this is not a tree: a JSON object with "format": "hewn-tree" is needed)");
    } else if (const int version = integer(document, "", "version"); !fault_) {
      if (version != kTreeJsonVersion) {
        fail("/version", fmt::format("version {} is unknown; this program reads version {}",
                                     version, kTreeJsonVersion));
      } else {
        read_root(document);
      }
    }
    if (fault_) return *fault_;
    return std::move(tree_);
  }

 private:
  void fail(const std::string& path, std::string message) {
    if (fault_) return;
    fault_ =
        Error{ErrorCode::Format, std::move(message), source_ + ": " + (path.empty() ? "/" : path)};
  }

  static std::string text_of(const Json& object, const char* key) {
    const auto it = object.find(key);
    return it != object.end() && it->is_string() ? it->get<std::string>() : std::string();
  }

  const Json* member(const Json& object, const std::string& path, const char* key) {
    const auto it = object.find(key);
    if (it != object.end()) return &*it;
    fail(path, fmt::format("\"{}\" is missing", key));
    return nullptr;
  }

  double number(const Json& value, const std::string& path) {
    if (value.is_number() && std::isfinite(value.get<double>())) return value.get<double>();
    fail(path, "a finite number is needed");
    return 0;
  }

  double number(const Json& object, const std::string& path, const char* key) {
    const Json* value = member(object, path, key);
    return value ? number(*value, path + "/" + key) : 0;
  }

  double length(const Json& object, const std::string& path, const char* key) {
    const double value = number(object, path, key);
    if (value < 0) fail(path + "/" + key, "a length must not be negative");
    return value;
  }

  int integer(const Json& value, const std::string& path) {
    const double x = number(value, path);
    if (x == std::floor(x) && std::abs(x) <= 2e9) return static_cast<int>(x);
    fail(path, "a whole number is needed");
    return 0;
  }

  int integer(const Json& object, const std::string& path, const char* key) {
    const Json* value = member(object, path, key);
    return value ? integer(*value, path + "/" + key) : 0;
  }

  const Json* array(const Json& object, const std::string& path, const char* key) {
    const Json* value = member(object, path, key);
    if (!value) return nullptr;
    if (value->is_array()) return value;
    fail(path + "/" + key, "an array is needed");
    return nullptr;
  }

  Vec3 vector(const Json& value, const std::string& path) {
    Vec3 v = Vec3::Zero();
    if (!value.is_array() || value.size() != 3) {
      fail(path, "an array of three numbers is needed");
      return v;
    }
    for (int k = 0; k < 3; ++k) v[k] = number(value[k], path + "/" + std::to_string(k));
    return v;
  }

  Vec3 vector(const Json& object, const std::string& path, const char* key) {
    const Json* value = member(object, path, key);
    return value ? vector(*value, path + "/" + key) : Vec3(Vec3::Zero());
  }

  void read_root(const Json& document) {
    const Json* root = member(document, "", "root");
    if (root && !root->is_null()) tree_.root = node(*root, "/root", 1);
  }

  int node(const Json& value, const std::string& path, int depth) {
    if (fault_) return -1;
    if (!value.is_object()) return fail(path, "a node (a JSON object) is needed"), -1;
    if (depth > kDeepestTreeJson) {
      return fail(path, fmt::format("the tree is nested deeper than {} nodes; flatten it",
                                    kDeepestTreeJson)),
             -1;
    }
    const std::string op = text_of(value, "op");
    for (const Op known : {Op::Union, Op::Intersection, Op::Difference, Op::Complement}) {
      if (op == name_of(known)) return operation(known, value, path, depth);
    }
    for (const SolidKind kind : {SolidKind::Box, SolidKind::Cylinder, SolidKind::Prism,
                                 SolidKind::Sphere, SolidKind::Torus, SolidKind::Polyhedron}) {
      if (op == hewn::name_of(kind)) return leaf(kind, value, path);
    }
    fail(path + "/op", op.empty() ? "\"op\" is missing or no text"
                                  : fmt::format("unknown op \"{}\"; known are union, intersection, "
                                                "difference, complement, cube, cylinder, prism, "
                                                "sphere, torus and polyhedron",
                                                op.substr(0, 40)));
    return -1;
  }

  int operation(Op op, const Json& value, const std::string& path, int depth) {
    const Json* list = array(value, path, "children");
    if (!list) return -1;
    if (op == Op::Complement && list->size() != 1) {
      fail(path + "/children", "a complement has exactly one child");
    }
    std::vector<int> children;
    for (std::size_t i = 0; i < list->size() && !fault_; ++i) {
      children.push_back(node((*list)[i], fmt::format("{}/children/{}", path, i), depth + 1));
    }
    return tree_.add_node(op, std::move(children), text_of(value, "name"));
  }

  int leaf(SolidKind kind, const Json& value, const std::string& path) {
    Literal s;
    s.kind = kind;
    s.rotation = rotation(value, path);
    s.origin = vector(value, path, "origin");
    if (value.contains("stretch")) read_stretch(value, path, s);
    read_shape(value, path, s);
    if (value.contains("facets")) read_facets(value["facets"], path + "/facets", s.facets);
    const int index = tree_.add_literal(std::move(s));
    tree_.nodes[index].name = text_of(value, "name");
    return index;
  }

  Mat3 matrix(const Json& value, const std::string& path, const char* key) {
    Mat3 m = Mat3::Identity();
    const Json* list = array(value, path, key);
    if (!list) return m;
    const std::string here = path + "/" + key;
    if (list->size() != 9) return fail(here, "nine numbers are needed, row by row"), m;
    for (int i = 0; i < 9; ++i) {
      m(i / 3, i % 3) = number((*list)[i], here + "/" + std::to_string(i));
    }
    return m;
  }

  void read_stretch(const Json& value, const std::string& path, Literal& s) {
    const Mat3 m = matrix(value, path, "stretch");
    if (fault_) return;
    if (s.kind == SolidKind::Polyhedron) {
      return fail(path + "/stretch", "a polyhedron cannot be stretched; move its vertices");
    }
    const double size = m.cwiseAbs().maxCoeff();
    if (!(std::abs(m.determinant()) > 1e-12 * size * size * size)) {
      return fail(path + "/stretch", "the matrix flattens the solid; its rows must be independent");
    }
    s.stretch = Stretch::of(m);
  }

  Mat3 rotation(const Json& value, const std::string& path) {
    Mat3 m = matrix(value, path, "rotation");
    const std::string here = path + "/rotation";
    const double error = (m.transpose() * m - Mat3::Identity()).cwiseAbs().maxCoeff();
    if (!fault_ && !(error < 1e-6)) fail(here, "the rows must be unit vectors at right angles");
    return m;
  }

  void read_shape(const Json& value, const std::string& path, Literal& s) {
    switch (s.kind) {
      case SolidKind::Box:
        s.size = vector(value, path, "size");
        if (s.size.minCoeff() < 0) fail(path + "/size", "a length must not be negative");
        break;
      case SolidKind::Cylinder:
        s.height = length(value, path, "height");
        s.radius = length(value, path, "radius");
        s.top_radius = length(value, path, "top_radius");
        break;
      case SolidKind::Prism:
        s.sides = integer(value, path, "sides");
        if (s.sides < 3 || s.sides > kMostPrismSides) {
          fail(path + "/sides", fmt::format("a prism has 3 to {} sides", kMostPrismSides));
        }
        s.height = length(value, path, "height");
        s.radius = length(value, path, "radius");
        break;
      case SolidKind::Torus:
        s.major_radius = length(value, path, "major_radius");
        [[fallthrough]];
      case SolidKind::Sphere:
        s.radius = length(value, path, "radius");
        break;
      case SolidKind::Polyhedron:
        s.polyhedron = mesh(value, path);
        if (s.polyhedron) s.polyhedron_query = std::make_shared<const MeshQuery>(s.polyhedron);
        break;
    }
  }

  std::shared_ptr<const Mesh> mesh(const Json& value, const std::string& path) {
    const Json* points = array(value, path, "vertices");
    const Json* faces = array(value, path, "triangles");
    if (!points || !faces) return nullptr;
    std::vector<Vec3> vertices;
    for (std::size_t i = 0; i < points->size() && !fault_; ++i) {
      vertices.push_back(vector((*points)[i], fmt::format("{}/vertices/{}", path, i)));
    }
    std::vector<Triangle> triangles;
    for (std::size_t i = 0; i < faces->size() && !fault_; ++i) {
      triangles.push_back(
          triangle((*faces)[i], fmt::format("{}/triangles/{}", path, i), vertices.size()));
    }
    if (fault_) return nullptr;
    return std::make_shared<const Mesh>(make_mesh(std::move(vertices), std::move(triangles)));
  }

  Triangle triangle(const Json& value, const std::string& path, std::size_t vertex_count) {
    Triangle t = {0, 0, 0};
    if (!value.is_array() || value.size() != 3) {
      fail(path, "an array of three vertex numbers is needed");
      return t;
    }
    for (int k = 0; k < 3 && !fault_; ++k) {
      t[k] = integer(value[k], path + "/" + std::to_string(k));
      if (t[k] < 0 || static_cast<std::size_t>(t[k]) >= vertex_count) {
        fail(path + "/" + std::to_string(k),
             fmt::format("there is no vertex {}; there are {}", t[k], vertex_count));
      }
    }
    return t;
  }

  void read_facets(const Json& value, const std::string& path, Facets& facets) {
    if (!value.is_object()) return fail(path, "an object is needed");
    facets.sides = integer(value, path, "sides");
    facets.phase_rad = number(value, path, "phase_rad");
    facets.tube_sides = integer(value, path, "tube_sides");
    facets.tube_phase_rad = number(value, path, "tube_phase_rad");
  }

  std::string source_;
  Tree tree_;
  std::optional<Error> fault_;
};

bool is_finite(const Literal& s) {
  bool ok = s.rotation.allFinite() && s.origin.allFinite() && s.size.allFinite();
  ok = ok && (!s.stretch || s.stretch->matrix.allFinite());
  for (const double x : {s.height, s.radius, s.top_radius, s.major_radius, s.facets.phase_rad,
                         s.facets.tube_phase_rad}) {
    ok = ok && std::isfinite(x);
  }
  if (!s.polyhedron) return ok;
  for (const Vec3& v : s.polyhedron->vertices) ok = ok && v.allFinite();
  return ok;
}

}  // namespace

std::string tree_to_json(const Tree& tree) {
  Json document;
  document["format"] = kFormat;
  document["version"] = kTreeJsonVersion;
  document["root"] = tree.is_empty() ? Json(nullptr) : to_json(tree, tree.root);
  // Names may hold any bytes: replace what is not UTF-8 instead of throwing.
  return document.dump(1, ' ', false, Json::error_handler_t::replace) + "\n";
}

Result<Tree> tree_from_json(std::string_view text, const std::string& source) {
  try {
    return TreeReader(source).run(Json::parse(text));
  } catch (const nlohmann::json::parse_error& e) {
    return Error{
        ErrorCode::Format,
        fmt::format("this is not valid JSON (fault near byte {}); export the tree again", e.byte),
        source};
  } catch (const nlohmann::json::exception& e) {
    return Error{ErrorCode::Format, fmt::format("the JSON cannot be used: {}", e.what()), source};
  }
}

Result<void> write_tree_json(const Tree& tree, const std::filesystem::path& path) {
  for (std::size_t i = 0; i < tree.literals.size(); ++i) {
    if (is_finite(tree.literals[i])) continue;
    return Error{ErrorCode::InvalidArgument,
                 fmt::format("literal {} ({}) has a number that is not finite", i,
                             hewn::name_of(tree.literals[i].kind)),
                 path.string()};
  }
  return write_file(path, tree_to_json(tree));
}

Result<Tree> read_tree_json(const std::filesystem::path& path) {
  const Result<std::string> text = read_file(path);
  if (!text) return text.error();
  return tree_from_json(*text, path.string());
}

}  // namespace hewn
