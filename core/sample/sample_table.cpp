#include "core/sample/sample_table.h"

#include <algorithm>
#include <cmath>
#include <span>

#include "core/compute/compute.h"
#include "core/compute/parallel.h"
#include "core/compute/signatures.h"
#include "core/mesh/sampling.h"

namespace hewn {
namespace {

constexpr std::size_t kPointsPerChunk = 512;
constexpr int kPairsPerGroup = 64;
constexpr int kPairTries = 400;
constexpr int kNearPerGroup = 60;

std::size_t words_for(std::size_t bits) { return (bits + 63) / 64; }

/// Sets the bits of the halfspaces from `first_halfspace` on in the signatures of the points from
/// `first_point` on, on the device that suits. What is left undone when the run is cancelled stays
/// clear.
void fill_signatures(SampleTable& table, const std::vector<Halfspace>& halfspaces,
                     std::size_t first_halfspace, std::size_t first_point, const RunContext& run) {
  std::vector<SurfaceForm> forms;
  for (std::size_t k = first_halfspace; k < halfspaces.size(); ++k) {
    forms.push_back(halfspaces[k].surface.form());
  }
  const auto points = std::span<const Vec3>(table.points).subspan(first_point);
  const SignatureRows rows{std::span(table.signatures).subspan(first_point * table.stride),
                           table.stride};
  const auto job = [&](Device& device) {
    // A device that failed may have left anything there.
    for (std::size_t i = 0; i < points.size(); ++i) {
      Word* row = rows.words.data() + i * rows.stride;
      if (first_halfspace % 64 != 0) {
        row[first_halfspace / 64] &= (Word{1} << (first_halfspace % 64)) - 1;
      }
      std::fill(row + words_for(first_halfspace), row + rows.stride, 0);
    }
    return add_signatures(device, forms, points, first_halfspace, rows, run);
  };
  const double seconds = seconds_for_sides(forms.size(), points.size());
  // The processor does it when a device fails, so that only a stop is left: callers look for it.
  static_cast<void>(compute_of(run)->run(seconds, run, job));
}

/// The pairs and near points of one face group, with its own generator.
struct GroupSamples {
  std::vector<std::pair<Vec3, Vec3>> pairs;  ///< inside, outside
  std::vector<LabelledPoint> near_points;
};

GroupSamples sample_group(const SampleSpace& space, int group_index, int halfspace, Rng& rng) {
  const FaceGroup& group = space.segmentation->groups[group_index];
  const SurfaceSampler sampler(space.mesh(), group.triangles);
  GroupSamples out;
  if (sampler.is_empty()) return out;
  const Halfspace& h = (*space.halfspaces)[halfspace];
  const Labeller& label = *space.label;
  const double least = std::max(1.3 * h.tolerance, 1.5e-4 * space.diagonal);
  for (int k = 0; k < kPairTries && static_cast<int>(out.pairs.size()) < kPairsPerGroup; ++k) {
    const SurfacePoint s = sampler.draw(rng);
    Vec3 normal = h.surface.gradient(s.position);
    if (normal.dot(s.normal) < 0) normal = -normal;
    const double reach = least * (1 + rng.uniform() * (k % 3 == 0 ? 4 : 1));
    const Vec3 below = s.position - normal * reach;
    const Vec3 above = s.position + normal * reach;
    if (!is_certain(space, below) || !is_certain(space, above)) continue;
    const Label low = label(below);
    const Label high = label(above);
    if (low == Label::Inside && high == Label::Outside) out.pairs.emplace_back(below, above);
    if (low == Label::Outside && high == Label::Inside) out.pairs.emplace_back(above, below);
  }
  for (int k = 0; k < kNearPerGroup; ++k) {
    const SurfacePoint s = sampler.draw(rng);
    const double reach = space.diagonal * std::pow(10, -3.3 + 2.0 * rng.uniform());
    const double sign = rng.coin() ? -1 : 1;
    Vec3 p = s.position + s.normal * (sign * reach);
    for (double& c : p) c += (rng.uniform() - 0.5) * reach;
    if (!is_certain(space, p)) continue;
    const Label l = label(p);
    if (l != Label::DontCare) out.near_points.push_back({p, l == Label::Inside});
  }
  return out;
}

void append_group_samples(const SampleSpace& space, const std::vector<int>& halfspace_of_group,
                          SampleTable& table, const RunContext& run) {
  const std::size_t groups = space.segmentation->groups.size();
  std::vector<GroupSamples> samples(groups);
  for_each_index(run.threads, groups, [&](std::size_t g) {
    if (halfspace_of_group[g] < 0 || !space.label->owns_group(static_cast<int>(g))) return;
    Rng rng(run.seed, 0x10000 + g);
    samples[g] = sample_group(space, static_cast<int>(g), halfspace_of_group[g], rng);
  });
  std::vector<LabelledPoint> points;
  for (std::size_t g = 0; g < groups; ++g) {
    for (const auto& [inside, outside] : samples[g].pairs) {
      const int first = static_cast<int>(table.size() + points.size());
      table.pairs.push_back({first, first + 1, static_cast<int>(g)});
      points.push_back({inside, true});
      points.push_back({outside, false});
    }
    const auto& near_points = samples[g].near_points;
    points.insert(points.end(), near_points.begin(), near_points.end());
  }
  append_points(table, *space.halfspaces, points, run);
}

}  // namespace

bool is_certain(const SampleSpace& space, const Vec3& p) {
  return std::none_of(space.halfspaces->begin(), space.halfspaces->end(), [&p](const Halfspace& h) {
    return std::abs(h.surface.signed_distance(p)) < h.tolerance;
  });
}

void append_proposed(SampleTable& table, const SampleSpace& space, std::size_t chunks,
                     std::uint64_t stream, const RunContext& run, const Proposal& proposal) {
  std::vector<std::vector<Vec3>> certain(chunks);
  for_each_index(run.threads, chunks, [&](std::size_t chunk) {
    if (run.is_cancelled()) return;
    Rng rng(run.seed, (stream << 32) + chunk);
    proposal(chunk, rng, [&](const Vec3& p) {
      if (is_certain(space, p)) certain[chunk].push_back(p);
    });
  });
  std::vector<Vec3> points;
  for (const auto& part : certain) points.insert(points.end(), part.begin(), part.end());
  const std::vector<Label> labels = (*space.label)(points, run);
  std::vector<LabelledPoint> kept;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (labels[i] != Label::DontCare) kept.push_back({points[i], labels[i] == Label::Inside});
  }
  append_points(table, *space.halfspaces, kept, run);
}

