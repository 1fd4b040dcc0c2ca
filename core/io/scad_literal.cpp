#include "core/io/scad_literal.h"

#include <algorithm>
#include <array>
#include <map>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "core/csg/prism.h"
#include "core/io/scad_prism.h"

namespace hewn {
namespace {

using Steps = std::int64_t;
using Steps3 = std::array<Steps, 3>;

class LiteralPrinter {
 public:
  LiteralPrinter(const Literal& literal, const Mat3& frame, const ScadStyle& style)
      : literal_(literal), frame_(frame), style_(style) {}

  std::string aligned(const std::string& indent) const {
    if (literal_.stretch) return stretched();
    switch (literal_.kind) {
      case SolidKind::Box:
        return box();
      case SolidKind::Cylinder:
      case SolidKind::Prism:
        return upright();
      case SolidKind::Sphere:
        return translate(quantized(center())) + facet_turn(Mat3::Identity(), 0) + sphere_call();
      case SolidKind::Torus: {
        const int k = along_column(frame_, literal_.rotation.col(2), style_.tolerance_rad).index;
        return translate(quantized(center())) + axis_turn(k) + facet_turn(axis_matrix(k), kPi) +
               torus_call();
      }
      case SolidKind::Polyhedron:
        return polyhedron(indent);
    }
    return ";";
  }

  std::string turned() const {
    const Vec3 axis = frame_.transpose() * literal_.rotation.col(2);
    const double length = std::max({literal_.height, literal_.radius, literal_.top_radius,
                                    literal_.major_radius + literal_.radius});
    const AxisRotation turn = print_axis_rotation(axis, true, style_.slack / length);
    const std::string rotate = turn.printed.text() + facet_turn(turn.matrix, torus_phase());
    if (literal_.kind == SolidKind::Torus) {
      return translate(quantized(center())) + rotate + torus_call();
    }
    const Vec3 base = turn.is_flipped ? Vec3(center() + axis * literal_.height) : center();
    const Steps height = std::max<Steps>(1, quantize(literal_.height));
    return translate(quantized(base)) + rotate + upright_call(height, turn.is_flipped, false);
  }

 private:
  Steps quantize(double x) const { return style_.grid.quantize(x); }
  std::string text(Steps q) const { return style_.grid.text(q); }
  Steps positive(double x) const { return std::max<Steps>(1, quantize(x)); }

  /// Of the literal's local origin, in frame coordinates.
  Vec3 center() const { return frame_.transpose() * (literal_.rotation * literal_.origin); }

  Steps3 quantized(const Vec3& p) const {
    return {quantize(p.x()), quantize(p.y()), quantize(p.z())};
  }

  std::string vector(const Steps3& q) const {
    return fmt::format("[{}, {}, {}]", text(q[0]), text(q[1]), text(q[2]));
  }

  std::string translate(const Steps3& q) const {
    return q == Steps3{0, 0, 0} ? "" : "translate(" + vector(q) + ") ";
  }

  std::string box() const {
    Mat3 permutation;
    as_signed_permutation(frame_.transpose() * literal_.rotation, style_.tolerance_rad,
                          permutation);
    // Both ends are rounded, not the size: faces that coincide print as the same number.
    const Vec3 a = permutation * literal_.origin;
    const Vec3 b = permutation * (literal_.origin + literal_.size);
    const Steps3 lo = quantized(a.cwiseMin(b));
    const Steps3 hi = quantized(a.cwiseMax(b));
    Steps3 size;
    bool is_centered = true;
    for (int k = 0; k < 3; ++k) {
      size[k] = std::max<Steps>(1, hi[k] - lo[k]);
      is_centered = is_centered && lo[k] == -hi[k] && hi[k] > 0;
    }
    const bool is_cube = size[0] == size[1] && size[1] == size[2];
    const std::string extent = is_cube ? text(size[0]) : vector(size);
    if (is_centered) return "cube(" + extent + ", center = true);";
    return translate(lo) + "cube(" + extent + ");";
  }

  /// A cylinder or prism.
  std::string upright() const {
    const AlongColumn axis = along_column(frame_, literal_.rotation.col(2), style_.tolerance_rad);
    const int k = axis.index;
    const double z = literal_.origin.z();
    const Steps near = quantize(axis.sign * z);
    const Steps far = quantize(axis.sign * (z + literal_.height));
    const Steps lo = std::min(near, far);
    const Steps height = std::max<Steps>(1, std::max(near, far) - lo);
    // rotate([90, 0, 0]) takes z to -y: such a cylinder starts at its far end.
    const bool starts_far = k == 1;
    const bool is_flipped = (axis.sign < 0) != starts_far;
    const bool is_centered = literal_.kind == SolidKind::Cylinder && lo * 2 == -height;
    Steps3 position = quantized(center());
    position[k] = is_centered ? 0 : starts_far ? lo + height : lo;
    return translate(position) + axis_turn(k) + facet_turn(axis_matrix(k), 0) +
           upright_call(height, is_flipped, is_centered);
  }

