#include "core/segment/curvature/principal_curvatures.h"

#include <array>

#include <Eigen/Eigenvalues>

#include "core/compute/parallel.h"

namespace hewn {
namespace {

constexpr std::size_t kGrain = 512;

/// A symmetric curvature tensor [a b; b c] in the tangent frame (u, w) of some plane.
using Tensor = Eigen::Matrix2d;

struct Frame {
  Vec3 u, w;
};

Frame frame_of(const Vec3& normal) {
  const Tangents t = tangents(normal);
  return {t.u, t.w};
}

/// The tensor that maps each side to the change of normals along it, by least squares.
Tensor triangle_tensor(const Mesh& mesh, const GroupNormals& normals, int t) {
  const Frame frame = frame_of(mesh.normals[t]);
  Mat3 lhs = Mat3::Zero();
  Vec3 rhs = Vec3::Zero();
  for (int k = 0; k < 3; ++k) {
    const Vec3 side = mesh.corner(t, (k + 1) % 3) - mesh.corner(t, k);
    const Vec3 change =
        normals.normal_of_corner[3 * t + (k + 1) % 3] - normals.normal_of_corner[3 * t + k];
    const double x = side.dot(frame.u);
    const double y = side.dot(frame.w);
    // (a x + b y, b x + c y) = change in the frame: two rows for each side.
    const Vec3 row_u(x, y, 0);
    const Vec3 row_w(0, x, y);
    lhs += row_u * row_u.transpose() + row_w * row_w.transpose();
    rhs += row_u * change.dot(frame.u) + row_w * change.dot(frame.w);
  }
  const Vec3 abc = lhs.ldlt().solve(rhs);
  Tensor tensor;
  tensor << abc[0], abc[1], abc[1], abc[2];
  return tensor.allFinite() ? tensor : Tensor(Tensor::Zero());
}

/// The same tensor seen in the frame of another plane: the plane is turned about the line in which
/// both meet, so that nothing is lost by foreshortening.
Tensor turned(const Tensor& tensor, const Vec3& from_normal, const Vec3& to_normal) {
  const Frame from = frame_of(from_normal);
  const Frame to = frame_of(to_normal);
  const Mat3 turn = Eigen::Quaterniond::FromTwoVectors(to_normal, from_normal).toRotationMatrix();
  const Vec3 u = turn * to.u;
  const Vec3 w = turn * to.w;
  Tensor basis;
  basis << u.dot(from.u), w.dot(from.u), u.dot(from.w), w.dot(from.w);
  return basis.transpose() * tensor * basis;
}

/// The part of the triangle's area that is nearest to each corner (Meyer et al. 2003; an obtuse
/// triangle's Voronoi regions are cut off at its sides).
std::array<double, 3> corner_areas(const Mesh& mesh, int t) {
  std::array<double, 3> squared, weight;
  for (int k = 0; k < 3; ++k) {
    squared[k] = (mesh.corner(t, (k + 2) % 3) - mesh.corner(t, (k + 1) % 3)).squaredNorm();
  }
  // Barycentric weights of the circumcentre.
  for (int k = 0; k < 3; ++k) {
    weight[k] = squared[k] * (squared[(k + 1) % 3] + squared[(k + 2) % 3] - squared[k]);
  }
  const double area = mesh.areas[t];
  for (int k = 0; k < 3; ++k) {
    if (weight[k] <= 0) {
      std::array<double, 3> areas{area / 4, area / 4, area / 4};
      areas[k] = area / 2;
      return areas;
    }
  }
  const double scale = area / 2 / (weight[0] + weight[1] + weight[2]);
  return {scale * (weight[1] + weight[2]), scale * (weight[2] + weight[0]),
          scale * (weight[0] + weight[1])};
}

PrincipalCurvatures principal(const Tensor& tensor, const Vec3& normal) {
  const Eigen::SelfAdjointEigenSolver<Tensor> solver(tensor);
  const int larger = std::abs(solver.eigenvalues()[0]) > std::abs(solver.eigenvalues()[1]) ? 0 : 1;
  const Eigen::Vector2d direction = solver.eigenvectors().col(larger);
  const Frame frame = frame_of(normal);
  PrincipalCurvatures result;
  result.max = solver.eigenvalues()[larger];
  result.min = solver.eigenvalues()[1 - larger];
  result.max_direction = direction.x() * frame.u + direction.y() * frame.w;
  return result;
}

class Estimator {
 public:
  Estimator(const Mesh& mesh, const TriangleTopology& topology, const GroupNormals& normals)
      : mesh_(mesh),
        topology_(topology),
        normals_(normals),
        of_triangle_(mesh.triangles.size(), Tensor::Zero()),
        of_corner_(mesh.triangles.size() * 3, Tensor::Zero()),
        areas_(mesh.triangles.size()) {}

