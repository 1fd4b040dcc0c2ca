#include "core/sample/arrangement.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "core/base/rng.h"
#include "core/compute/parallel.h"
#include "core/csg/tree_ray.h"
#include "core/sample/arrangement_lines.h"
#include "core/sample/arrangement_walk.h"
#include "core/sample/carried_sides.h"
#include "core/sample/crossings.h"

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
  std::size_t edges_known_from;  ///< the edges of literals from this one on are known
};

Vec3 point_in(const Box3& box, Rng& rng) {
  Vec3 p;
  for (int k = 0; k < 3; ++k) p[k] = rng.uniform(box.lo[k], box.hi[k]);
  return p;
}

constexpr int kLinesPerChunk = 200;

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

constexpr int kRounds = 4;

/// A share of the lines along a literal's faces; in the first round, all along its edges, too.
void walk_faces(const Scene& scene, std::size_t literal, int round, Finds& finds) {
  const auto up_to = [](int count, int rounds) { return (count * rounds + kRounds - 1) / kRounds; };
  const auto share = [&](int count) { return up_to(count, round + 1) - up_to(count, round); };
  const Literal& s = scene.arrangement.literals[literal];
  // Of a large mesh's edges only some are walked, other ones each time.
  const bool has_edges = literal < scene.edges_known_from || s.kind == SolidKind::Polyhedron;
  const ProbeOptions options{scene.arrangement.resolution, share(scene.options.lines_per_face),
                             share(scene.options.curves_per_face), has_edges && round == 0};
  Rng rng(scene.seed, 2 * (kRounds * literal + static_cast<std::size_t>(round)) + 1);
  Walker walker(scene, finds);
  const Probes probes = probes_of(s, options, rng);
  for (const ProbeLine& line : probes.lines) walker.line(line);
  for (const ProbeCircle& circle : probes.circles) walker.circle(circle);
}

/// Along the common line of two planes, in all four wedges.
void walk_crossing(const Scene& scene, const Crossing& crossing, Walker& walker) {
  const double side = scene.arrangement.resolution;
  const Vec3 direction = crossing.along.normalized();
  for (int k = 0; k < 4; ++k) {
    walker.line({crossing.point((k & 1) ? side : -side, (k & 2) ? side : -side), direction});
  }
}

/// Cells found so far that nobody knew before.
class NewCells {
 public:
  NewCells(KeySet& known, std::size_t most) : known_(known), most_(most) {}

  /// Walks the chunks, which all see what is known before, and joins what they find. Calls
  /// `walk(i, finds)`. Returns which chunks found anything.
  template <class Walk>
  std::vector<char> walk_chunks(std::size_t chunks, const RunContext& run, const Walk& walk) {
    std::vector<Finds> finds(chunks);
    for_each_index(run.threads, chunks, [&](std::size_t i) {
      if (!run.is_cancelled()) walk(i, finds[i]);
    });
    std::vector<char> has_new(chunks, 0);
    for (std::size_t i = 0; i < chunks; ++i) has_new[i] = join(finds[i]) ? 1 : 0;
    return has_new;
  }

  std::vector<Vec3> take_points() { return std::move(points_); }

 private:
  bool join(const Finds& finds) {
    const std::size_t before = points_.size();
    for (std::size_t i = 0; i < finds.points.size() && points_.size() < most_; ++i) {
      if (known_.insert(finds.keys[i])) points_.push_back(finds.points[i]);
    }
    return points_.size() > before;
  }

  KeySet& known_;
  std::size_t most_;
  std::vector<Vec3> points_;
};

/// Along the faces of every literal from `first` on, in rounds until one finds nothing new.
void walk_along_faces(const Scene& scene, std::size_t first, const RunContext& run,
                      NewCells& cells) {
  std::vector<std::size_t> literals(scene.arrangement.literals.size() - first);
  std::iota(literals.begin(), literals.end(), first);
  for (int round = 0; round < kRounds && !literals.empty(); ++round) {
    const auto has_new = cells.walk_chunks(literals.size(), run, [&](std::size_t i, Finds& finds) {
      walk_faces(scene, literals[i], round, finds);
    });
    std::vector<std::size_t> rest;
    for (std::size_t i = 0; i < literals.size(); ++i) {
      if (has_new[i]) rest.push_back(literals[i]);
    }
    literals = std::move(rest);
  }
}

/// Along lines where faces of two literals cross.
void walk_along_crossings(const Scene& scene, const std::vector<Crossing>& crossings,
                          const RunContext& run, NewCells& cells) {
  const std::size_t chunks = (crossings.size() + kLinesPerChunk - 1) / kLinesPerChunk;
  cells.walk_chunks(chunks, run, [&](std::size_t i, Finds& finds) {
    Walker walker(scene, finds);
    const std::size_t end = std::min((i + 1) * kLinesPerChunk, crossings.size());
    for (std::size_t k = i * kLinesPerChunk; k < end; ++k) {
      walk_crossing(scene, crossings[k], walker);
    }
  });
}

