#pragma once
/// Inside tests, rays and closest points on a mesh (Embree).
#include <memory>
#include <span>
#include <vector>

#include "core/base/rng.h"
#include "core/base/run_context.h"
#include "core/mesh/mesh.h"

namespace hewn {

struct ClosestPoint {
  Vec3 point = Vec3::Zero();
  int triangle = -1;
  double distance = kInfinity;
};

struct RayHit {
  double t = kInfinity;  ///< in lengths of the direction
  int triangle = -1;     ///< -1: nothing was hit
};

/// Immutable once built; every query is thread-safe and gives the same answer on every run.
/// Works in coordinates centred and scaled by the mesh's own box, so far-off or tiny meshes lose
/// nothing to single precision beyond 1e-7 of their diagonal.
class MeshQuery {
 public:
  explicit MeshQuery(std::shared_ptr<const Mesh> mesh);
  ~MeshQuery();
  MeshQuery(MeshQuery&&) noexcept;
  MeshQuery& operator=(MeshQuery&&) noexcept;

  /// Whether `p` lies inside: parity of ray crossings; several directions vote when the first
  /// passes close to an edge or the mesh is open.
  bool contains(const Vec3& p) const;
  /// The same of many points at once, 1 for those inside, on the device that suits. What is left
  /// undone when the run is cancelled is 0.
  std::vector<char> contains(std::span<const Vec3> points, const RunContext& run) const;
  ClosestPoint closest(const Vec3& p) const;
  RayHit cast(const Vec3& origin, const Vec3& direction) const;
  /// Appends every triangle that the segment from `a` to `b` passes or (to single precision)
  /// touches, in no particular order.
  void crossed_by(const Vec3& a, const Vec3& b, std::vector<int>& triangles) const;
  /// Distance to the surface, negative inside.
  double signed_distance(const Vec3& p) const;
  const Mesh& mesh() const;

 private:
  struct Scene;
  std::unique_ptr<Scene> scene_;
};

}  // namespace hewn
