#include "core/segment/curvature/classify_vertices.h"

#include <Eigen/Eigenvalues>

#include "core/compute/parallel.h"

namespace hewn {
namespace {

constexpr std::size_t kGrain = 512;

/// True where a hole's rim or a non-manifold edge touches the vertex: its angles do not close.
bool is_on_rim(const TriangleTopology& topology, int vertex) {
  for (const int corner : topology.corners_at(vertex)) {
    const auto& sides = topology.neighbors[corner / 3];
    if (sides[corner % 3] < 0 || sides[(corner + 2) % 3] < 0) return true;
  }
  return false;
}

VertexClass classify(const Mesh& mesh, const TriangleTopology& topology,
                     const CurvatureOptions& options, int vertex) {
  Mat3 tensor = Mat3::Zero();
  double angle_sum = 0;
  for (const int corner : topology.corners_at(vertex)) {
    const double angle = corner_angle(mesh, corner / 3, corner % 3);
    const Vec3& n = mesh.normals[corner / 3];
    tensor += angle * n * n.transpose();
    angle_sum += angle;
  }
  if (angle_sum <= 0) return VertexClass::Face;
  const double defect = std::abs(2 * kPi - angle_sum);
  if (!is_on_rim(topology, vertex) && defect >= options.corner_defect_deg * kPi / 180) {
    return VertexClass::Corner;
  }
  const Vec3 values = Eigen::SelfAdjointEigenSolver<Mat3>(tensor, Eigen::EigenvaluesOnly)
                          .eigenvalues();  // ascending
  // Two planes that meet at the ridge angle have just this ratio.
  const double slope = std::tan(options.ridge_angle_deg * kPi / 360);
  if (values[1] < slope * slope * values[2]) return VertexClass::Face;
  return values[0] < options.corner_ratio * values[1] ? VertexClass::Ridge : VertexClass::Corner;
}

}  // namespace

double corner_angle(const Mesh& mesh, int triangle, int k) {
  const Vec3 v = mesh.corner(triangle, k);
  return angle_between(mesh.corner(triangle, (k + 1) % 3) - v,
                       mesh.corner(triangle, (k + 2) % 3) - v);
}

Result<std::vector<VertexClass>> classify_vertices(const Mesh& mesh,
                                                   const TriangleTopology& topology,
                                                   const CurvatureOptions& options,
                                                   const RunContext& run) {
  std::vector<VertexClass> classes(mesh.vertices.size(), VertexClass::Face);
  const auto body = [&](std::size_t begin, std::size_t end) {
    if (run.is_cancelled()) return;
    for (std::size_t v = begin; v < end; ++v) {
      classes[v] = classify(mesh, topology, options, static_cast<int>(v));
    }
  };
  for_each_chunk(run.threads, classes.size(), kGrain, body);
  if (run.is_cancelled()) return RunContext::cancelled();
  return classes;
}

}  // namespace hewn
