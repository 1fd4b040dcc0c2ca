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

struct ProbeOptions {
  double offset = 0;         ///< from the face
  int lines_per_face = 3;    ///< for each side of a face
  int circles_per_face = 2;  ///< likewise
  bool has_edges = true;     ///< also along edges, rims and great circles, and on polyhedra
};

/// Lines and circles that run beside the literal's faces, inside and outside.
Probes probes_of(const Literal& literal, const ProbeOptions& options, Rng& rng);

/// A plane of a literal's boundary.
struct FacePlane {
  Vec3 point = Vec3::Zero();
  Vec3 normal = Vec3::UnitZ();  ///< unit
};

/// The flat faces of boxes and cylinders.
std::vector<FacePlane> planes_of(const Literal& literal);

}  // namespace hewn
