#include "core/csg/boundary/same_surface.h"

#include <cmath>

namespace hewn {
namespace {

constexpr double kParallel = 1e-6;

bool are_coplanar(const BoundaryModel& model, const BoundaryPatch& a, const BoundaryPatch& b) {
  const PatchPoint p = point_on(model.literal_of(a), a, 0.5, 0.5);
  const PatchPoint q = point_on(model.literal_of(b), b, 0.5, 0.5);
  return p.normal.cross(q.normal).norm() < kParallel &&
         std::abs(p.normal.dot(p.position - q.position)) < 2 * model.same();
}

bool is_round(const BoundaryPatch& patch, const Literal& literal) {
  const bool is_cylinder = patch.shape == PatchShape::Side && literal.radius == literal.top_radius;
  return !literal.stretch && (is_cylinder || patch.shape == PatchShape::Sphere);
}

/// Requires: both are round.
bool have_same_centre(const BoundaryModel& model, const Literal& a, const Literal& b,
                      PatchShape shape) {
  const Vec3 apart = b.to_world(Vec3::Zero()) - a.to_world(Vec3::Zero());
  if (shape == PatchShape::Sphere) return apart.norm() < model.same();
  const Vec3 axis = a.rotation.col(2);
  return axis.cross(b.rotation.col(2)).norm() < kParallel &&
         (apart - axis * axis.dot(apart)).norm() < model.same();
}

}  // namespace

bool on_same_surface(const BoundaryModel& model, const BoundaryPatch& a, const BoundaryPatch& b) {
  if (a.is_flat && b.is_flat) return are_coplanar(model, a, b);
  const Literal& first = model.literal_of(a);
  const Literal& second = model.literal_of(b);
  return a.shape == b.shape && is_round(a, first) && is_round(b, second) &&
         std::abs(first.radius - second.radius) < model.same() &&
         have_same_centre(model, first, second, a.shape);
}

}  // namespace hewn
