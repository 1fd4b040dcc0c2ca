#include "core/sample/arrangement.h"

#include <algorithm>
#include <cmath>
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

/// Cells found by one chunk of work, each once.
struct Finds {
  std::vector<Vec3> points;
  std::vector<Word> signatures;
  std::unordered_multimap<std::uint64_t, std::size_t> by_hash;  // looked up only

  bool is_new(const Word* signature, std::size_t stride) {
    const std::uint64_t hash = hash_words({signature, stride});
    const auto [begin, end] = by_hash.equal_range(hash);
    for (auto it = begin; it != end; ++it) {
      if (std::equal(signature, signature + stride, signatures.data() + it->second * stride)) {
        return false;
      }
    }
    by_hash.emplace(hash, points.size());
    return true;
  }
  void add(const Vec3& p, const Word* signature, std::size_t stride) {
    if (!is_new(signature, stride)) return;
    points.push_back(p);
    signatures.insert(signatures.end(), signature, signature + stride);
  }
};

/// What all chunks read.
struct Scene {
  const Arrangement& arrangement;
  const TreeRays& rays;
  Box3 box;  ///< of all literals
  const ArrangementOptions& options;
  std::uint64_t seed;
};

/// Walks lines and circles through the arrangement.
class Walker {
 public:
  Walker(const Scene& scene, Finds& finds) : scene_(scene), finds_(finds) {
    signature_.resize(scene.arrangement.stride);
  }

  /// Every cell along the line that is longer than rounding on it.
  void line(const ProbeLine& probe) {
    const double reach = 2 * scene_.box.diagonal() + (probe.point - scene_.box.center()).norm();
    const Vec3 from = probe.point - reach * probe.direction;
    events_.clear();
    const int literals = static_cast<int>(scene_.arrangement.literals.size());
    for (int k = 0; k < literals; ++k) {
      scene_.rays.cast_literal(k, from, probe.direction, stretches_);
      for (const TreeInterval& s : stretches_) {
        events_.push_back({s.enter.t, k});
        events_.push_back({s.leave.t, k});
      }
    }
    std::sort(events_.begin(), events_.end());
    std::fill(signature_.begin(), signature_.end(), 0);
    const double shortest = 4 * kUncertain * scene_.arrangement.scale;
    for (std::size_t i = 0; i < events_.size(); ++i) {
      signature_[static_cast<std::size_t>(events_[i].second) / 64] ^= Word{1}
                                                                      << (events_[i].second % 64);
      const bool is_last = i + 1 == events_.size();
      const double next = is_last ? events_[i].first + reach * 0.01 : events_[i + 1].first;
      if (next - events_[i].first < shortest) continue;
      const Vec3 p = from + (events_[i].first + next) / 2 * probe.direction;
      finds_.add(p, signature_.data(), signature_.size());
    }
  }

