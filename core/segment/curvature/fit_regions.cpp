#include "core/segment/curvature/fit_regions.h"

#include <algorithm>
#include <queue>
#include <utility>

#include "core/base/rng.h"

namespace hewn {
namespace {

constexpr std::uint64_t kSeedStream = 0x6375727661;
/// Rounds of extending over neighbours and refitting.
constexpr int kMaxExtensions = 4;
constexpr std::size_t kCancelStride = 4096;
/// Differences in curvature below this share of the seed's are noise of the estimate; the angle to
/// the seed's normal then decides, which makes the region grow around and not along a cylinder.
constexpr double kCurvatureNoise = 1e-2;
/// Triangles of another class than the seed's are taken only when they fit this much better.
constexpr double kForeignStrictness = 0.4;
/// A region whose vertices stray by this share of the diagonal is worth half its area.
constexpr double kRoughRms = 1e-5;

class Grower {
 public:
  Grower(const CurvatureStages& stages, const std::vector<bool>& is_candidate,
         const CurvatureOptions& options, const RunContext& run)
      : stages_(stages),
        run_(run),
        mesh_(stages.mesh),
        is_candidate_(is_candidate),
        limits_(fit_limits(stages.mesh, options)),
        first_size_(static_cast<std::size_t>(options.region_triangles)),
        stamp_(stages.mesh.triangles.size(), 0) {}

  /// Empty `triangles` when no primitive fits around the seed. `tried` gets the smallest region
  /// that was in vain.
  FittedRegion grow(int seed, std::vector<int>& tried) {
    const std::vector<int> order = grow_along_curvature(seed);
    const CurvatureClass kind = stages_.classes[seed];
    FittedRegion best;
    double best_score = 0;
    // A feature may end before the region is large enough: halves of it compete, by the area that
    // they explain and how exactly they do.
    for (std::size_t size = order.size(); size >= 1; size /= 2) {
      const std::span<const int> start(order.data(), size);
      const auto surface = fit_primitive(mesh_, start, kind, limits_);
      // Two halves of one strip's facet lie in a plane on every surface.
      const bool is_chance = surface && surface->kind == SurfaceKind::Plane &&
                             kind != CurvatureClass::Planar && size < order.size();
      if (!surface || is_chance) {
        if (best.triangles.empty()) tried.assign(start.begin(), start.end());
        continue;
      }
      FittedRegion region = extend(*surface, start, kind);
      const double rms = rms_of(mesh_, start, region.surface);
      const double inexactness = rms / (kRoughRms * limits_.diagonal);
      const double value = area(region.triangles) / (1 + inexactness * inexactness);
      if (value > best_score) {
        best_score = value;
        best = std::move(region);
      }
      if (is_exact(rms, limits_)) break;
    }
    return best;
  }

 private:
  /// The paper's equation 2.4: best neighbour first.
  std::vector<int> grow_along_curvature(int seed) {
    ++mark_;
    const double curvature = stages_.curvatures[seed].max;
    const double noise =
        std::max(kCurvatureNoise * std::abs(curvature), kCurvatureNoise / limits_.diagonal);
    using Entry = std::pair<double, int>;
    std::priority_queue<Entry, std::vector<Entry>, std::greater<>> frontier;
    frontier.push({0, seed});
    stamp_[seed] = mark_;
    std::vector<int> region;
    while (!frontier.empty() && region.size() < first_size_) {
      const int t = frontier.top().second;
      frontier.pop();
      region.push_back(t);
      for_each_neighbor(t, [&](int other) {
        if (stages_.classes[other] != stages_.classes[seed]) return;
        stamp_[other] = mark_;
        const double change = std::abs(stages_.curvatures[other].max - curvature);
        const double turn = mesh_.normals[seed].dot(mesh_.normals[other]);
        frontier.push({std::max(change, noise) * turn, other});
      });
    }
    return region;
  }

  double area(const std::vector<int>& triangles) const {
    double sum = 0;
    for (const int t : triangles) sum += mesh_.areas[t];
    return sum;
  }

