#include "core/synth/verify.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/compute/parallel.h"
#include "core/csg/literal_boxes.h"
#include "core/csg/tree_ray.h"
#include "core/mesh/sampling.h"

namespace hewn {
namespace {

constexpr std::size_t kChunk = 512;
/// A tolerance above this (of the diagonal) marks an inexact surface.
constexpr double kInexact = 3e-5;
/// Points closer to an inexact surface than this many tolerances prove nothing.
constexpr double kInexactReach = 2.5;
/// Of the diagonal: points this far from the mesh have a certain label whatever surfaces they lie
/// on. Slabs between surfaces that are nearly one show only there.
constexpr double kFarFromMesh = 5e-3;
constexpr int kBoundaryTries = 24;  // per wanted point

std::size_t chunks_of(int points) {
  return (static_cast<std::size_t>(points) + kChunk - 1) / kChunk;
}

bool is_near_inexact(const SampleSpace& space, const Vec3& p) {
  return std::any_of(space.halfspaces->begin(), space.halfspaces->end(), [&](const Halfspace& h) {
    return h.tolerance > kInexact * space.diagonal &&
           std::abs(h.surface.signed_distance(p)) < kInexactReach * h.tolerance;
  });
}

struct Tally {
  long right = 0, wrong = 0;
  long far_wrong = 0;  ///< of the wrong ones: far from the mesh
  double agreement() const {
    const long total = right + wrong;
    return total == 0 ? 1 : static_cast<double>(right) / static_cast<double>(total);
  }
};

/// Compares proposed points; keeps the certain wrong ones.
class Comparison {
 public:
  Comparison(const SampleSpace& space, const SolidTest& solid, std::uint64_t stream,
             const RunContext& run)
      : space_(space), solid_(solid), stream_(stream), run_(run) {}

  Tally compare(std::size_t chunks, std::uint64_t kind, const Proposal& proposal,
                std::vector<LabelledPoint>& wrong) const {
    std::vector<Tally> tallies(chunks);
    std::vector<std::vector<LabelledPoint>> kept(chunks);
    for_each_index(run_.threads, chunks, [&](std::size_t chunk) {
      if (run_.is_cancelled()) return;
      Rng rng(run_.seed, (stream_ << 40) + (kind << 32) + chunk);
      proposal(chunk, rng, [&](const Vec3& p) {
        const Label label = (*space_.label)(p);
        if (label == Label::DontCare) return;
        const bool is_inside = label == Label::Inside;
        if (solid_(p) == is_inside) {
          ++tallies[chunk].right;
          return;
        }
        const bool is_far =
            space_.label->query().closest(p).distance > kFarFromMesh * space_.diagonal;
        if (!is_far && is_near_inexact(space_, p)) return;
        ++tallies[chunk].wrong;
        tallies[chunk].far_wrong += is_far;
        if (is_far || is_certain(space_, p)) kept[chunk].push_back({p, is_inside});
      });
    });
    Tally total;
    for (std::size_t c = 0; c < chunks; ++c) {
      total.right += tallies[c].right;
      total.wrong += tallies[c].wrong;
      total.far_wrong += tallies[c].far_wrong;
      wrong.insert(wrong.end(), kept[c].begin(), kept[c].end());
    }
    return total;
  }