  /// Samples around the circle, and between samples that more than one surface separates.
  void circle(const ProbeCircle& probe) {
    std::vector<Word> first;
    std::vector<Word> last;
    for (int k = 0; k <= kSamples; ++k) {
      const double angle = 2 * kPi * k / kSamples;
      std::vector<Word> here = at(probe, angle);
      if (k == 0) first = here;
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
    finds_.add(p, signature.data(), signature.size());
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
  std::vector<Word> signature_;
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
    const Box3 box =
        i % 2 == 0 ? scene.box : scene.arrangement.literals[rng.below(literals)].bounds();
    const Vec3 a = point_in(box, rng);
    const Vec3 b = point_in(box, rng);
    const Vec3 d = i % 8 < 3 ? Vec3(Vec3::Unit(i % 3)) : Vec3(b - a);
    if (d.norm() > 0) walker.line({a, d.normalized()});
  }
}

void walk_faces(const Scene& scene, std::size_t literal, Finds& finds) {
  Rng rng(scene.seed, 2 * literal + 1);
  Walker walker(scene, finds);
  const Probes probes = probes_of(scene.arrangement.literals[literal], scene.arrangement.resolution,
                                  scene.options.lines_per_face, scene.options.curves_per_face, rng);
  for (const ProbeLine& line : probes.lines) walker.line(line);
  for (const ProbeCircle& circle : probes.circles) walker.circle(circle);
}

/// Along the common line of two planes of different literals, in all four wedges.
void walk_crossings(const Scene& scene, std::size_t chunk, Finds& finds) {
  Rng rng(scene.seed ^ 0xC0FFEE, chunk);
  Walker walker(scene, finds);
  const auto& literals = scene.arrangement.literals;
  for (int i = 0; i < kLinesPerChunk / 4; ++i) {
    const std::size_t a = rng.below(literals.size());
    const std::size_t b = rng.below(literals.size());
    const auto planes_a = planes_of(literals[a]);
    const auto planes_b = planes_of(literals[b]);
    if (a == b || planes_a.empty() || planes_b.empty()) continue;
    const FacePlane& p = planes_a[rng.below(planes_a.size())];
    const FacePlane& q = planes_b[rng.below(planes_b.size())];
    const Vec3 along = p.normal.cross(q.normal);
    const double sine2 = along.squaredNorm();
    if (sine2 < 1e-10) continue;
    for (int k = 0; k < 4; ++k) {
      const double side = scene.arrangement.resolution;
      const double at_p = p.normal.dot(p.point) + ((k & 1) ? side : -side);
      const double at_q = q.normal.dot(q.point) + ((k & 2) ? side : -side);
      const Vec3 point = (at_p * q.normal.cross(along) + at_q * along.cross(p.normal)) / sine2;
      walker.line({point, along / std::sqrt(sine2)});
    }
  }
}

}  // namespace

bool classify(const Arrangement& arrangement, const Vec3& p, Word* signature) {
  std::fill(signature, signature + arrangement.stride, 0);
  for (std::size_t k = 0; k < arrangement.literals.size(); ++k) {
    const Literal& s = arrangement.literals[k];
    const double d = s.signed_distance(p);
    double margin = kUncertain * arrangement.scale;
    if (s.kind == SolidKind::Polyhedron && s.polyhedron) {
      margin = std::max(margin, kUncertainMesh * s.polyhedron->diagonal());
    }
    if (std::abs(d) < margin) return false;
    if (d < 0) set_bit(signature, k);
  }
  return true;
}

ArrangementSampler::ArrangementSampler(std::vector<Literal> literals, double scale) {
  out_.literals = std::move(literals);
  out_.stride = std::max<std::size_t>(1, (out_.literals.size() + 63) / 64);
  out_.scale = scale;
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
  Scene scene{out_, rays, {}, options, run.seed + 977 * options.stream};
  for (const Literal& s : out_.literals) {
    const Box3 box = s.bounds();
    scene.box.extend(box.lo);
    scene.box.extend(box.hi);
  }
  const std::size_t literals = out_.literals.size();
  const std::size_t volume = 1 + static_cast<std::size_t>(options.volume_lines) / kLinesPerChunk;
  const std::size_t crossings =
      static_cast<std::size_t>(options.crossing_lines) / (kLinesPerChunk / 4);
  const std::size_t first = std::min(options.first_literal, literals);
  const std::size_t faces = literals - first;
  std::vector<Finds> finds(volume + faces + crossings);
  for_each_index(run.threads, finds.size(), [&](std::size_t i) {
    if (run.is_cancelled()) return;
    if (i < volume) {
      walk_volume(scene, i, finds[i]);
    } else if (i < volume + faces) {
      walk_faces(scene, first + i - volume, finds[i]);
    } else {
      walk_crossings(scene, i - volume - faces, finds[i]);
    }
  });
  // Lines tell cells by counting crossings; the points themselves have the last word.
  Finds all;
  for (const Finds& f : finds) {
    for (std::size_t i = 0; i < f.points.size() && all.points.size() < options.most_cells; ++i) {
      all.add(f.points[i], f.signatures.data() + i * out_.stride, out_.stride);
    }
  }
  std::vector<Vec3> points = std::move(all.points);
  const Vec3 far = scene.box.hi + Vec3::Constant(out_.scale);
  points.push_back(far);
  const std::size_t added = add(points, run);
  if (run.is_cancelled()) return RunContext::cancelled();
  return added;
}

}  // namespace hewn