  std::string upright_call(Steps height, bool is_flipped, bool is_centered) const {
    if (literal_.kind != SolidKind::Prism) return cylinder_call(height, is_flipped, is_centered);
    const std::string inner = text(positive(literal_.radius));
    // A coarse circle reads best as what it was.
    if (literal_.sides <= kMostPolygonSides) {
      const std::string outer = text(positive(circumradius(literal_)));
      if (outer.size() < inner.size()) {
        return fmt::format("cylinder(h = {}, r = {}, $fn = {});", text(height), outer,
                           literal_.sides);
      }
    }
    return fmt::format("prism(sides = {}, r = {}, h = {});", literal_.sides, inner, text(height));
  }

  static std::string axis_turn(int k) {
    return k == 0 ? "rotate([0, 90, 0]) " : k == 1 ? "rotate([90, 0, 0]) " : "";
  }

  static Mat3 axis_matrix(int k) {
    if (k == 0) return Eigen::AngleAxisd(kPi / 2, Vec3::UnitY()).toRotationMatrix();
    if (k == 1) return Eigen::AngleAxisd(kPi / 2, Vec3::UnitX()).toRotationMatrix();
    return Mat3::Identity();
  }

  /// OpenSCAD starts a full revolution on the negative x axis.
  double torus_phase() const { return literal_.kind == SolidKind::Torus ? kPi : 0; }

  bool has_facets() const { return style_.match_facets && literal_.facets.sides >= 3; }

  /// The turn about the printed z axis that brings the first vertex to the literal's own: the
  /// mesh's, or a prism's first corner.
  std::string facet_turn(const Mat3& printed, double first_vertex_rad) const {
    const bool is_prism = literal_.kind == SolidKind::Prism;
    if (!is_prism && !has_facets()) return "";
    if (literal_.kind == SolidKind::Sphere) return sphere_turn();
    const double phase = is_prism ? 0 : literal_.facets.phase_rad;
    const Vec3 vertex = literal_.rotation * Vec3(std::cos(phase), std::sin(phase), 0);
    const Vec3 local = printed.transpose() * (frame_.transpose() * vertex);
    return turn_about_z(std::atan2(local.y(), local.x()) - first_vertex_rad,
                        is_prism ? literal_.sides : literal_.facets.sides);
  }

  std::string turn_about_z(double angle_rad, int sides) const {
    const double step = 2 * kPi / sides;
    const double reach =
        std::max({literal_.radius, literal_.top_radius, literal_.major_radius + literal_.radius});
    const double tolerance = style_.slack / reach;
    double angle = std::fmod(angle_rad, step);
    if (angle < 0) angle += step;
    if (angle < tolerance || step - angle < tolerance) return "";
    const double degrees = 180 / kPi;
    return "rotate([0, 0, " + shortest_decimal(angle * degrees, tolerance * degrees) + "]) ";
  }

  /// A sphere's rings lie about its own z axis.
  std::string sphere_turn() const {
    const double tolerance = style_.slack / literal_.radius;
    const Mat3 turn = frame_.transpose() * literal_.rotation *
                      Eigen::AngleAxisd(literal_.facets.phase_rad, Vec3::UnitZ());
    const double c = turn(2, 2);
    if (std::abs(std::abs(c) - 1) > tolerance * tolerance) {
      return print_rotation(turn, tolerance).text();
    }
    return turn_about_z(std::atan2(turn(1, 0), turn(0, 0)), literal_.facets.sides);
  }

  std::string own_sides(int sides) const {
    return style_.match_facets && sides >= 3 ? ", $fn = " + std::to_string(sides) : "";
  }

  std::string cylinder_call(Steps height, bool is_flipped, bool is_centered) const {
    Steps bottom = quantize(literal_.radius);
    Steps top = quantize(literal_.top_radius);
    if (is_flipped) std::swap(bottom, top);
    if (bottom == 0 && top == 0) bottom = top = 1;
    std::string call = "cylinder(h = " + text(height);
    call +=
        bottom == top ? ", r = " + text(bottom) : ", r1 = " + text(bottom) + ", r2 = " + text(top);
    if (is_centered) call += ", center = true";
    return call + own_sides(literal_.facets.sides) + ");";
  }

  std::string sphere_call() const {
    return "sphere(r = " + text(positive(literal_.radius)) + own_sides(literal_.facets.sides) +
           ");";
  }

