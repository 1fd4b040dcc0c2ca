#include "core/io/scad_read/scad_matrix.h"

#include <cmath>

#include <fmt/format.h>

#include "core/io/scad_read/scad_parser.h"

namespace hewn {
namespace {

/// Sine of degrees, exact at multiples of 30 where the value is.
double sine(double degrees) {
  double x = std::fmod(degrees, 360.0);
  if (x < 0) x += 360;
  const double sign = x >= 180 ? -1 : 1;
  if (x >= 180) x -= 180;
  if (x > 90) x = 180 - x;
  if (x == 0) return 0;
  if (x == 30) return sign * 0.5;
  if (x == 90) return sign;
  return sign * std::sin(x * kPi / 180);
}

double cosine(double degrees) { return sine(degrees + 90); }

Mat3 turn(int axis, double degrees) {
  const int u = (axis + 1) % 3;
  const int v = (axis + 2) % 3;
  Mat3 m = Mat3::Identity();
  m(u, u) = m(v, v) = cosine(degrees);
  m(v, u) = sine(degrees);
  m(u, v) = -m(v, u);
  return m;
}

/// Rodrigues' formula.
Mat3 turn_about(const Vec3& axis, double degrees) {
  const double length = axis.norm();
  if (length == 0) return Mat3::Identity();
  for (int k = 0; k < 3; ++k) {
    if (std::abs(axis[k]) == length) return turn(k, axis[k] > 0 ? degrees : -degrees);
  }
  const Vec3 n = axis / length;
  Mat3 cross;
  cross << 0, -n.z(), n.y(), n.z(), 0, -n.x(), -n.y(), n.x(), 0;
  return Mat3::Identity() + sine(degrees) * cross + (1 - cosine(degrees)) * cross * cross;
}

class MatrixReader {
 public:
  MatrixReader(const ScadNode& node, const std::string& source) : node_(node), source_(source) {}

  Result<Affine3> run() {
    Affine3 map = Affine3::Identity();
    if (node_.name == "translate") map.translation() = vector("v", 0, Vec3::Zero());
    if (node_.name == "rotate") map.linear() = rotation();
    if (node_.name == "scale") map.linear() = scaling().asDiagonal();
    if (node_.name == "mirror") map.linear() = reflection();
    if (node_.name == "multmatrix") read_matrix(map);
    if (fault_) return *fault_;
    const Mat3 m = map.linear();
    const double size = m.cwiseAbs().maxCoeff();
    if (!m.allFinite() || !map.translation().allFinite()) {
      fail("the transformation is not finite");
    } else if (!(std::abs(m.determinant()) > 1e-12 * size * size * size)) {
      fail("this transformation flattens what it moves; no length may become zero");
    }
    if (fault_) return *fault_;
    return map;
  }

 private:
  void fail(std::string message) {
    if (fault_) return;
    fault_ = Error{ErrorCode::Format, fmt::format("{}: {}", node_.name, message),
                   at_place(source_, node_.place)};
  }

  Vec3 vector(std::string_view name, int position, const Vec3& otherwise, double missing = 0) {
    const ScadValue* value = node_.argument(name, position);
    if (!value) return otherwise;
    const auto v = value->vector(missing);
    if (!v) fail(fmt::format("'{}' must be a vector of two or three numbers", name));
    return v.value_or(otherwise);
  }

  Mat3 rotation() {
    const ScadValue* angle = node_.argument("a", 0);
    if (!angle) return fail("an angle is missing"), Mat3::Identity();
    if (const double* a = angle->number()) {
      return turn_about(vector("v", 1, Vec3::UnitZ()), *a);
    }
    const auto v = angle->vector();
    if (!v) return fail("the angles must be one number or a vector of three"), Mat3::Identity();
    return turn(2, v->z()) * turn(1, v->y()) * turn(0, v->x());
  }

  Vec3 scaling() {
    const ScadValue* value = node_.argument("v", 0);
    if (value && value->number()) return Vec3::Constant(*value->number());
    return vector("v", 0, Vec3::Ones(), 1);
  }

  Mat3 reflection() {
    const Vec3 n = vector("v", 0, Vec3::UnitX());
    const double length2 = n.squaredNorm();
    if (length2 == 0) return Mat3::Identity();
    return Mat3::Identity() - 2 / length2 * n * n.transpose();
  }

  void read_matrix(Affine3& map) {
    const ScadValue* value = node_.argument("m", 0);
    const auto* rows = value ? value->list() : nullptr;
    if (!rows || rows->size() < 3 || rows->size() > 4) return fail("a matrix of 3 or 4 rows");
    for (std::size_t i = 0; i < 3; ++i) {
      const auto* row = (*rows)[i].list();
      if (!row || row->size() < 3 || row->size() > 4) {
        return fail("each row of the matrix needs 3 or 4 numbers");
      }
      for (std::size_t k = 0; k < row->size(); ++k) {
        const double* x = (*row)[k].number();
        if (!x) return fail("each row of the matrix needs 3 or 4 numbers");
        map.matrix()(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(k)) = *x;
      }
    }
  }

  const ScadNode& node_;
  const std::string& source_;
  std::optional<Error> fault_;
};

}  // namespace

bool is_transformation(std::string_view name) {
  return name == "translate" || name == "rotate" || name == "scale" || name == "mirror" ||
         name == "multmatrix";
}

Result<Affine3> scad_transformation(const ScadNode& node, const std::string& source) {
  return MatrixReader(node, source).run();
}

}  // namespace hewn
