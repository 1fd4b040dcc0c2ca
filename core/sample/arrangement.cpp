#include "core/sample/arrangement.h"

#include <algorithm>
#include <cmath>
#include <unordered_set>
#include <utility>

#include "core/base/rng.h"
#include "core/compute/parallel.h"
#include "core/csg/tree_ray.h"
#include "core/sample/arrangement_lines.h"

namespace hewn {
namespace {

constexpr double kResolution = 1e-6;  ///< share of the scale
/// Nearer to a surface than this share of the scale, rounding may decide the side.
constexpr double kUncertain = 1e-9;
constexpr double kUncertainMesh = 3e-7;  ///< of a polyhedron's diagonal: rays in single precision

/// Cells found by one chunk of work, each once. A cell is known by its key, the exclusive or of the
/// keys of the literals that hold it: one crossing changes it at once. That two cells have the same
/// key is less likely than a cell no line meets.
struct Finds {
  std::vector<Vec3> points;
  std::vector<std::uint64_t> keys;
  std::unordered_set<std::uint64_t> known;  // looked up only

  void add(const Vec3& p, std::uint64_t key) {
    if (!known.insert(key).second) return;
    points.push_back(p);
    keys.push_back(key);
  }
};

std::vector<std::uint64_t> literal_keys(std::size_t literals) {
  Rng rng(0x5CE11);
  std::vector<std::uint64_t> keys(literals);
  for (std::uint64_t& key : keys) key = rng.next();
  return keys;
}

/// What all chunks read.
struct Scene {
  const Arrangement& arrangement;
  const TreeRays& rays;
  Box3 box;  ///< of all literals
  const ArrangementOptions& options;
  std::uint64_t seed;
  std::vector<std::uint64_t> keys;              ///< of each literal
  std::vector<std::vector<FacePlane>> planes;   ///< of each literal
  std::vector<std::pair<int, int>> neighbours;  ///< literals whose bounds meet
};

/// Walks lines and circles through the arrangement.
class Walker {
 public:
  Walker(const Scene& scene, Finds& finds) : scene_(scene), finds_(finds) {}

  /// Every cell along the line that is longer than rounding on it.
  void line(const ProbeLine& probe) {
    const double reach = 2 * scene_.box.diagonal() + (probe.point - scene_.box.center()).norm();
    const Vec3 from = probe.point - reach * probe.direction;
    events_.clear();
    scene_.rays.cast_literals(from, probe.direction, stretches_);
    for (const TreeInterval& s : stretches_) {
      events_.push_back({s.enter.t, s.enter.literal});
      events_.push_back({s.leave.t, s.leave.literal});
    }
    std::sort(events_.begin(), events_.end());
    std::uint64_t key = 0;
    const double shortest = 4 * kUncertain * scene_.arrangement.scale;
    for (std::size_t i = 0; i < events_.size(); ++i) {
      key ^= scene_.keys[static_cast<std::size_t>(events_[i].second)];
      const bool is_last = i + 1 == events_.size();
      const double next = is_last ? events_[i].first + reach * 0.01 : events_[i + 1].first;
      if (next - events_[i].first < shortest) continue;
      const Vec3 p = from + (events_[i].first + next) / 2 * probe.direction;
      finds_.add(p, key);
    }
  }

  /// Samples around the circle, and between samples that more than one surface separates.
  void circle(const ProbeCircle& probe) {
    std::vector<Word> last;
    for (int k = 0; k <= kSamples; ++k) {
      const double angle = 2 * kPi * k / kSamples;
      std::vector<Word> here = at(probe, angle);
      if (k > 0) refine(probe, angle - 2 * kPi / kSamples, angle, last, here, 0);
      last = std::move(here);
    }
  }

 private:
  static constexpr int kSamples = 48;
  static constexpr int kDeepest = 9;

  /// The signature on the circle; empty when a surface is too near.
  std::vector<Word> at(const ProbeCircle& probe, double angle) {
    const Vec3 p = probe.center + std::cos(angle) * probe.u + std::sin(angle) * probe.w;
    std::vector<Word> signature(scene_.arrangement.stride);
    if (!classify(scene_.arrangement, p, signature.data())) return {};
    std::uint64_t key = 0;
    for_each_bit(signature, [&](std::size_t literal) { key ^= scene_.keys[literal]; });
    finds_.add(p, key);
    return signature;
  }