  std::string torus_call() const {
    const Steps tube = positive(literal_.radius);
    const Steps major = std::max<Steps>(0, quantize(literal_.major_radius));
    const int sides = literal_.facets.tube_sides;
    std::string turn;
    if (has_facets() && sides >= 3) turn = turn_about_z(literal_.facets.tube_phase_rad, sides);
    const std::string ring = "translate([" + text(major) + ", 0]) " + turn +
                             "circle(r = " + text(tube) + own_sides(sides) + ");";
    const std::string around = style_.match_facets && literal_.facets.sides >= 3
                                   ? "$fn = " + std::to_string(literal_.facets.sides)
                                   : "";
    const std::string extrude = "rotate_extrude(" + around + ") ";
    if (major >= tube) return extrude + ring;
    // OpenSCAD refuses profiles that cross the axis: a spindle torus is cut there.
    return extrude + "intersection() { " + ring + " translate([0, " + text(-tube) + "]) square([" +
           text(major + tube) + ", " + text(2 * tube) + "]); }";
  }

  std::string polyhedron(const std::string& indent) const {
    if (!literal_.polyhedron) return "cube(0);";
    std::map<Steps3, int> index_of;
    std::vector<Steps3> points;
    std::vector<int> renumbered;
    for (const Vec3& v : literal_.polyhedron->vertices) {
      const Steps3 q = quantized(frame_.transpose() * literal_.to_world(v));
      const auto [it, is_new] = index_of.try_emplace(q, static_cast<int>(points.size()));
      if (is_new) points.push_back(q);
      renumbered.push_back(it->second);
    }
    std::string body = "polyhedron(\n" + indent + "  points = [";
    for (std::size_t i = 0; i < points.size(); ++i) {
      body += separator(i, 4, indent) + vector(points[i]);
    }
    body += "],\n" + indent + "  faces = [";
    std::size_t n = 0;
    const bool is_mirrored = literal_.rotation.determinant() * frame_.determinant() < 0;
    for (const Triangle& t : literal_.polyhedron->triangles) {
      std::array<int, 3> f = {renumbered[t[0]], renumbered[t[1]], renumbered[t[2]]};
      if (f[0] == f[1] || f[1] == f[2] || f[2] == f[0]) continue;
      // OpenSCAD wants clockwise faces, seen from outside.
      if (!is_mirrored) std::swap(f[1], f[2]);
      body += separator(n++, 6, indent) + fmt::format("[{}, {}, {}]", f[0], f[1], f[2]);
    }
    return body + "],\n" + indent + "  convexity = 10);";
  }

  /// The canonical solid under one matrix.
  std::string stretched() const {
    const double slack = style_.slack / literal_.bounds().diagonal();
    const Mat3 map = frame_.transpose() * literal_.rotation * literal_.stretch->matrix;
    Literal plain = literal_;
    plain.stretch.reset();
    plain.rotation.setIdentity();
    plain.origin.setZero();
    // The solid itself may be of any size before the matrix: print it as a unit solid.
    const double unit = canonical_size(plain);
    const Steps3 at = quantized(center());
    std::string rows;
    for (int i = 0; i < 3; ++i) {
      rows += "[";
      for (int k = 0; k < 3; ++k) rows += shortest_decimal(map(i, k) * unit, slack * unit) + ", ";
      rows += text(at[i]) + "], ";
    }
    return "multmatrix([" + rows + "[0, 0, 0, 1]]) " + unit_call(plain, unit);
  }

  static double canonical_size(const Literal& s) {
    return std::max({s.size.maxCoeff(), s.height, s.radius, s.top_radius, s.major_radius});
  }

  std::string unit_call(const Literal& s, double unit) const {
    // Lengths at the scale of 1, where the grid of the file means nothing.
    const auto part = [&](double x) { return shortest_decimal(x / unit, 1e-9); };
    if (s.kind == SolidKind::Box) {
      return fmt::format("cube([{}, {}, {}]);", part(s.size.x()), part(s.size.y()),
                         part(s.size.z()));
    }
    if (s.kind == SolidKind::Sphere) {
      return "sphere(r = " + part(s.radius) + own_sides(s.facets.sides) + ");";
    }
    if (s.kind == SolidKind::Torus) {
      return "rotate_extrude() translate([" + part(s.major_radius) +
             ", 0]) circle(r = " + part(s.radius) + ");";
    }
    if (s.kind == SolidKind::Prism) {
      return fmt::format("prism(sides = {}, r = {}, h = {});", s.sides, part(s.radius),
                         part(s.height));
    }
    return "cylinder(h = " + part(s.height) + ", r1 = " + part(s.radius) +
           ", r2 = " + part(s.top_radius) + own_sides(s.facets.sides) + ");";
  }

  static std::string separator(std::size_t i, std::size_t per_line, const std::string& indent) {
    if (i == 0) return "";
    return i % per_line == 0 ? ",\n" + indent + "    " : ", ";
  }

  const Literal& literal_;
  const Mat3& frame_;
  const ScadStyle& style_;
};

}  // namespace

std::string print_aligned(const Literal& literal, const Mat3& frame, const ScadStyle& style,
                          const std::string& indent) {
  return LiteralPrinter(literal, frame, style).aligned(indent);
}

std::string print_turned(const Literal& literal, const Mat3& frame, const ScadStyle& style) {
  return LiteralPrinter(literal, frame, style).turned();
}

}  // namespace hewn
