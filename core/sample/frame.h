#pragma once
/// The part's own coordinate frame: everything that depends on a box uses this one, so that a
/// rotated part is treated as the unrotated one is.
#include <vector>

#include "core/base/math.h"
#include "core/base/rng.h"
#include "core/fit/surface_set.h"
#include "core/mesh/mesh.h"

namespace hewn {

/// A rotated coordinate system with the bounding box in it.
struct Frame {
  Mat3 rotation = Mat3::Identity();  ///< columns: the frame's axes in space
  Box3 box;                          ///< of the geometry, in frame coordinates

  Vec3 to_local(const Vec3& x) const { return rotation.transpose() * x; }
  Vec3 to_space(const Vec3& local) const { return rotation * local; }
  double diagonal() const { return box.diagonal(); }
};

/// The frame of the three mutually orthogonal directions with the most area. A direction of nothing
/// but one plane gives way to a line between parallel axes, so that what is turned about them keeps
/// its typed places.
/// `triangles` restricts the box; empty means the whole mesh.
Frame find_frame(const Mesh& mesh, const std::vector<int>& triangles, const SurfaceSet& surfaces);

}  // namespace hewn
