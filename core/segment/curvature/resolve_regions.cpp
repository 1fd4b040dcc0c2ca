#include "core/segment/curvature/resolve_regions.h"

#include <algorithm>
#include <numeric>
#include <utility>

#include "core/segment/measure_group.h"

namespace hewn {
namespace {

constexpr double kRelaxedMisfit = 2;
/// Neighbouring regions are one group when the smaller fits the larger's surface this well.
constexpr double kSameSurfaceMisfit = 0.5;

class Resolver {
 public:
  Resolver(const CurvatureStages& stages, const std::vector<FittedRegion>& regions,
           const CurvatureOptions& options)
      : stages_(stages),
        mesh_(stages.mesh),
        limits_(fit_limits(stages.mesh, options)),
        region_of_(stages.mesh.triangles.size(), -1) {
    for (const FittedRegion& region : regions) surfaces_.push_back(region.surface);
    is_fitted_.assign(surfaces_.size(), true);
  }

  /// Overlap goes to the best fit; the earlier region wins a tie.
  void claim(const std::vector<FittedRegion>& regions) {
    std::vector<double> best(region_of_.size(), kInfinity);
    for (int r = 0; r < static_cast<int>(regions.size()); ++r) {
      for (const int t : regions[r].triangles) {
        const double score = misfit(mesh_, t, surfaces_[r], limits_);
        if (score >= best[t]) continue;
        best[t] = score;
        region_of_[t] = r;
      }
    }
  }

  /// A loose fit over a plane and the fillet beside it keeps the plane when another region takes
  /// the fillet: each connected part that is left of a curved region is a plane if it is flat.
  void flatten_remains() {
    std::vector<int> part_of(region_of_.size(), -1);
    for (int t = 0; t < static_cast<int>(region_of_.size()); ++t) {
      const int region = region_of_[t];
      if (region < 0 || part_of[t] >= 0 || surfaces_[region].kind == SurfaceKind::Plane) continue;
      const auto is_same = [&](int, int, int other) { return region_of_[other] == region; };
      const std::vector<int> part = component(t, is_same, part_of, t);
      if (!is_flat(mesh_, part, limits_)) continue;
      for (const int member : part) region_of_[member] = static_cast<int>(surfaces_.size());
      surfaces_.push_back(mean_plane(mesh_, part));
      is_fitted_.push_back(true);
    }
  }

  /// Unclaimed triangles join the neighbouring region that they fit best, ring by ring.
  void absorb() {
    std::vector<int> open = triangles_of(-1);
    bool has_changed = true;
    while (has_changed && !open.empty()) {
      std::vector<std::pair<int, int>> joins;
      for (const int t : open) {
        const int region = best_neighbor(t);
        if (region >= 0) joins.emplace_back(t, region);
      }
      for (const auto& [t, region] : joins) region_of_[t] = region;
      has_changed = !joins.empty();
      std::erase_if(open, [&](int t) { return region_of_[t] >= 0; });
    }
  }

  /// Runs of like curvature among what is left become regions of their own.
  void collect_leftovers() {
    for (const int first : triangles_of(-1)) {
      if (region_of_[first] >= 0 || stages_.classes[first] == CurvatureClass::None) continue;
      const int region = static_cast<int>(surfaces_.size());
      const std::vector<int> run = flood(first, region, [&](int t, int k, int other) {
        return !stages_.boundaries.is_marked[t][k] && region_of_[other] < 0 &&
               stages_.classes[other] == stages_.classes[first];
      });
      auto surface = fit_primitive(mesh_, run, stages_.classes[first], limits_);
      if (!surface) surface = fit_primitive(mesh_, run, CurvatureClass::Planar, limits_);
      surfaces_.push_back(surface ? *surface : mean_plane(mesh_, run));
      is_fitted_.push_back(surface.has_value());
    }
  }

  /// Joins neighbouring regions that lie on one surface; exact surfaces first, larger ones first.
  void merge_equal() {
    std::vector<std::vector<int>> members = members_of_regions();
    std::vector<bool> exact;
    for (std::size_t r = 0; r < members.size(); ++r) {
      exact.push_back(is_fitted_[r] && is_exact(rms_of(mesh_, members[r], surfaces_[r]), limits_));
    }
    std::vector<int> order(members.size());
    std::iota(order.begin(), order.end(), 0);
    std::stable_sort(order.begin(), order.end(),
                     [&](int a, int b) { return members[a].size() > members[b].size(); });
    std::stable_partition(order.begin(), order.end(), [&](int r) { return exact[r]; });
    for (const int r : order) {
      if (is_fitted_[r] && !members[r].empty()) merge_into(r, members, exact);
    }
  }

  /// Triangles without area take a neighbour's region, so that groups have no cracks.
  void fill_slivers() {
    for (int round = 0; round < 8; ++round) {
      for (const int t : triangles_of(-1)) {
        for (const int other : stages_.topology.neighbors[t]) {
          if (region_of_[t] < 0 && other >= 0) region_of_[t] = region_of_[other];
        }
      }
    }
  }

