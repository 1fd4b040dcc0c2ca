#include "core/segment/curvature/stages.h"

#include <algorithm>

#include "core/compute/compute.h"
#include "core/compute/curvature_job.h"

namespace hewn {
namespace {

/// Of one core, for all stages: measured (docs/performance.md).
constexpr double kSecondsPerTriangle = 2e-6;

constexpr double radians(double degrees) { return degrees * kPi / 180; }

Vec3 vector_of(const PlainVec& v) { return {v.x, v.y, v.z}; }

CurvatureJobOptions job_options(double diagonal, const CurvatureOptions& options) {
  return {radians(options.ridge_angle_deg), options.corner_ratio,
          radians(options.corner_defect_deg),
          options.normal_weights == static_cast<int>(NormalWeights::Angle),
          curvature_limits(diagonal, options)};
}

void take(CurvatureJob& job, CurvatureStages& stages) {
  static_assert(sizeof(std::array<bool, 3>) == 3);
  auto& is_marked = stages.boundaries.is_marked;
  is_marked.resize(stages.mesh.triangles.size());
  if (!is_marked.empty()) job.take_marks({is_marked[0].data(), is_marked.size() * 3});
  stages.curvatures.clear();
  for (const CurvatureForm& c : job.curvatures()) {
    stages.curvatures.push_back({c.max, c.min, vector_of(c.max_direction)});
  }
  stages.classes = job.classes();
}

void take_rest(CurvatureJob& job, CurvatureStages& stages) {
  stages.vertices = job.vertex_classes();
  stages.boundaries.group_count = job.vertex_marks();
  for (int& count : stages.boundaries.group_count) count = std::max(1, count / 2);
  stages.normals.sector_of_corner = job.sectors();
  stages.normals.normal_of_corner.clear();
  for (const PlainVec& n : job.normals()) {
    stages.normals.normal_of_corner.push_back(vector_of(n));
  }
}

}  // namespace

CurvatureLimits curvature_limits(double diagonal, const CurvatureOptions& options) {
  return {options.eps_plane / diagonal, options.eps_sphere, options.eps_cone_low,
          options.eps_cone_high};
}

Result<CurvatureStages> compute_stages(const Mesh& mesh, const CurvatureOptions& options,
                                       const RunContext& run, KeptStages kept) {
  CurvatureStages stages{mesh, build_topology(mesh), {}, {}, {}, {}, {}, {}};
  const TriangleTopology& topology = stages.topology;
  const MeshArrays arrays{mesh.vertices,      mesh.triangles,   mesh.normals,         mesh.areas,
                          topology.neighbors, topology.corners, topology.first_corner};
  const auto on_device = [&](Device& device) -> Result<void> {
    CurvatureJob job(device, arrays, job_options(mesh.diagonal(), options), run);
    if (const Result<void> done = job.result(); !done) return done;
    const bool does_flood = options.growth == static_cast<int>(RegionGrowth::Flood);
    if (does_flood) stages.labels = job.regions();
    take(job, stages);
    if (kept == KeptStages::All) take_rest(job, stages);
    return job.result();
  };
  const double seconds = kSecondsPerTriangle * static_cast<double>(mesh.triangles.size());
  const Result<void> done = compute_of(run)->run(seconds, run, on_device);
  if (!done) return done.error();
  return stages;
}

}  // namespace hewn
