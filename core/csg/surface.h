#pragma once
/// The unbounded surfaces that fitting finds and synthesis combines: each splits space in two.
#include "core/base/math.h"
#include "core/compute/kernels/surface_form.h"

namespace hewn {

/// The halfspace bounded by a surface; inside is where the signed distance is negative.
struct Surface {
  SurfaceKind kind = SurfaceKind::Plane;
  Vec3 point = Vec3::Zero();  ///< sphere, torus: centre; cylinder: on the axis; cone: apex
  Vec3 axis = Vec3::UnitZ();  ///< unit; plane: outward normal; cone: from the apex into the solid
  double offset = 0;          ///< plane only: axis . x = offset
  double radius = 0;          ///< sphere, cylinder; torus: of the tube
  double major_radius = 0;    ///< torus only: of the tube's centre line
  double half_angle_rad = 0;  ///< cone only: in (0, pi/2)

  /// Exact Euclidean distance but for the cone (distance to its prolonged flank), negative inside.
  double signed_distance(const Vec3& x) const;
  /// The same surface for kernels, whose distances have the same bits.
  SurfaceForm form() const;
  /// Unit gradient of `signed_distance`: the outward normal.
  Vec3 gradient(const Vec3& x) const;
};

/// A surface made ready for many evaluations, with the same bits: a cone's cosine is taken once.
class SurfaceField {
 public:
  explicit SurfaceField(const Surface& surface) : surface_(surface), form_(surface.form()) {}

  double signed_distance(const Vec3& x) const {
    return hewn::signed_distance(form_, x.x(), x.y(), x.z());
  }
  /// For a kind that is known. Requires: it is the surface's.
  template <SurfaceKind kKind>
  double signed_distance(const Vec3& x) const {
    return hewn::signed_distance<kKind>(form_, x.x(), x.y(), x.z());
  }
  Vec3 gradient(const Vec3& x) const;

 private:
  Surface surface_;
  SurfaceForm form_;
};

/// "plane", "sphere", "cylinder", "cone" or "torus".
const char* name_of(SurfaceKind kind);

/// Number of free parameters of a fit: 3, 4, 5, 6, 7.
int parameter_count(SurfaceKind kind);

}  // namespace hewn
