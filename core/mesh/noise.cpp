// How exact the coordinates are, judged from the data alone.
#include <algorithm>
#include <cmath>

#include "core/mesh/edge_use.h"
#include "core/mesh/repair.h"

namespace hewn {
namespace {

double median(std::vector<double>& values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

/// The fewest significant decimal digits that give `x` back; 18 when even 17 are not enough.
int significant_digits(double x) {
  const double magnitude = std::abs(x);
  if (!(magnitude > 0)) return 0;
  const int exponent = static_cast<int>(std::floor(std::log10(magnitude)));
  double scaled = magnitude / std::pow(10.0, exponent);
  for (int digits = 1; digits < 13; ++digits, scaled *= 10) {
    if (std::abs(scaled - std::round(scaled)) <= scaled * 4e-15) return digits;
  }
  return 18;
}

/// Half of the last decimal place (or single-precision bit) that the coordinates were written with;
/// 0 when they show no common rounding.
double rounding_of(const Mesh& mesh) {
  const double diagonal = mesh.diagonal();
  double largest = 0;
  int digits = 0;
  bool is_single = true;
  for (const Vec3& p : mesh.vertices) {
    for (const double c : p) {
      largest = std::max(largest, std::abs(c));
      is_single = is_single && static_cast<double>(static_cast<float>(c)) == c;
    }
  }
  // The small coordinates of a fixed-point file have fewer digits: lift all to the same length.
  const int lift_exponent = static_cast<int>(std::floor(std::log10(largest))) + 2;
  const double lift = std::pow(10.0, lift_exponent);
  const std::size_t step = std::max<std::size_t>(1, mesh.vertices.size() / 2000);
  for (std::size_t i = 0; i < mesh.vertices.size(); i += step) {
    for (const double c : mesh.vertices[i]) {
      digits = std::max(digits, significant_digits(std::abs(c) + lift));
    }
  }
  const double decimal = digits < 18 ? 0.5 * std::pow(10.0, lift_exponent + 1 - digits) : 0;
  // Few digits are a designer's round dimensions, not rounding.
  if (decimal > 0 && decimal <= 1e-5 * diagonal) return decimal;
  const double single = largest * 0x1p-24;
  return is_single && decimal == 0 ? single : 0;
}

/// Offset of the other triangle's far corner from this one's plane, over the root sum of squares of
/// the four vertices' influence on it. False for folds and zero-area triangles.
bool measure_offset(const Mesh& mesh, const EdgeSide& side, const EdgeSide& other, double& offset) {
  constexpr double kCosFold = 0.9;
  const int t = side.triangle();
  if (mesh.normals[t].dot(mesh.normals[other.triangle()]) < kCosFold) return false;
  const Vec3 a = mesh.corner(t, 0);
  const Vec3 ab = mesh.corner(t, 1) - a;
  const Vec3 ac = mesh.corner(t, 2) - a;
  const Vec3 d = mesh.corner(other.triangle(), (other.corner() + 2) % 3) - a;
  const Vec3& normal = mesh.normals[t];
  const double twice_area = 2 * mesh.areas[t];
  if (!(twice_area > 0)) return false;
  const double v = normal.dot(d.cross(ac)) / twice_area;
  const double w = normal.dot(ab.cross(d)) / twice_area;
  const double u = 1 - v - w;
  offset = normal.dot(d) / std::sqrt(1 + u * u + v * v + w * w);
  return true;
}

/// The standard deviation of the vertices about the faces that they are meant to lie on, from
/// neighbouring triangles that are nearly coplanar; 0 when there are too few of them.
double flatness_noise(const Mesh& mesh, std::span<const EdgeSide> sides) {
  const double limit = 1e-4 * mesh.diagonal();
  std::vector<double> offsets;
  std::size_t edges = 0;
  for_each_edge(sides, [&](std::span<const EdgeSide> edge) {
    if (edge.size() != 2) return;
    ++edges;
    double offset = 0;
    if (!measure_offset(mesh, edge[0], edge[1], offset)) return;
    if (std::abs(offset) <= limit) offsets.push_back(offset);
  });
  if (offsets.size() < 12 || offsets.size() * 20 < edges) return 0;
  // About the median, because on a finely meshed curved face all offsets lean to one side.
  const double middle = median(offsets);
  for (double& o : offsets) o = std::abs(o - middle);
  constexpr double kMadToSigma = 1.4826;
  return kMadToSigma * median(offsets);
}

}  // namespace

double estimate_noise(const Mesh& mesh, std::span<const EdgeSide> sides) {
  return std::max(rounding_of(mesh), flatness_noise(mesh, sides));
}

}  // namespace hewn