  Segmentation finish() {
    Segmentation out;
    out.group_of_triangle.assign(region_of_.size(), -1);
    std::vector<int> region = region_of_;
    for (int t = 0; t < static_cast<int>(region.size()); ++t) {
      if (region[t] < 0 || out.group_of_triangle[t] >= 0) continue;
      FaceGroup group;
      group.surface = surfaces_[region[t]];
      group.is_fitted = is_fitted_[region[t]];
      group.triangles = component(
          t, [&](int, int, int other) { return region[other] == region[t]; }, out.group_of_triangle,
          static_cast<int>(out.groups.size()));
      std::sort(group.triangles.begin(), group.triangles.end());
      if (group.is_fitted) refit(mesh_, group.triangles, group.surface);
      measure_group(mesh_, group);
      orient(group);
      out.groups.push_back(std::move(group));
    }
    return out;
  }

 private:
  /// A plane's normal points out of the solid.
  void orient(FaceGroup& group) const {
    if (group.surface.kind != SurfaceKind::Plane || group.side > 0) return;
    group.surface.axis = -group.surface.axis;
    group.surface.offset = -group.surface.offset;
    group.side = 1;
  }

  std::vector<int> triangles_of(int region) const {
    std::vector<int> found;
    for (int t = 0; t < static_cast<int>(region_of_.size()); ++t) {
      if (region_of_[t] == region) found.push_back(t);
    }
    return found;
  }

  std::vector<std::vector<int>> members_of_regions() const {
    std::vector<std::vector<int>> members(surfaces_.size());
    for (int t = 0; t < static_cast<int>(region_of_.size()); ++t) {
      if (region_of_[t] >= 0) members[region_of_[t]].push_back(t);
    }
    return members;
  }

  /// The region across an unmarked side, -1 for none.
  int neighbor_region(int t, int k) const {
    const int other = stages_.topology.neighbors[t][k];
    return other < 0 || stages_.boundaries.is_marked[t][k] ? -1 : region_of_[other];
  }

  int best_neighbor(int t) const {
    int best = -1;
    double best_score = kRelaxedMisfit;
    for (int k = 0; k < 3; ++k) {
      const int region = neighbor_region(t, k);
      if (region < 0) continue;
      const double score = misfit(mesh_, t, surfaces_[region], limits_);
      const bool is_better = score < best_score || (score == best_score && region < best);
      if (!is_better) continue;
      best = region;
      best_score = score;
    }
    return best;
  }

  void merge_into(int target, std::vector<std::vector<int>>& members,
                  const std::vector<bool>& exact) {
    const Surface& surface = surfaces_[target];
    const FitLimits trimmed = trimmed_limits(mesh_, members[target], surface, limits_);
    // What lies exactly on a surface of its own is not a trimmed part of this one.
    const auto lies_on = [&](int other) {
      const bool may_be_trimmed = exact[target] && !exact[other];
      const FitLimits& limits = may_be_trimmed ? trimmed : limits_;
      const double allowed = may_be_trimmed ? 1 : kSameSurfaceMisfit;
      return std::all_of(members[other].begin(), members[other].end(),
                         [&](int t) { return misfit(mesh_, t, surface, limits) <= allowed; });
    };
    // Members are appended while the loop runs, so that merging goes on over what was merged.
    for (std::size_t i = 0; i < members[target].size(); ++i) {
      for (int k = 0; k < 3; ++k) {
        const int other = neighbor_region(members[target][i], k);
        if (other < 0 || other == target || !lies_on(other)) continue;
        for (const int moved : members[other]) region_of_[moved] = target;
        members[target].insert(members[target].end(), members[other].begin(), members[other].end());
        members[other].clear();
      }
    }
  }

  template <class Accept>
  std::vector<int> flood(int first, int region, const Accept& accept) {
    return component(first, accept, region_of_, region);
  }

  /// Labels and returns the triangles reached from `first` over accepted sides (t, k, other).
  template <class Accept>
  std::vector<int> component(int first, const Accept& accept, std::vector<int>& labels,
                             int label) const {
    std::vector<int> found{first};
    labels[first] = label;
    for (std::size_t i = 0; i < found.size(); ++i) {
      for (int k = 0; k < 3; ++k) {
        const int other = stages_.topology.neighbors[found[i]][k];
        if (other < 0 || labels[other] == label || !accept(found[i], k, other)) continue;
        labels[other] = label;
        found.push_back(other);
      }
    }
    return found;
  }

  const CurvatureStages& stages_;
  const Mesh& mesh_;
  FitLimits limits_;
  std::vector<int> region_of_;
  std::vector<Surface> surfaces_;
  std::vector<bool> is_fitted_;
};

}  // namespace

Result<Segmentation> resolve_regions(const CurvatureStages& stages,
                                     const std::vector<FittedRegion>& regions,
                                     const CurvatureOptions& options, const RunContext& run) {
  Resolver resolver(stages, regions, options);
  resolver.claim(regions);
  resolver.flatten_remains();
  if (run.is_cancelled()) return RunContext::cancelled();
  resolver.absorb();
  resolver.collect_leftovers();
  if (run.is_cancelled()) return RunContext::cancelled();
  resolver.merge_equal();
  resolver.fill_slivers();
  if (run.is_cancelled()) return RunContext::cancelled();
  return resolver.finish();
}

}  // namespace hewn