  FittedRegion extend(const Surface& surface, std::span<const int> start, CurvatureClass kind) {
    FittedRegion region{surface, flood(surface, start, kind)};
    for (int round = 0; round < kMaxExtensions; ++round) {
      Surface better = region.surface;
      refit(mesh_, region.triangles, better);
      std::vector<int> triangles = flood(better, start, kind);
      if (triangles.size() < region.triangles.size()) break;
      const bool has_grown = triangles.size() > region.triangles.size();
      region = {better, std::move(triangles)};
      if (!has_grown) break;
    }
    std::sort(region.triangles.begin(), region.triangles.end());
    return region;
  }

  /// All triangles on the surface that are connected to the start by such triangles.
  std::vector<int> flood(const Surface& surface, std::span<const int> start, CurvatureClass kind) {
    ++mark_;
    const bool may_trim = is_exact(rms_of(mesh_, start, surface), limits_);
    const FitLimits limits = may_trim ? trimmed_limits(mesh_, start, surface, limits_) : limits_;
    const auto is_on = [&](int t) {
      const double allowed = stages_.classes[t] == kind ? 1 : kForeignStrictness;
      return misfit(mesh_, t, surface, limits) <= allowed;
    };
    std::vector<int> region;
    for (const int t : start) {
      stamp_[t] = mark_;
      if (is_on(t)) region.push_back(t);
    }
    for (std::size_t i = 0; i < region.size(); ++i) {
      if (i % kCancelStride == 0 && run_.is_cancelled()) break;
      for_each_neighbor(region[i], [&](int other) {
        stamp_[other] = mark_;
        if (is_on(other)) region.push_back(other);
      });
    }
    return region;
  }

  /// Unvisited candidates across unmarked edges.
  template <class Visit>
  void for_each_neighbor(int t, const Visit& visit) {
    for (int k = 0; k < 3; ++k) {
      const int other = stages_.topology.neighbors[t][k];
      if (other < 0 || stages_.boundaries.is_marked[t][k]) continue;
      if (stamp_[other] == mark_ || !is_candidate_[other]) continue;
      if (stages_.classes[other] != CurvatureClass::None) visit(other);
    }
  }

  const CurvatureStages& stages_;
  const RunContext& run_;
  const Mesh& mesh_;
  const std::vector<bool>& is_candidate_;
  FitLimits limits_;
  std::size_t first_size_;
  std::vector<int> stamp_;
  int mark_ = 0;
};

}  // namespace

Result<std::vector<FittedRegion>> grow_fitted_regions(const CurvatureStages& stages,
                                                      const std::vector<bool>& is_candidate,
                                                      const CurvatureOptions& options,
                                                      const RunContext& run) {
  std::vector<int> seeds;
  for (int t = 0; t < static_cast<int>(is_candidate.size()); ++t) {
    if (is_candidate[t] && stages.classes[t] != CurvatureClass::None) seeds.push_back(t);
  }
  Rng rng(run.seed, kSeedStream);
  rng.shuffle(seeds);
  Grower grower(stages, is_candidate, options, run);
  std::vector<bool> is_processed(is_candidate.size(), false);
  std::vector<FittedRegion> regions;
  std::vector<int> tried;
  for (std::size_t i = 0; i < seeds.size(); ++i) {
    if (is_processed[seeds[i]]) continue;
    if (run.is_cancelled()) return RunContext::cancelled();
    run.report("grow face groups", static_cast<double>(i) / static_cast<double>(seeds.size()));
    FittedRegion region = grower.grow(seeds[i], tried);
    is_processed[seeds[i]] = true;
    // What is too curved for its own few triangles need not be tried from each of them.
    for (const int t : region.triangles.empty() ? tried : region.triangles) is_processed[t] = true;
    if (!region.triangles.empty()) regions.push_back(std::move(region));
  }
  if (run.is_cancelled()) return RunContext::cancelled();
  return regions;
}

}  // namespace hewn