Vec3 sample_in_box(const SampleSpace& space, double margin, Rng& rng) {
  const Box3& box = space.frame.box;
  const Vec3 grown = box.size() * margin + Vec3::Constant(margin * space.diagonal / 3);
  Vec3 local;
  for (int c = 0; c < 3; ++c) local[c] = rng.uniform(box.lo[c] - grown[c], box.hi[c] + grown[c]);
  return space.frame.to_space(local);
}

Vec3 sample_around_box(const SampleSpace& space, Rng& rng) {
  const Box3& box = space.frame.box;
  const Vec3 margin = box.size() * 0.05;
  Vec3 local;
  for (int c = 0; c < 3; ++c) local[c] = rng.uniform(box.lo[c] - margin[c], box.hi[c] + margin[c]);
  const int side = static_cast<int>(rng.below(3));
  const double reach = space.diagonal * std::pow(10, -3.3 + 2.8 * rng.uniform());
  local[side] = rng.coin() ? box.lo[side] - reach : box.hi[side] + reach;
  return space.frame.to_space(local);
}

void append_points(SampleTable& table, const std::vector<Halfspace>& halfspaces,
                   const std::vector<LabelledPoint>& points, const RunContext& run) {
  const std::size_t first = table.size();
  const std::size_t size = first + points.size();
  table.points.resize(size);
  table.is_inside.resize(size);
  table.signatures.resize(size * table.stride, 0);
  for (std::size_t i = 0; i < points.size(); ++i) {
    table.points[first + i] = points[i].position;
    table.is_inside[first + i] = points[i].is_inside ? 1 : 0;
  }
  fill_signatures(table, halfspaces, 0, first, run);
}

void append_halfspaces(SampleTable& table, const std::vector<Halfspace>& halfspaces,
                       const RunContext& run) {
  const std::size_t stride = words_for(halfspaces.size());
  if (stride > table.stride) {
    std::vector<Word> wider(table.size() * stride, 0);
    for (std::size_t i = 0; i < table.size(); ++i) {
      std::copy_n(table.signature(i), table.stride, wider.data() + i * stride);
    }
    table.signatures = std::move(wider);
    table.stride = stride;
  }
  fill_signatures(table, halfspaces, table.halfspaces, 0, run);
  table.halfspaces = halfspaces.size();
}

Result<SampleTable> build_sample_table(const SampleSpace& space, int volume_points,
                                       const std::vector<int>& halfspace_of_group,
                                       const RunContext& run) {
  SampleTable table;
  table.halfspaces = space.halfspaces->size();
  table.stride = words_for(table.halfspaces);
  const auto chunks_of = [](int n) {
    return (static_cast<std::size_t>(n) + kPointsPerChunk - 1) / kPointsPerChunk;
  };
  const auto uniform = [&space](std::size_t, Rng& rng, const auto& emit) {
    for (std::size_t i = 0; i < kPointsPerChunk; ++i) emit(sample_in_box(space, 0.03, rng));
  };
  const auto around = [&space](std::size_t, Rng& rng, const auto& emit) {
    for (std::size_t i = 0; i < kPointsPerChunk; ++i) emit(sample_around_box(space, rng));
  };
  run.report("sample", 0.1);
  append_proposed(table, space, chunks_of(volume_points), 1, run, uniform);
  append_proposed(table, space, chunks_of(volume_points * 3 / 4), 2, run, around);
  run.report("sample", 0.6);
  append_group_samples(space, halfspace_of_group, table, run);
  if (run.is_cancelled()) return RunContext::cancelled();
  return table;
}

}  // namespace hewn