 private:
  const SampleSpace& space_;
  const SolidTest& solid_;
  std::uint64_t stream_;
  const RunContext& run_;
};

/// Proposes points near the surface: by area, and by face group so that small ones get some.
Proposal near_surface(const SampleSpace& space, const SurfaceSampler& by_area) {
  return [&space, &by_area](std::size_t, Rng& rng, const auto& emit) {
    const auto& groups = space.segmentation->groups;
    for (std::size_t i = 0; i < kChunk; ++i) {
      SurfacePoint s;
      if (rng.coin()) {
        s = by_area.draw(rng);
      } else {
        const auto& triangles = groups[rng.below(groups.size())].triangles;
        if (triangles.empty()) continue;
        s.triangle = triangles[rng.below(triangles.size())];
        s.position = sample_triangle(space.mesh(), s.triangle, rng);
        s.normal = space.mesh().normals[s.triangle];
      }
      const double reach = space.diagonal * std::pow(10, -3.5 + 1.8 * rng.uniform());
      const double sign = rng.coin() ? 1 : -1;
      emit(s.position + s.normal * (sign * reach));
    }
  };
}

/// A point on a term's boundary where `literal` alone decides; false when none was met.
bool find_boundary_point(const SampleSpace& space, const Term& term, std::size_t literal, Rng& rng,
                         Vec3& p) {
  const auto& halfspaces = *space.halfspaces;
  const Surface& s = halfspaces[term.literals[literal].halfspace].surface;
  p = sample_in_box(space, 0.02, rng);
  for (int k = 0; k < 2; ++k) p -= s.gradient(p) * s.signed_distance(p);
  if (!p.allFinite() || !space.frame.box.contains(space.frame.to_local(p), 0.02 * space.diagonal)) {
    return false;
  }
  for (std::size_t k = 0; k < term.literals.size(); ++k) {
    const TermLiteral& other = term.literals[k];
    const double d = halfspaces[other.halfspace].surface.signed_distance(p);
    if (k != literal && (d < 0) != other.inside) return false;
  }
  return true;
}

Proposal term_boundaries(const SampleSpace& space, const DecisionList& list, int wanted) {
  return [&space, &list, wanted](std::size_t chunk, Rng& rng, const auto& emit) {
    const Term& term = *list.items[chunk];
    for (std::size_t q = 0; q < term.literals.size(); ++q) {
      const Halfspace& h = (*space.halfspaces)[term.literals[q].halfspace];
      int got = 0;
      for (int k = 0; k < wanted * kBoundaryTries && got < wanted; ++k) {
        Vec3 p;
        if (!find_boundary_point(space, term, q, rng, p)) continue;
        ++got;
        const double reach =
            std::max(1.3 * h.tolerance, space.diagonal * std::pow(10, -4.3 + 2.3 * rng.uniform()));
        const Vec3 normal = h.surface.gradient(p);
        emit(p - normal * reach);
        emit(p + normal * reach);
      }
    }
  };
}

constexpr std::size_t kLinesPerChunk = 64;

/// Proposes points along random lines through the boxes, one box a chunk: midway between crossings
/// of the tree's surface, where a whole slot or plug may be wrong, and close to them on both sides.
Proposal along_lines(const SampleSpace& space, const TreeRays& rays, std::vector<Box3> boxes) {
  return [&space, &rays, boxes = std::move(boxes)](std::size_t chunk, Rng& rng, const auto& emit) {
    const Box3& box = boxes[chunk % boxes.size()];
    if (box.is_empty()) return;
    TreeRayScratch scratch;
    std::vector<double> crossings;
    for (std::size_t i = 0; i < kLinesPerChunk; ++i) {
      const Line line = draw_line(box.center(), 0.5 * box.diagonal(), rng);
      crossings.clear();
      for (const TreeInterval& inside : rays.cast(line.origin, line.direction, scratch)) {
        crossings.push_back(inside.enter.t);
        crossings.push_back(inside.leave.t);
      }
      for (std::size_t k = 0; k + 1 < crossings.size(); ++k) {
        const double half = 0.5 * (crossings[k + 1] - crossings[k]);
        const double reach =
            std::min(half, space.diagonal * std::pow(10, -4.3 + 2.3 * rng.uniform()));
        for (const double t :
             {crossings[k] + reach, crossings[k] + half, crossings[k + 1] - reach}) {
          const Vec3 p = line.origin + t * line.direction;
          if (box.contains(p)) emit(p);
        }
      }
    }
  };
}

Proposal uniform(const SampleSpace& space) {
  return [&space](std::size_t, Rng& rng, const auto& emit) {
    for (std::size_t i = 0; i < kChunk; ++i) emit(sample_in_box(space, 0, rng));
  };
}

}  // namespace

ListSolid::ListSolid(const DecisionList& list, const std::vector<Halfspace>& halfspaces,
                     const Frame& frame, bool clip)
    : list_(&list), halfspaces_(&halfspaces), frame_(&frame), clip_(clip) {}

bool ListSolid::contains(const Vec3& p) const {
  if (clip_ && !frame_->box.contains(frame_->to_local(p))) return false;
  for (const TermPtr& item : list_->items) {
    const bool covers =
        std::all_of(item->literals.begin(), item->literals.end(), [&](const TermLiteral& l) {
          return ((*halfspaces_)[l.halfspace].surface.signed_distance(p) < 0) == l.inside;
        });
    if (covers) return item->fills;
  }
  return list_->base;
}

Verification verify_list(const SampleSpace& space, const Candidate& candidate,
                         const VerifyOptions& options, std::uint64_t stream,
                         const RunContext& run) {
  Verification result;
  const DecisionList& list = candidate.list;
  const Comparison comparison(space, candidate.contains, stream, run);
  const auto agreement = [&](std::size_t chunks, std::uint64_t kind, const Proposal& proposal) {
    const Tally tally = comparison.compare(chunks, kind, proposal, result.counterexamples);
    result.has_stray = result.has_stray || tally.far_wrong > 0;
    return tally.agreement();
  };
  result.agreement = agreement(chunks_of(options.uniform_points), 1, uniform(space));
  std::vector<int> owned;
  for (std::size_t g = 0; g < space.segmentation->groups.size(); ++g) {
    if (!space.label->owns_group(static_cast<int>(g))) continue;
    const auto& triangles = space.segmentation->groups[g].triangles;
    owned.insert(owned.end(), triangles.begin(), triangles.end());
  }
  const SurfaceSampler by_area(space.mesh(), owned);
  if (!by_area.is_empty()) {
    agreement(chunks_of(options.near_points), 2, near_surface(space, by_area));
  }
  const auto around = [&space](std::size_t, Rng& rng, const auto& emit) {
    for (std::size_t i = 0; i < kChunk; ++i) emit(sample_around_box(space, rng));
  };
  agreement(chunks_of(options.around_points), 3, around);
  agreement(list.items.size(), 4, term_boundaries(space, list, options.points_per_literal));
  if (!candidate.tree.is_empty()) {
    const TreeRays rays(candidate.tree);
    const std::size_t chunks = static_cast<std::size_t>(options.lines) / kLinesPerChunk;
    result.line_agreement =
        agreement(chunks, 5, along_lines(space, rays, {candidate.tree.bounds()}));
    std::vector<Box3> boxes = literal_boxes(candidate.tree);
    const std::size_t aimed =
        boxes.size() * static_cast<std::size_t>(options.lines_per_literal) / kLinesPerChunk;
    if (aimed > 0) agreement(aimed, 6, along_lines(space, rays, std::move(boxes)));
  }
  return result;
}

double measure_agreement(const SampleSpace& space, const SolidTest& solid, int points,
                         std::uint64_t stream, const RunContext& run) {
  std::vector<LabelledPoint> ignored;
  const Comparison comparison(space, solid, stream, run);
  return comparison.compare(chunks_of(points), 1, uniform(space), ignored).agreement();
}

}  // namespace hewn
