#include "core/sample/arrangement.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "core/base/rng.h"
#include "core/compute/parallel.h"
#include "core/csg/tree_ray.h"
#include "core/sample/arrangement_lines.h"
#include "core/sample/arrangement_walk.h"

namespace hewn {
namespace {

constexpr double kResolution = 1e-6;     ///< share of the scale
constexpr double kUncertainMesh = 3e-7;  ///< of a polyhedron's diagonal: rays in single precision

std::vector<std::uint64_t> literal_keys(std::size_t literals) {
  Rng rng(0x5CE11);
  std::vector<std::uint64_t> keys(literals);
  for (std::uint64_t& key : keys) key = rng.next();
  return keys;
}

/// What all chunks read.
struct Scene : Walkable {
  const ArrangementOptions& options;
  std::uint64_t seed;
  std::vector<std::vector<FacePlane>> planes;   ///< of each literal
  std::vector<std::pair<int, int>> neighbours;  ///< literals whose bounds meet
};

Vec3 point_in(const Box3& box, Rng& rng) {
  Vec3 p;
  for (int k = 0; k < 3; ++k) p[k] = rng.uniform(box.lo[k], box.hi[k]);
  return p;
}

constexpr int kLinesPerChunk = 200;
/// Pairs of planes looked at for each whose common line meets both literals.
constexpr std::size_t kTriesPerCrossing = 8;

/// Through two random points of a literal's box, or of the common box.
void walk_volume(const Scene& scene, std::size_t chunk, Finds& finds) {
  Rng rng(scene.seed, 2 * chunk);
  Walker walker(scene, finds);
  const std::size_t literals = scene.arrangement.literals.size();
  for (int i = 0; i < kLinesPerChunk; ++i) {
    const Box3 box = i % 2 == 0 ? scene.box : scene.arrangement.bounds[rng.below(literals)].box;
    const Vec3 a = point_in(box, rng);
    const Vec3 b = point_in(box, rng);
    const Vec3 d = i % 8 < 3 ? Vec3(Vec3::Unit(i % 3)) : Vec3(b - a);
    if (d.norm() > 0) walker.line({a, d.normalized()});
  }
}

/// In rounds, until one finds nothing new.
void walk_faces(const Scene& scene, std::size_t literal, Finds& finds) {
  constexpr int kRounds = 4;
  const auto share = [](int count) { return (count + kRounds - 1) / kRounds; };
  Rng rng(scene.seed, 2 * literal + 1);
  Walker walker(scene, finds);
  for (int round = 0; round < kRounds; ++round) {
    const ProbeOptions options{scene.arrangement.resolution, share(scene.options.lines_per_face),
                               share(scene.options.curves_per_face), round == 0};
    const Probes probes = probes_of(scene.arrangement.literals[literal], options, rng);
    const std::size_t before = finds.points.size();
    for (const ProbeLine& line : probes.lines) walker.line(line);
    for (const ProbeCircle& circle : probes.circles) walker.circle(circle);
    if (finds.points.size() == before) return;
  }
}

/// Pairs of literals that may cut each other, the second from `first` on.
std::vector<std::pair<int, int>> neighbours_of(const Arrangement& arrangement, std::size_t first) {
  std::vector<std::pair<int, int>> pairs;
  const Vec3 margin = Vec3::Constant(2 * arrangement.resolution);
  for (std::size_t b = first; b < arrangement.bounds.size(); ++b) {
    const Vec3 lo = arrangement.bounds[b].box.lo - margin;
    const Vec3 hi = arrangement.bounds[b].box.hi + margin;
    for (std::size_t a = 0; a < b; ++a) {
      const Box3& other = arrangement.bounds[a].box;
      if ((other.lo.array() > hi.array()).any() || (other.hi.array() < lo.array()).any()) continue;
      pairs.emplace_back(static_cast<int>(a), static_cast<int>(b));
    }
  }
  return pairs;
}

/// The common line of two planes of different literals.
struct Crossing {
  const FacePlane* p;
  const FacePlane* q;
  Vec3 along;  ///< not of length 1: its square is that of the sine between the planes

