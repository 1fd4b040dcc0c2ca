#include "core/io/scad_read/scad_solid.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "core/csg/prism.h"
#include "core/io/scad_read/scad_matrix.h"
#include "core/io/scad_read/scad_parser.h"
#include "core/mesh/load.h"

namespace hewn {
namespace {

/// Two rings of corners, or one and an apex, as a closed mesh around z.
Mesh faceted_cone(int sides, double bottom, double top, double height) {
  std::vector<Vec3> vertices;
  const auto ring = [&](double radius, double z) {
    if (radius == 0) {
      vertices.emplace_back(0, 0, z);
      return;
    }
    for (int k = 0; k < sides; ++k) {
      const double angle = 2 * kPi * k / sides;
      vertices.emplace_back(radius * std::cos(angle), radius * std::sin(angle), z);
    }
  };
  ring(bottom, 0);
  const int first = static_cast<int>(vertices.size());
  ring(top, height);
  const auto low = [&](int k) { return bottom == 0 ? 0 : k % sides; };
  const auto high = [&](int k) { return top == 0 ? first : first + k % sides; };
  std::vector<Triangle> triangles;
  for (int k = 0; k < sides; ++k) {
    if (bottom > 0) triangles.push_back({low(k), low(k + 1), high(k)});
    if (top > 0) triangles.push_back({low(k + 1), high(k + 1), high(k)});
    if (k > 0 && k + 1 < sides) {
      if (bottom > 0) triangles.push_back({low(0), low(k + 1), low(k)});
      if (top > 0) triangles.push_back({high(0), high(k), high(k + 1)});
    }
  }
  return make_mesh(std::move(vertices), std::move(triangles));
}

class SolidReader {
 public:
  SolidReader(const ScadNode& node, const ScadScope& scope, const std::string& source)
      : node_(node), scope_(scope), source_(source) {}

  Result<Literal> run() {
    Literal s;
    if (node_.name == "cube") s = cube();
    if (node_.name == "cylinder") s = cylinder();
    if (node_.name == "prism") s = regular_prism();
    if (node_.name == "sphere") s = sphere();
    if (node_.name == "polyhedron") s = polyhedron();
    if (node_.name == "rotate_extrude") s = torus();
    if (fault_) return *fault_;
    return s;
  }

 private:
  void fail(std::string message, ErrorCode code = ErrorCode::Format) {
    if (fault_) return;
    fault_ =
        Error{code, fmt::format("{}: {}", node_.name, message), at_place(source_, node_.place)};
  }

  double positive(double value, std::string_view what) {
    if (!(value > 0)) fail(fmt::format("{} must be greater than zero, not {}", what, value));
    return value;
  }

  std::optional<double> number(const ScadNode& node, std::string_view name, int position = -1) {
    const ScadValue* value = node.argument(name, position);
    if (!value || value->is_undefined()) return std::nullopt;
    const double* x = value->number();
    if (!x) fail(fmt::format("'{}' must be a number", name));
    return x ? std::optional(*x) : std::nullopt;
  }

  bool is_centered(int position) {
    const ScadValue* value = node_.argument("center", position);
    if (!value || value->is_undefined()) return false;
    if (const bool* b = value->truth()) return *b;
    if (const double* x = value->number()) return *x != 0;
    fail("'center' must be true or false");
    return false;
  }

  /// Explicit sides, 0 when circles are smooth as the viewer likes.
  int sides(const ScadNode& node) {
    const ScadValue* own = node.argument("$fn");
    const ScadValue* value = own ? own : node_.argument("$fn");
    if (!value) value = &scope_.sides;
    const double* n = value->number();
    if (!n || *n <= 0) return 0;
    return static_cast<int>(std::clamp(*n, 3.0, 1e6));
  }

  bool is_prism(int n) const { return n > 0 && n <= scope_.most_prism_sides; }

  Literal cube() {
    Literal s;
    s.size = Vec3::Ones();
    if (const ScadValue* size = node_.argument("size", 0)) {
      if (const double* edge = size->number()) {
        s.size = Vec3::Constant(*edge);
      } else if (const auto v = size->vector(); v && size->list()->size() == 3) {
        s.size = *v;
      } else {
        fail("'size' must be a number or three");
      }
    }
    positive(s.size.minCoeff(), "every size");
    if (is_centered(1)) s.origin = -s.size / 2;
    return s;
  }

  Literal cylinder() {
    Literal s;
    s.kind = SolidKind::Cylinder;
    s.height = positive(number(node_, "h", 0).value_or(1), "the height");
    const auto r = number(node_, "r");
    const auto d = number(node_, "d");
    s.radius = s.top_radius = d ? *d / 2 : r.value_or(1);
    if (const auto r1 = number(node_, "r1", 1)) s.radius = *r1;
    if (const auto r2 = number(node_, "r2", 2)) s.top_radius = *r2;
    if (const auto d1 = number(node_, "d1")) s.radius = *d1 / 2;
    if (const auto d2 = number(node_, "d2")) s.top_radius = *d2 / 2;
    if (s.radius < 0 || s.top_radius < 0) fail("a radius must not be negative");
    positive(std::max(s.radius, s.top_radius), "the radius");
    const double base = is_centered(3) ? -s.height / 2 : 0;
    const int n = sides(node_);
    if (fault_) return s;
    if (is_prism(n) && s.radius == s.top_radius) {
      s.kind = SolidKind::Prism;
      s.sides = n;
      s.radius *= std::cos(kPi / n);
      s.origin.z() = base;
      return s;
    }
    if (is_prism(n)) {
      const Mesh mesh = faceted_cone(n, s.radius, s.top_radius, s.height);
      s = polyhedron_literal(std::make_shared<const Mesh>(mesh));
      return transformed(s, Affine3(Eigen::Translation3d(0, 0, base)));
    }
    s.origin.z() = base;
    s.facets.sides = n;
    return s;
  }

