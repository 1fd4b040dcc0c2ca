#pragma once
/// Random points on and in a mesh. The same generator state gives the same points everywhere.
#include <vector>

#include "core/base/rng.h"
#include "core/mesh/mesh.h"

namespace hewn {

struct SurfacePoint {
  Vec3 position = Vec3::Zero();
  Vec3 normal = Vec3::Zero();
  int triangle = -1;
};

/// Draws triangles by area.
class SurfaceSampler {
 public:
  explicit SurfaceSampler(const Mesh& mesh);
  /// Restricted to some triangles. The mesh must outlive the sampler.
  SurfaceSampler(const Mesh& mesh, std::vector<int> triangles);
  SurfacePoint draw(Rng& rng) const;
  bool is_empty() const { return triangles_.empty(); }

 private:
  const Mesh* mesh_;
  std::vector<int> triangles_;
  std::vector<double> cumulative_area_;
};

/// A uniform point of the box.
Vec3 sample_box(const Box3& box, Rng& rng);

struct Line {
  Vec3 origin = Vec3::Zero();
  Vec3 direction = Vec3::UnitZ();
};

/// A line that is uniform among those that meet the ball; its origin lies outside the ball, and
/// whatever is in the ball at positive lengths of its unit direction. Such lines meet every surface
/// in the ball in proportion to its area (Crofton).
Line draw_line(const Vec3& center, double radius, Rng& rng);

/// A uniform point of a triangle.
Vec3 sample_triangle(const Mesh& mesh, int triangle, Rng& rng);

}  // namespace hewn