  /// A point at these distances from the planes, along their normals.
  Vec3 point(double beyond_p, double beyond_q) const {
    const double at_p = p->normal.dot(p->point) + beyond_p;
    const double at_q = q->normal.dot(q->point) + beyond_q;
    return (at_p * q->normal.cross(along) + at_q * along.cross(p->normal)) / along.squaredNorm();
  }
};

bool line_meets(const Box3& box, double margin, const Vec3& point, const Vec3& direction) {
  double enter = -kInfinity;
  double leave = kInfinity;
  for (int k = 0; k < 3; ++k) {
    const double a = (box.lo[k] - margin - point[k]) / direction[k];
    const double b = (box.hi[k] + margin - point[k]) / direction[k];
    if (std::isnan(a) || std::isnan(b)) continue;  // within a side's plane
    enter = std::max(enter, std::min(a, b));
    leave = std::min(leave, std::max(a, b));
  }
  return enter <= leave;
}

/// Nothing when the planes are parallel or their line passes one of the literals by.
std::optional<Crossing> crossing_of(const Arrangement& arrangement, std::pair<int, int> literals,
                                    const FacePlane& p, const FacePlane& q) {
  const Crossing crossing{&p, &q, p.normal.cross(q.normal)};
  if (crossing.along.squaredNorm() < 1e-10) return std::nullopt;
  const Vec3 point = crossing.point(0, 0);
  for (const int k : {literals.first, literals.second}) {
    const LiteralBounds& bounds = arrangement.bounds[static_cast<std::size_t>(k)];
    const double margin = 2 * arrangement.resolution;
    if (!line_meets(bounds.box, margin, point, crossing.along)) return std::nullopt;
  }
  return crossing;
}

/// All pairs of planes of neighbours that meet when they are few, else random ones.
std::vector<Crossing> crossings_of(const Scene& scene, std::size_t most) {
  const auto planes_of_literal = [&](int k) -> const std::vector<FacePlane>& {
    return scene.planes[static_cast<std::size_t>(k)];
  };
  std::size_t count = 0;
  for (const auto& [a, b] : scene.neighbours) {
    count += planes_of_literal(a).size() * planes_of_literal(b).size();
  }
  std::vector<Crossing> out;
  const auto offer = [&](std::pair<int, int> pair, const FacePlane& p, const FacePlane& q) {
    if (const auto crossing = crossing_of(scene.arrangement, pair, p, q)) out.push_back(*crossing);
  };
  if (count <= kTriesPerCrossing * most) {
    for (const auto& pair : scene.neighbours) {
      for (const FacePlane& p : planes_of_literal(pair.first)) {
        for (const FacePlane& q : planes_of_literal(pair.second)) offer(pair, p, q);
      }
    }
    if (out.size() <= most) return out;
    out.clear();
  }
  Rng rng(scene.seed ^ 0xC0FFEE, 0);
  for (std::size_t i = 0; i < kTriesPerCrossing * most && out.size() < most; ++i) {
    const auto& pair = scene.neighbours[rng.below(scene.neighbours.size())];
    const auto& of_a = planes_of_literal(pair.first);
    const auto& of_b = planes_of_literal(pair.second);
    if (of_a.empty() || of_b.empty()) continue;
    const FacePlane& p = of_a[rng.below(of_a.size())];
    const FacePlane& q = of_b[rng.below(of_b.size())];
    offer(pair, p, q);
  }
  return out;
}

/// Along the common line of two planes, in all four wedges.
void walk_crossing(const Scene& scene, const Crossing& crossing, Walker& walker) {
  const double side = scene.arrangement.resolution;
  const Vec3 direction = crossing.along.normalized();
  for (int k = 0; k < 4; ++k) {
    walker.line({crossing.point((k & 1) ? side : -side, (k & 2) ? side : -side), direction});
  }
}

/// Adds what the chunks found to what is known. Returns how much of it is new.
std::size_t merge_finds(const std::vector<Finds>& chunks, std::size_t most, Finds& all) {
  const std::size_t before = all.points.size();
  for (const Finds& f : chunks) {
    for (std::size_t i = 0; i < f.points.size() && all.points.size() < most; ++i) {
      all.add(f.points[i], f.keys[i]);
    }
  }
  return all.points.size() - before;
}

/// Along the faces of every literal from `first` on, and where faces of two literals cross.
void walk_along_faces(const Scene& scene, std::size_t first, const RunContext& run, Finds& all) {
  const std::size_t faces = scene.arrangement.literals.size() - first;
  const auto crossings =
      crossings_of(scene, static_cast<std::size_t>(std::max(0, scene.options.crossing_lines)));
  const std::size_t chunks = (crossings.size() + kLinesPerChunk - 1) / kLinesPerChunk;
  std::vector<Finds> finds(faces + chunks);
  for_each_index(run.threads, finds.size(), [&](std::size_t i) {
    if (run.is_cancelled()) return;
    if (i < faces) {
      walk_faces(scene, first + i, finds[i]);
      return;
    }
    Walker walker(scene, finds[i]);
    const std::size_t begin = (i - faces) * kLinesPerChunk;
    const std::size_t end = std::min(begin + kLinesPerChunk, crossings.size());
    for (std::size_t k = begin; k < end; ++k) walk_crossing(scene, crossings[k], walker);
  });
  merge_finds(finds, scene.options.most_cells, all);
}

/// Random lines, batch by batch, until one finds nothing new.
void walk_through_volume(const Scene& scene, const RunContext& run, Finds& all) {
  constexpr std::size_t kChunksPerBatch = 4;
  const std::size_t most =
      1 + static_cast<std::size_t>(scene.options.volume_lines) / kLinesPerChunk;
  for (std::size_t done = 0; done < most && !run.is_cancelled();) {
    std::vector<Finds> finds(std::min(kChunksPerBatch, most - done));
    for_each_index(run.threads, finds.size(),
                   [&](std::size_t i) { walk_volume(scene, done + i, finds[i]); });
    done += finds.size();
    if (merge_finds(finds, scene.options.most_cells, all) == 0) return;
  }
}

/// How near to the literal's surface rounding may decide the side.
double uncertain_reach(const Literal& literal, double scale) {
  const double reach = kUncertain * scale;
  if (literal.kind != SolidKind::Polyhedron || !literal.polyhedron) return reach;
  return std::max(reach, kUncertainMesh * literal.polyhedron->diagonal());
}

}  // namespace

Box3 common_box(const Arrangement& arrangement) {
  Box3 box;
  for (const LiteralBounds& b : arrangement.bounds) {
    if (b.box.is_empty()) continue;
    box.extend(b.box.lo);
    box.extend(b.box.hi);
  }
  return box;
}

bool classify(const Arrangement& arrangement, const Vec3& p, Word* signature) {
  std::fill(signature, signature + arrangement.stride, 0);
  bool is_certain = true;
  arrangement.near.visit_near(p, [&](std::size_t k) {
    const double margin = arrangement.uncertain[k];
    const double d = distance_within(arrangement.literals[k], arrangement.bounds[k], p, margin);
    if (d < 0) set_bit(signature, k);
    is_certain = std::abs(d) >= margin;
    return is_certain;
  });
  return is_certain;
}

ArrangementSampler::ArrangementSampler(std::vector<Literal> literals, double scale) {
  out_.literals = std::move(literals);
  out_.stride = std::max<std::size_t>(1, (out_.literals.size() + 63) / 64);
  out_.scale = scale;
  for (const Literal& s : out_.literals) {
    out_.bounds.emplace_back(s);
    out_.uncertain.push_back(uncertain_reach(s, scale));
  }
  out_.near = BoundsTable(out_.bounds, out_.uncertain);
  out_.resolution = kResolution * scale;
}

std::size_t ArrangementSampler::find(const Word* signature) const {
  const auto [begin, end] = by_hash_.equal_range(hash_words({signature, out_.stride}));
  for (auto it = begin; it != end; ++it) {
    if (std::equal(signature, signature + out_.stride, out_.signature(it->second))) {
      return it->second;
    }
  }
  return out_.size();
}

bool ArrangementSampler::insert(const Vec3& point, const Word* signature) {
  if (find(signature) < out_.size()) return false;
  by_hash_.emplace(hash_words({signature, out_.stride}), out_.size());
  out_.points.push_back(point);
  out_.signatures.insert(out_.signatures.end(), signature, signature + out_.stride);
  return true;
}

std::size_t ArrangementSampler::cell_of(const Vec3& p) const {
  std::vector<Word> signature(out_.stride);
  return classify(out_, p, signature.data()) ? find(signature.data()) : out_.size();
}

std::size_t ArrangementSampler::add(const std::vector<Vec3>& points, const RunContext& run) {
  std::vector<Word> signatures(points.size() * out_.stride);
  std::vector<char> is_certain(points.size(), 0);
  for_each_chunk(run.threads, points.size(), 64, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end && !run.is_cancelled(); ++i) {
      is_certain[i] = classify(out_, points[i], signatures.data() + i * out_.stride) ? 1 : 0;
    }
  });
  std::size_t added = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (is_certain[i] && insert(points[i], signatures.data() + i * out_.stride)) ++added;
  }
  return added;
}

Result<std::size_t> ArrangementSampler::sample(const ArrangementOptions& options,
                                               const RunContext& run) {
  if (run.is_cancelled()) return RunContext::cancelled();
  if (out_.literals.empty()) return add({Vec3::Zero()}, run);
  Tree tree;
  tree.literals = out_.literals;
  const TreeRays rays(tree);
  Scene scene{{out_, rays, common_box(out_), literal_keys(out_.literals.size())},
              options,
              run.seed + 977 * options.stream,
              {},
              {}};
  for (const Literal& s : out_.literals) scene.planes.push_back(planes_of(s));
  const std::size_t literals = out_.literals.size();
  const std::size_t first = std::min(options.first_literal, literals);
  scene.neighbours = neighbours_of(out_, first);
  // Lines tell cells by counting crossings; the points themselves have the last word.
  Finds all;
  walk_along_faces(scene, first, run, all);
  walk_through_volume(scene, run, all);
  std::vector<Vec3> points = std::move(all.points);
  const Vec3 far = scene.box.hi + Vec3::Constant(out_.scale);
  points.push_back(far);
  const std::size_t added = add(points, run);
  if (run.is_cancelled()) return RunContext::cancelled();
  return added;
}

}  // namespace hewn
