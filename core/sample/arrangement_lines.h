#pragma once
/// Lines and circles beside the faces and edges of literals. Internal to core/sample.
#include <vector>

#include "core/base/rng.h"
#include "core/csg/literal.h"

namespace hewn {

struct ProbeLine {
  Vec3 point = Vec3::Zero();
  Vec3 direction = Vec3::UnitX();
};

/// center + radius (cos u + sin w), in space; `u` and `w` hold the radius.
struct ProbeCircle {
  Vec3 center = Vec3::Zero();
  Vec3 u = Vec3::UnitX(), w = Vec3::UnitY();
};

struct Probes {
  std::vector<ProbeLine> lines;
  std::vector<ProbeCircle> circles;
};

/// Lines and circles that run `offset` inside and outside of the literal's faces, some of them
/// along its edges. `lines_per_face` and `circles_per_face` are counts for each side of a face.
Probes probes_of(const Literal& literal, double offset, int lines_per_face, int circles_per_face,
                 Rng& rng);

/// A plane of a literal's boundary.
struct FacePlane {
  Vec3 point = Vec3::Zero();
  Vec3 normal = Vec3::UnitZ();  ///< unit
};

/// The flat faces of boxes and cylinders.
std::vector<FacePlane> planes_of(const Literal& literal);

}  // namespace hewn