/// Random lines, batch by batch, until one finds nothing new.
void walk_through_volume(const Scene& scene, const RunContext& run, NewCells& cells) {
  constexpr std::size_t kChunksPerBatch = 4;
  const std::size_t most =
      1 + static_cast<std::size_t>(scene.options.volume_lines) / kLinesPerChunk;
  for (std::size_t done = 0; done < most && !run.is_cancelled();) {
    const std::size_t chunks = std::min(kChunksPerBatch, most - done);
    const auto has_new = cells.walk_chunks(
        chunks, run, [&](std::size_t i, Finds& finds) { walk_volume(scene, done + i, finds); });
    done += chunks;
    if (std::find(has_new.begin(), has_new.end(), 1) == has_new.end()) return;
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
    is_certain = take_side(arrangement, k, p, signature);
    return is_certain;
  });
  return is_certain;
}

ArrangementSampler::ArrangementSampler(std::vector<Literal> literals, double scale) {
  out_.literals = std::move(literals);
  keys_ = literal_keys(out_.literals.size());
  edges_known_from_ = crossings_known_from_ = out_.literals.size();
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
  std::uint64_t key = 0;
  for_each_bit({signature, out_.stride}, [&](std::size_t k) { key ^= keys_[k]; });
  known_.insert(key);
  out_.points.push_back(point);
  out_.signatures.insert(out_.signatures.end(), signature, signature + out_.stride);
  return true;
}

std::size_t ArrangementSampler::cell_of(const Vec3& p) const {
  std::vector<Word> signature(out_.stride);
  return classify(out_, p, signature.data()) ? find(signature.data()) : out_.size();
}

/// `classify(i, signature)` is asked on which sides point i lies.
template <class Classify>
std::size_t ArrangementSampler::add_points(const std::vector<Vec3>& points, const RunContext& run,
                                           const Classify& classify) {
  std::vector<Word> signatures(points.size() * out_.stride);
  std::vector<char> is_certain(points.size(), 0);
  for_each_chunk(run.threads, points.size(), 64, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end && !run.is_cancelled(); ++i) {
      is_certain[i] = classify(i, signatures.data() + i * out_.stride) ? 1 : 0;
    }
  });
  std::size_t added = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (is_certain[i] && insert(points[i], signatures.data() + i * out_.stride)) ++added;
  }
  return added;
}

std::size_t ArrangementSampler::add(const std::vector<Vec3>& points, const RunContext& run) {
  return add_points(points, run, [&](std::size_t i, Word* signature) {
    return classify(out_, points[i], signature);
  });
}

std::size_t ArrangementSampler::add(const Arrangement& known, const RunContext& run) {
  const CarriedSides carried(known, out_);
  return add_points(known.points, run,
                    [&](std::size_t i, Word* signature) { return carried.classify(i, signature); });
}

Result<std::size_t> ArrangementSampler::sample(const ArrangementOptions& options,
                                               const RunContext& run) {
  if (run.is_cancelled()) return RunContext::cancelled();
  if (out_.literals.empty()) return add({Vec3::Zero()}, run);
  Tree tree;
  tree.literals = out_.literals;
  const TreeRays rays(tree);
  // A copy: what is too near to a surface at the point found may yet be found elsewhere.
  KeySet known = known_;
  const Scene scene{{out_, rays, keys_, known, common_box(out_)},
                    options,
                    run.seed + 977 * options.stream,
                    edges_known_from_};
  const std::size_t first = std::min(options.first_literal, out_.literals.size());
  const Crossings crossings = find_crossings(
      out_, first, std::max(first, crossings_known_from_),
      static_cast<std::size_t>(std::max(0, options.crossing_lines)), Rng(scene.seed ^ 0xC0FFEE));
  // Lines tell cells by counting crossings; the points themselves have the last word.
  NewCells cells(known, options.most_cells);
  walk_along_faces(scene, first, run, cells);
  walk_along_crossings(scene, crossings.found, run, cells);
  walk_through_volume(scene, run, cells);
  edges_known_from_ = std::min(edges_known_from_, first);
  if (crossings.are_all) crossings_known_from_ = std::min(crossings_known_from_, first);
  std::vector<Vec3> points = cells.take_points();
  const Vec3 far = scene.box.hi + Vec3::Constant(out_.scale);
  points.push_back(far);
  const std::size_t added = add(points, run);
  if (run.is_cancelled()) return RunContext::cancelled();
  return added;
}

}  // namespace hewn
