#include "core/segment/curvature/group_normals.h"

#include <algorithm>

#include "core/compute/parallel.h"

namespace hewn {
namespace {

constexpr std::size_t kGrain = 512;

/// The work on one vertex; touches only outputs of the vertex's own corners.
class VertexSectors {
 public:
  VertexSectors(const Mesh& mesh, const TriangleTopology& topology, const Boundaries& boundaries,
                GroupNormals& out)
      : mesh_(mesh), topology_(topology), boundaries_(boundaries), out_(out) {}

  void run(int vertex, NormalWeights weights) {
    const auto corners = topology_.corners_at(vertex);
    for (const int corner : corners) out_.sector_of_corner[corner] = -1;
    for (const int corner : corners) {
      if (out_.sector_of_corner[corner] < 0) flood(corner, weights);
    }
  }

 private:
  /// Collects the corners reached from `first` over unmarked edges at the vertex.
  void flood(int first, NormalWeights weights) {
    std::vector<int>& sector = scratch_;
    sector.assign(1, first);
    out_.sector_of_corner[first] = first;
    for (std::size_t i = 0; i < sector.size(); ++i) {
      const int t = sector[i] / 3;
      const int k = sector[i] % 3;
      for (const int side : {k, (k + 2) % 3}) {
        if (boundaries_.is_marked[t][side]) continue;
        const int corner = corner_at(topology_.neighbors[t][side], mesh_.triangles[t][k]);
        if (corner < 0 || out_.sector_of_corner[corner] >= 0) continue;
        out_.sector_of_corner[corner] = first;
        sector.push_back(corner);
      }
    }
    // A fixed order of summation, whatever the walk was.
    std::sort(sector.begin(), sector.end());
    Vec3 sum = Vec3::Zero();
    for (const int corner : sector) {
      const int t = corner / 3;
      const double weight =
          weights == NormalWeights::Area ? mesh_.areas[t] : corner_angle(mesh_, t, corner % 3);
      sum += mesh_.normals[t] * weight;
    }
    const double length = sum.norm();
    for (const int corner : sector) {
      out_.normal_of_corner[corner] = length > 0 ? Vec3(sum / length) : mesh_.normals[corner / 3];
    }
  }

  int corner_at(int triangle, int vertex) const {
    if (triangle < 0) return -1;
    for (int k = 0; k < 3; ++k) {
      if (mesh_.triangles[triangle][k] == vertex) return 3 * triangle + k;
    }
    return -1;
  }

  const Mesh& mesh_;
  const TriangleTopology& topology_;
  const Boundaries& boundaries_;
  GroupNormals& out_;
  std::vector<int> scratch_;
};

}  // namespace

Result<GroupNormals> compute_group_normals(const Mesh& mesh, const TriangleTopology& topology,
                                           const Boundaries& boundaries,
                                           const CurvatureOptions& options, const RunContext& run) {
  GroupNormals normals;
  normals.normal_of_corner.assign(mesh.triangles.size() * 3, Vec3::Zero());
  normals.sector_of_corner.assign(mesh.triangles.size() * 3, -1);
  const auto weights = static_cast<NormalWeights>(options.normal_weights);
  for_each_chunk(run.threads, mesh.vertices.size(), kGrain,
                 [&](std::size_t begin, std::size_t end) {
                   if (run.is_cancelled()) return;
                   VertexSectors sectors(mesh, topology, boundaries, normals);
                   for (std::size_t v = begin; v < end; ++v) {
                     sectors.run(static_cast<int>(v), weights);
                   }
                 });
  if (run.is_cancelled()) return RunContext::cancelled();
  return normals;
}

}  // namespace hewn