  void refine(const ProbeCircle& probe, double from, double to, const std::vector<Word>& a,
              const std::vector<Word>& b, int depth) {
    if (depth >= kDeepest || a.empty() || b.empty()) return;
    int different = 0;
    for (std::size_t i = 0; i < a.size(); ++i) different += std::popcount(a[i] ^ b[i]);
    if (different < 2) return;
    const double middle = (from + to) / 2;
    const std::vector<Word> m = at(probe, middle);
    refine(probe, from, middle, a, m, depth + 1);
    refine(probe, middle, to, m, b, depth + 1);
  }

  const Scene& scene_;
  Finds& finds_;
  std::vector<std::pair<double, int>> events_;
  std::vector<TreeInterval> stretches_;
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

/// Two planes of different literals.
struct Crossing {
  const FacePlane* p;
  const FacePlane* q;
};

/// All pairs of planes of neighbours when they are few, else random ones.
std::vector<Crossing> crossings_of(const Scene& scene, std::size_t most) {
  std::size_t count = 0;
  for (const auto& [a, b] : scene.neighbours) {
    count += scene.planes[static_cast<std::size_t>(a)].size() *
             scene.planes[static_cast<std::size_t>(b)].size();
  }
  std::vector<Crossing> out;
  if (count <= most) {
    for (const auto& [a, b] : scene.neighbours) {
      for (const FacePlane& p : scene.planes[static_cast<std::size_t>(a)]) {
        for (const FacePlane& q : scene.planes[static_cast<std::size_t>(b)]) {
          out.push_back({&p, &q});
        }
      }
    }
    return out;
  }
  Rng rng(scene.seed ^ 0xC0FFEE, 0);
  for (std::size_t i = 0; i < most; ++i) {
    const auto& [a, b] = scene.neighbours[rng.below(scene.neighbours.size())];
    const auto& of_a = scene.planes[static_cast<std::size_t>(a)];
    const auto& of_b = scene.planes[static_cast<std::size_t>(b)];
    if (of_a.empty() || of_b.empty()) continue;
    const FacePlane& p = of_a[rng.below(of_a.size())];
    const FacePlane& q = of_b[rng.below(of_b.size())];
    out.push_back({&p, &q});
  }
  return out;
}

/// Along the common line of two planes, in all four wedges.
void walk_crossing(const Scene& scene, const Crossing& crossing, Walker& walker) {
  const FacePlane& p = *crossing.p;
  const FacePlane& q = *crossing.q;
  const Vec3 along = p.normal.cross(q.normal);
  const double sine2 = along.squaredNorm();
  if (sine2 < 1e-10) return;
  for (int k = 0; k < 4; ++k) {
    const double side = scene.arrangement.resolution;
    const double at_p = p.normal.dot(p.point) + ((k & 1) ? side : -side);
    const double at_q = q.normal.dot(q.point) + ((k & 2) ? side : -side);
    const Vec3 point = (at_p * q.normal.cross(along) + at_q * along.cross(p.normal)) / sine2;
    walker.line({point, along / std::sqrt(sine2)});
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

}  // namespace

bool classify(const Arrangement& arrangement, const Vec3& p, Word* signature) {
  std::fill(signature, signature + arrangement.stride, 0);
  for (std::size_t k = 0; k < arrangement.literals.size(); ++k) {
    const Literal& s = arrangement.literals[k];
    double margin = kUncertain * arrangement.scale;
    if (s.kind == SolidKind::Polyhedron && s.polyhedron) {
      margin = std::max(margin, kUncertainMesh * s.polyhedron->diagonal());
    }
    const double d = distance_within(s, arrangement.bounds[k], p, margin);
    if (std::abs(d) < margin) return false;
    if (d < 0) set_bit(signature, k);
  }
  return true;
}

ArrangementSampler::ArrangementSampler(std::vector<Literal> literals, double scale) {
  out_.literals = std::move(literals);
  out_.stride = std::max<std::size_t>(1, (out_.literals.size() + 63) / 64);
  out_.scale = scale;
  for (const Literal& s : out_.literals) out_.bounds.emplace_back(s);
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
  Scene scene{
      out_, rays, {}, options, run.seed + 977 * options.stream, literal_keys(out_.literals.size()),
      {},   {}};
  for (const LiteralBounds& bounds : out_.bounds) {
    scene.box.extend(bounds.box.lo);
    scene.box.extend(bounds.box.hi);
  }
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
