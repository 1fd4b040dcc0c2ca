#include "core/session/score.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/base/rng.h"
#include "core/compute/parallel.h"
#include "core/csg/literal_boxes.h"
#include "core/csg/tree_ray.h"
#include "core/mesh/sampling.h"

namespace hewn {
namespace {

/// Of the diagonal: solids closer than this touch. Exported numbers are no finer.
constexpr double kTouching = 1e-6;

constexpr std::size_t kChunk = 512;
constexpr std::uint64_t kVolumeStream = 0x700000;
constexpr std::uint64_t kOutsideStream = 0x780000;
constexpr std::uint64_t kSurfaceStream = 0x800000;
constexpr std::uint64_t kLineStream = 0x900000;
constexpr std::uint64_t kLiteralStream = 0x980000;
/// Through what a literal may reach. Lines through the whole part seldom meet a small feature.
constexpr std::size_t kLinesPerLiteral = 64;

struct Distances {
  double largest = 0;
  double mean = 0;
};

/// Summed in order, so that the number of threads leaves no trace.
Distances summarise(const std::vector<double>& values) {
  Distances out;
  double sum = 0;
  for (const double v : values) {
    out.largest = std::max(out.largest, v);
    sum += v;
  }
  if (!values.empty()) out.mean = sum / static_cast<double>(values.size());
  return out;
}

/// Calls `body(i, rng)` for all i; each chunk has its own random numbers.
template <class Body>
void sample_all(std::size_t n, std::uint64_t stream, const RunContext& run, const Body& body) {
  for_each_index(run.threads, (n + kChunk - 1) / kChunk, [&](std::size_t chunk) {
    if (run.is_cancelled()) return;
    Rng rng(run.seed, stream + chunk);
    const std::size_t end = std::min(n, (chunk + 1) * kChunk);
    for (std::size_t i = chunk * kChunk; i < end; ++i) body(i, rng);
  });
}

Vec3 distance_gradient(const Tree& tree, const Vec3& p, double step) {
  Vec3 g;
  for (int k = 0; k < 3; ++k) {
    const Vec3 shift = Vec3::Unit(k) * step;
    g[k] = tree.signed_distance(p + shift) - tree.signed_distance(p - shift);
  }
  return g.norm() > 0 ? Vec3(g.normalized()) : Vec3::UnitZ();
}

/// The tree's min/max distance is a lower bound; a walk along its gradient to where it vanishes
/// gives a point on the surface, hence an upper one.
double distance_to_tree(const Tree& tree, const Vec3& p, double diagonal) {
  constexpr int kSteps = 6;
  const double bound = std::abs(tree.signed_distance(p));
  if (bound < 1e-6 * diagonal) return bound;
  Vec3 q = p;
  double value = tree.signed_distance(q);
  for (int i = 0; i < kSteps && std::abs(value) > 1e-6 * diagonal; ++i) {
    q -= value * distance_gradient(tree, q, 1e-6 * diagonal);
    value = tree.signed_distance(q);
  }
  const bool has_arrived = std::abs(value) <= 0.05 * bound;
  return has_arrived ? std::max(bound, (q - p).norm()) : bound;
}

/// What of the tree lies outside `box`, in volumes of the box. The mesh's own surroundings get all
/// points of `score_volume`, however far the tree reaches beyond them.
double volume_outside(const Tree& tree, const Box3& box, std::size_t points,
                      const RunContext& run) {
  Box3 joint = tree.bounds();
  if (joint.is_empty() || (box.contains(joint.lo) && box.contains(joint.hi))) return 0;
  joint.extend(box.lo);
  joint.extend(box.hi);
  std::vector<char> is_beyond(points);
  sample_all(points, kOutsideStream, run, [&](std::size_t i, Rng& rng) {
    const Vec3 x = sample_box(joint, rng);
    is_beyond[i] = !box.contains(x) && tree.contains(x) ? 1 : 0;
  });
  const auto beyond = std::count(is_beyond.begin(), is_beyond.end(), char{1});
  return joint.size().prod() / box.size().prod() * static_cast<double>(beyond) /
         static_cast<double>(points);
}

/// Membership of random points in mesh and tree.
void score_volume(const MeshQuery& query, const Tree& tree, int points, const RunContext& run,
                  TreeScore& score) {
  Box3 box = query.mesh().bounds;
  const Vec3 margin = Vec3::Constant(0.025 * box.diagonal());
  box.lo -= margin;
  box.hi += margin;
  std::vector<Vec3> positions(static_cast<std::size_t>(points));
  std::vector<char> in_tree(positions.size());
  sample_all(positions.size(), kVolumeStream, run, [&](std::size_t i, Rng& rng) {
    positions[i] = sample_box(box, rng);
    in_tree[i] = tree.contains(positions[i]) ? 1 : 0;
  });
  const std::vector<char> in_mesh = query.contains(positions, run);
  std::size_t both = 0;
  std::size_t one = 0;
  for (std::size_t i = 0; i < positions.size(); ++i) {
    both += in_mesh[i] != 0 && in_tree[i] != 0 ? 1 : 0;
    one += in_mesh[i] != in_tree[i] ? 1 : 0;
  }
  const auto all = static_cast<double>(positions.size());
  const double outside = volume_outside(tree, box, positions.size(), run);
  const double joint = static_cast<double>(both + one) + outside * all;
  score.iou = joint > 0 ? static_cast<double>(both) / joint : 0;
  score.agreement = 1 - static_cast<double>(one) / all;
  // A few thousand points decide which operands overlap.
  constexpr std::size_t kProximityPoints = 8192;
  positions.resize(std::min(positions.size(), kProximityPoints));
  score.proximity = proximity(tree, positions);
}

/// Crossings of random lines with the tree's surface.
struct LineSample {
  std::vector<double> distances;  ///< from the mesh
  std::size_t on_polyhedra = 0;
};

/// Joins stretches that touch but for rounding, and drops those as short as rounding: abutting
/// solids have no surface between them.
void join_touching(std::vector<TreeInterval>& stretches, double rounding) {
  std::size_t kept = 0;
  for (const TreeInterval& s : stretches) {
    if (kept > 0 && s.enter.t - stretches[kept - 1].leave.t <= rounding) {
      stretches[kept - 1].leave = s.leave;
    } else {
      stretches[kept++] = s;
    }
  }
  stretches.resize(kept);
  std::erase_if(stretches,
                [rounding](const TreeInterval& s) { return s.leave.t - s.enter.t <= rounding; });
}

/// The largest distance from the mesh at crossings of lines that are aimed at each literal.
double largest_at_literals(const MeshQuery& query, const TreeRays& rays, const RunContext& run) {
  const std::vector<Box3> boxes = literal_boxes(rays.tree());
  std::vector<double> largest(boxes.size(), 0);
  for_each_index(run.threads, boxes.size(), [&](std::size_t i) {
    const Box3& box = boxes[i];
    if (run.is_cancelled() || box.is_empty()) return;
    const double radius = 0.5 * box.diagonal();
    Rng rng(run.seed, kLiteralStream + i);
    TreeRayScratch scratch;
    for (std::size_t k = 0; k < kLinesPerLiteral; ++k) {
      const Line line = draw_line(box.center(), radius, rng);
      std::vector<TreeInterval> stretches = rays.cast(line.origin, line.direction, scratch);
      join_touching(stretches, kTouching * query.mesh().diagonal());
      for (const TreeInterval& stretch : stretches) {
        for (const double t : {stretch.enter.t, stretch.leave.t}) {
          const Vec3 p = line.origin + t * line.direction;
          if (box.contains(p)) largest[i] = std::max(largest[i], query.closest(p).distance);
        }
      }
    }
  });
  return largest.empty() ? 0 : *std::max_element(largest.begin(), largest.end());
}

void score_tree_surface(const MeshQuery& query, const Tree& tree, int points, const RunContext& run,
                        TreeScore& score) {
  const double diagonal = query.mesh().diagonal();
  const Box3 box = tree.bounds();
  if (box.is_empty()) return;
  const TreeRays rays(tree);
  std::vector<LineSample> lines(static_cast<std::size_t>(points));
  sample_all(lines.size(), kLineStream, run, [&](std::size_t i, Rng& rng) {
    const Line line = draw_line(box.center(), 0.5 * box.diagonal(), rng);
    TreeRayScratch scratch;
    std::vector<TreeInterval> stretches = rays.cast(line.origin, line.direction, scratch);
    join_touching(stretches, kTouching * diagonal);
    for (const TreeInterval& stretch : stretches) {
      for (const TreeCrossing& c : {stretch.enter, stretch.leave}) {
        lines[i].distances.push_back(query.closest(line.origin + c.t * line.direction).distance /
                                     diagonal);
        lines[i].on_polyhedra +=
            c.literal >= 0 && tree.literals[c.literal].kind == SolidKind::Polyhedron;
      }
    }
  });
  std::vector<double> distances;
  std::size_t on_polyhedra = 0;
  for (const LineSample& line : lines) {
    distances.insert(distances.end(), line.distances.begin(), line.distances.end());
    on_polyhedra += line.on_polyhedra;
  }
  const Distances from_tree = summarise(distances);
  score.tree_to_mesh_max =
      std::max(from_tree.largest, largest_at_literals(query, rays, run) / diagonal);
  score.mean_distance = std::max(score.mean_distance, from_tree.mean);
  if (!distances.empty()) {
    score.polyhedron_share =
        static_cast<double>(on_polyhedra) / static_cast<double>(distances.size());
  }
}

void score_mesh_surface(const MeshQuery& query, const Tree& tree, int points, const RunContext& run,
                        TreeScore& score) {
  const double diagonal = query.mesh().diagonal();
  const SurfaceSampler sampler(query.mesh());
  if (sampler.is_empty()) return;
  std::vector<double> distances(static_cast<std::size_t>(points));
  sample_all(distances.size(), kSurfaceStream, run, [&](std::size_t i, Rng& rng) {
    distances[i] = distance_to_tree(tree, sampler.draw(rng).position, diagonal) / diagonal;
  });
  const Distances from_mesh = summarise(distances);
  score.mesh_to_tree_max = from_mesh.largest;
  score.mean_distance = from_mesh.mean;
}

}  // namespace

double signed_distance_to_tree(const Tree& tree, const Vec3& p, double diagonal) {
  const double distance = distance_to_tree(tree, p, diagonal);
  return tree.contains(p) ? -distance : distance;
}

Result<TreeScore> score_tree(const MeshQuery& query, const Tree& tree,
                             const VerifySettings& settings, const RunContext& run) {
  TreeScore score;
  run.report("verify", 0);
  score_volume(query, tree, settings.volume_points, run, score);
  run.report("verify", 0.5);
  if (!tree.is_empty()) {
    score_mesh_surface(query, tree, settings.surface_points, run, score);
    score_tree_surface(query, tree, settings.surface_points, run, score);
  }
  if (run.is_cancelled()) return RunContext::cancelled();
  score.hausdorff = std::max(score.mesh_to_tree_max, score.tree_to_mesh_max);
  run.report("verify", 1);
  return score;
}

}  // namespace hewn