  Literal regular_prism() {
    Literal s;
    s.kind = SolidKind::Prism;
    const double sides = number(node_, "sides", 0).value_or(0);
    if (!(sides >= 3 && sides <= kMostPrismSides) || sides != std::floor(sides)) {
      fail(fmt::format("'sides' must be a whole number from 3 to {}", kMostPrismSides));
      return s;
    }
    s.sides = static_cast<int>(sides);
    s.radius = positive(number(node_, "r", 1).value_or(0), "the radius");
    s.height = positive(number(node_, "h", 2).value_or(0), "the height");
    return s;
  }

  Literal sphere() {
    Literal s;
    s.kind = SolidKind::Sphere;
    const auto d = number(node_, "d");
    s.radius = positive(d ? *d / 2 : number(node_, "r", 0).value_or(1), "the radius");
    s.facets.sides = sides(node_);
    if (is_prism(s.facets.sides)) {
      fail("a sphere of so few sides is a polyhedron", ErrorCode::NotFound);
    }
    return s;
  }

  /// The circle's centre and radius when the profile is one, moved but not stretched.
  void find_circle(const ScadNode& node, const Affine3& map, Literal& s) {
    if (is_transformation(node.name) && node.children.size() == 1) {
      const auto next = scad_transformation(node, source_);
      if (!next) {
        fault_ = next.error();
        return;
      }
      return find_circle(node.children[0], map * *next, s);
    }
    if ((node.name == "group" || node.name == "union") && node.children.size() == 1) {
      return find_circle(node.children[0], map, s);
    }
    const Vec3 x = map.linear().col(0);
    const Vec3 y = map.linear().col(1);
    const double scale = x.norm();
    const bool is_circle = node.name == "circle" && std::abs(x.dot(y)) <= 1e-12 * scale * scale &&
                           std::abs(y.norm() - scale) <= 1e-12 * scale && x.z() == 0 && y.z() == 0;
    if (!is_circle) return fail("only circles can be turned to a torus", ErrorCode::NotFound);
    const auto d = number(node, "d");
    s.radius = positive(d ? *d / 2 : number(node, "r", 0).value_or(1), "the radius") * scale;
    const Vec3 center = map.translation();
    // The profile's y becomes z; a profile on the negative side is turned all the same.
    s.major_radius = std::abs(center.x());
    s.origin.z() = center.y();
    s.facets.sides = sides(node_);
    s.facets.tube_sides = sides(node);
    if (is_prism(s.facets.sides) || is_prism(s.facets.tube_sides)) {
      fail("a ring of so few sides is a polyhedron", ErrorCode::NotFound);
    }
    if (s.major_radius < s.radius) fail("the circle must not cross the axis");
  }

  Literal torus() {
    Literal s;
    s.kind = SolidKind::Torus;
    if (number(node_, "angle").value_or(360) != 360 || node_.children.size() != 1) {
      fail("only a full turn of one profile is understood", ErrorCode::NotFound);
      return s;
    }
    find_circle(node_.children[0], Affine3::Identity(), s);
    return s;
  }

  Literal polyhedron() {
    const ScadValue* points = node_.argument("points", 0);
    const ScadValue* faces = node_.argument("faces", 1);
    if (!faces) faces = node_.argument("triangles");
    if (!points || !points->list() || !faces || !faces->list()) {
      fail("'points' and 'faces' are needed");
      return {};
    }
    std::vector<Vec3> vertices;
    for (const ScadValue& p : *points->list()) {
      const auto v = p.vector();
      if (!v || p.list()->size() != 3) return fail("a point needs three numbers"), Literal{};
      vertices.push_back(*v);
    }
    std::vector<Triangle> triangles;
    for (const ScadValue& f : *faces->list()) add_face(f, vertices.size(), triangles);
    if (fault_) return {};
    return closed_mesh(std::move(vertices), std::move(triangles));
  }

  void add_face(const ScadValue& face, std::size_t vertices, std::vector<Triangle>& out) {
    std::vector<int> corners;
    if (!face.list() || face.list()->size() < 3) return fail("a face needs three corners");
    for (const ScadValue& c : *face.list()) {
      const double* x = c.number();
      if (!x || *x < 0 || *x >= static_cast<double>(vertices) || *x != std::floor(*x)) {
        return fail(fmt::format("a face names a point that is not among the {}", vertices));
      }
      corners.push_back(static_cast<int>(*x));
    }
    // Clockwise seen from outside; convex as OpenSCAD's own output is.
    for (std::size_t k = 2; k < corners.size(); ++k) {
      out.push_back({corners[0], corners[k], corners[k - 1]});
    }
  }

  Literal closed_mesh(std::vector<Vec3> vertices, std::vector<Triangle> triangles) {
    auto mended = repair_mesh(std::move(vertices), std::move(triangles), {}, RunContext{});
    if (!mended) return fail(mended.error().message), Literal{};
    if (!mended->report.is_closed) {
      fail("the faces do not close; give every edge two faces");
      return {};
    }
    return polyhedron_literal(std::make_shared<const Mesh>(std::move(mended->mesh)));
  }

  const ScadNode& node_;
  const ScadScope& scope_;
  const std::string& source_;
  std::optional<Error> fault_;
};

}  // namespace

bool is_solid(std::string_view name) {
  return name == "cube" || name == "cylinder" || name == "prism" || name == "sphere" ||
         name == "polyhedron" || name == "rotate_extrude";
}

Result<Literal> scad_solid(const ScadNode& node, const ScadScope& scope,
                           const std::string& source) {
  return SolidReader(node, scope, source).run();
}

}  // namespace hewn