  void triangle_pass(int t) {
    if (mesh_.areas[t] <= 0) return;
    of_triangle_[t] = triangle_tensor(mesh_, normals_, t);
    areas_[t] = corner_areas(mesh_, t);
  }

  /// Sums in ascending order of corners, so that every thread count gives the same bits.
  void vertex_pass(int vertex) {
    const auto corners = topology_.corners_at(vertex);
    for (const int first : corners) {
      if (normals_.sector_of_corner[first] != first) continue;
      const Vec3& normal = normals_.normal_of_corner[first];
      Tensor sum = Tensor::Zero();
      double area = 0;
      for (const int corner : corners) {
        const int t = corner / 3;
        if (normals_.sector_of_corner[corner] != first || mesh_.areas[t] <= 0) continue;
        sum += turned(of_triangle_[t], mesh_.normals[t], normal) * areas_[t][corner % 3];
        area += areas_[t][corner % 3];
      }
      if (area > 0) of_corner_[first] = sum / area;
    }
  }

  PrincipalCurvatures result(int t) const {
    if (mesh_.areas[t] <= 0) return {};
    Tensor sum = Tensor::Zero();
    for (int k = 0; k < 3; ++k) {
      const int corner = 3 * t + k;
      const Tensor& tensor = of_corner_[normals_.sector_of_corner[corner]];
      sum += turned(tensor, normals_.normal_of_corner[corner], mesh_.normals[t]) / 3;
    }
    return principal(sum, mesh_.normals[t]);
  }

 private:
  const Mesh& mesh_;
  const TriangleTopology& topology_;
  const GroupNormals& normals_;
  std::vector<Tensor> of_triangle_;
  std::vector<Tensor> of_corner_;  ///< by sector
  std::vector<std::array<double, 3>> areas_;
};

template <class Kernel>
bool for_all(const RunContext& run, std::size_t n, const Kernel& kernel) {
  for_each_chunk(run.threads, n, kGrain, [&](std::size_t begin, std::size_t end) {
    if (run.is_cancelled()) return;
    for (std::size_t i = begin; i < end; ++i) kernel(static_cast<int>(i));
  });
  return !run.is_cancelled();
}

}  // namespace

Result<std::vector<PrincipalCurvatures>> compute_principal_curvatures(
    const Mesh& mesh, const TriangleTopology& topology, const GroupNormals& normals,
    const RunContext& run) {
  Estimator estimator(mesh, topology, normals);
  std::vector<PrincipalCurvatures> result(mesh.triangles.size());
  const bool is_done =
      for_all(run, mesh.triangles.size(), [&](int t) { estimator.triangle_pass(t); }) &&
      for_all(run, mesh.vertices.size(), [&](int v) { estimator.vertex_pass(v); }) &&
      for_all(run, mesh.triangles.size(), [&](int t) { result[t] = estimator.result(t); });
  if (!is_done) return RunContext::cancelled();
  return result;
}

}  // namespace hewn
