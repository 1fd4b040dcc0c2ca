#include "core/segment/curved_growth.h"

#include <algorithm>
#include <atomic>
#include <deque>

#include "core/compute/parallel.h"
#include "core/segment/candidate_finder.h"

namespace hewn {
namespace {

/// A smooth component is free-form when it falls into this many surfaces and most of them meet its
/// facets only loosely: those of a design are exact however many they are.
constexpr int kManySurfaces = 60;
constexpr double kLoose = 0.3;
constexpr double kMostlyLoose = 0.8;  // of the surfaces
constexpr double kResampledSlack = 3;
constexpr double kExactLooseness = 0.1;
constexpr double kCovering = 0.95;  // of a component's free facets on one cylinder,
constexpr int kConfirmed = 2;       // for this many seeds
constexpr std::uint64_t kStream = 12345;
constexpr int kLeastFacets = 4;
/// Seeds tried at a time by each worker once a first surface is known: enough to share them out
/// evenly, few enough not to try many that the next best surface makes needless.
constexpr std::size_t kSeedsAhead = 4;
/// Facets of a curved surface turn by no more than some 25 degrees, a few of them by 40.
constexpr double kSagittaShare = 0.024;  // of the radius
constexpr double kSagittaOutlier = 0.062;
constexpr double kGrowthSlack = 1.5;
/// Circles of nine sides and more are meant to be round where that makes no visible difference. It
/// does sooner for cylinders: a regular prism is exact and as short.
constexpr double kCoarseTurn = 41;  // degrees
constexpr double kCoarseGrowthTurn = 50;
constexpr double kCoarseSagitta = 0.125;       // of the radius: a sphere bends both ways
constexpr double kCoarseCylinderDepth = 2e-3;  // of the diagonal
constexpr double kCoarseDepth = 6e-3;
/// What is joined to more has small facets, too: it is of a free form.
constexpr std::size_t kMostCoarse = 1000;
/// In a resampled mesh whatever is wide has many triangles.
constexpr std::size_t kLeastTriangles = 4;

/// What was found in one component.
struct Growth {
  std::vector<GrownGroup> groups;
  bool is_free_form = false;  ///< given up
};

/// Grows one component after the other, the seeds of each side by side on all finders. The outcome
/// is that of trying them in turn.
class ComponentGrower {
 public:
  /// `group_of_facet` is what the finders read.
  ComponentGrower(const GrowthInput& input, std::span<CandidateFinder> finders,
                  std::vector<int>& group_of_facet)
      : input_(input), finders_(finders), group_of_(group_of_facet) {}

  /// Marks the facets of the groups as taken.
  Result<Growth> grow(const std::vector<int>& component, const RunContext& run) {
    component_ = &component;
    tried_after_.assign(component.size(), -1);
    for (CandidateFinder& finder : finders_) {
      finder.begin_component(input_.component_of[component.front()]);
    }
    Growth growth;
    Rng rng(kStream, static_cast<std::uint64_t>(component.front()));
    int failures = 0;
    int loose = 0;
    while (failures < input_.options.max_failures) {
      const int found = static_cast<int>(growth.groups.size());
      growth.is_free_form = found >= kManySurfaces && loose > kMostlyLoose * found;
      if (growth.is_free_form) break;
      std::vector<int> seeds;
      const int free = untried_seeds(found, seeds);
      if (free < kLeastFacets || seeds.empty()) break;
      const bool is_exhaustive = static_cast<int>(seeds.size()) <= 2 * input_.options.seeds;
      if (!is_exhaustive) pick(rng, seeds);
      Candidate best = best_of(seeds, free, found, run);
      if (run.is_cancelled()) return RunContext::cancelled();
      if (best.score <= 0) {
        if (is_exhaustive) break;
        ++failures;
        continue;
      }
      failures = 0;
      finders_.front().simplify(best.surface, best.facets);
      loose += best.looseness > (input_.tolerance.is_resampled ? kResampledSlack : 1) * kLoose;
      for (const int f : best.facets) group_of_[f] = found;
      growth.groups.push_back({best.surface, std::move(best.facets)});
    }
    return growth;
  }

 private:
  int facet_at(int position) const { return (*component_)[position]; }

  /// Positions in the component of free facets that were not tried since the last surface was
  /// found: trying them again would end the same. Returns the number of free facets, tried or not.
  int untried_seeds(int found, std::vector<int>& seeds) const {
    int free = 0;
    for (int i = 0; i < static_cast<int>(component_->size()); ++i) {
      if (group_of_[facet_at(i)] >= 0) continue;
      ++free;
      if (tried_after_[i] != found) seeds.push_back(i);
    }
    return free;
  }

  void pick(Rng& rng, std::vector<int>& seeds) const {
    for (int i = 0; i < input_.options.seeds; ++i) {
      const std::size_t j = i + rng.below(seeds.size() - i);
      std::swap(seeds[i], seeds[j]);
    }
    seeds.resize(input_.options.seeds);
  }

  static bool covers(const Candidate& c, int free) {
    return c.score > 0 && c.surface.kind == SurfaceKind::Cylinder &&
           static_cast<double>(c.facets.size()) > kCovering * free;
  }

  /// A seed that the best surface explains exactly would only find it again.
  static bool is_explained(const Candidate& best, int seed) {
    return best.score > 0 && best.looseness < kExactLooseness &&
           std::binary_search(best.facets.begin(), best.facets.end(), seed);
  }

  Candidate best_of(const std::vector<int>& seeds, int free, int found, const RunContext& run) {
    std::vector<std::optional<Candidate>> outcomes(seeds.size());
    Candidate best;
    int confirmed = 0;
    for (std::size_t i = 0; i < seeds.size() && !run.is_cancelled(); ++i) {
      if (!is_explained(best, facet_at(seeds[i]))) {
        if (!outcomes[i]) try_ahead(seeds, i, best, outcomes, run);
        if (outcomes[i]->score > best.score) best = std::move(*outcomes[i]);
      }
      tried_after_[seeds[i]] = found;
      // All other seeds would find the one surface that there is.
      if (covers(best, free) && ++confirmed >= kConfirmed) break;
    }
    return best;
  }

  /// Fills the outcome of seed `from`, and of some after it, as many as keep all workers busy.
  void try_ahead(const std::vector<int>& seeds, std::size_t from, const Candidate& best,
                 std::vector<std::optional<Candidate>>& outcomes, const RunContext& run) {
    const std::size_t most =
        finders_.size() * (finders_.size() > 1 && best.score > 0 ? kSeedsAhead : 1);
    std::vector<std::size_t> batch;
    for (std::size_t i = from; i < seeds.size() && batch.size() < most; ++i) {
      const int seed = facet_at(seeds[i]);
      if (outcomes[i] || is_explained(best, seed)) continue;
      outcomes[i].emplace();
      if (finders_.front().is_seed(seed)) batch.push_back(i);
    }
    for_each_with_worker(
        run.threads, finders_.size(), batch.size(), [&](std::size_t worker, std::size_t i) {
          if (run.is_cancelled()) return;
          *outcomes[batch[i]] = finders_[worker].best_from(facet_at(seeds[batch[i]]));
        });
  }

  const GrowthInput& input_;
  std::span<CandidateFinder> finders_;
  std::vector<int>& group_of_;
  const std::vector<int>* component_ = nullptr;
  std::vector<int> tried_after_;  ///< seeds: the number of surfaces found before the last try
};

/// A component grown before its turn, as if none before it took any facet.
struct Forecast {
  std::optional<Growth> growth;
  std::vector<int> foreign;  ///< facets of others that it took for free
};

/// One worker's own view of which facets are free.
struct Forecaster {
  Forecaster(const GrowthInput& input, std::vector<int> group_of_facet)
      : group_of(std::move(group_of_facet)), finder(input, group_of) {}
  Forecaster(const Forecaster&) = delete;
  Forecaster& operator=(const Forecaster&) = delete;

  std::vector<int> group_of;
  CandidateFinder finder;
};

/// Grows the components in their order; where there are several workers, small ones before their
/// turn and side by side. Growth may cross into other components, so a forecast only counts if
/// none of the facets that it rests on was taken in between: the outcome is that of one worker.
class Growing {
 public:
  Growing(const GrowthInput& input, FacetGroups& found, const RunContext& run)
      : input_(input), found_(found), run_(run) {}

  Result<int> grow_all(const std::vector<std::vector<int>>& components) {
    const auto workers = static_cast<std::size_t>(worker_count(run_.threads));
    if (workers > 1) forecast(components, workers);
    std::vector<CandidateFinder> finders;
    for (std::size_t w = 0; w < workers; ++w) finders.emplace_back(input_, found_.group_of);
    ComponentGrower grower(input_, finders, found_.group_of);
    int given_up = 0;
    for (std::size_t c = 0; c < components.size(); ++c) {
      if (components[c].size() < kLeastFacets) continue;
      Growth growth;
      if (c < forecasts_.size() && still_holds(forecasts_[c], components[c])) {
        growth = std::move(*forecasts_[c].growth);
      } else {
        Result<Growth> grown = grower.grow(components[c], run_);
        if (!grown) return grown.error();
        growth = std::move(*grown);
        report(components[c].size());
      }
      if (run_.is_cancelled()) return RunContext::cancelled();
      given_up += growth.is_free_form;
      for (GrownGroup& group : growth.groups) found_.add(std::move(group));
    }
    return given_up;
  }

 private:
  /// Components that keep one worker busy for longer than the others take together wait for their
  /// turn: then all workers share them.
  void forecast(const std::vector<std::vector<int>>& components, std::size_t workers) {
    std::size_t total = 0;
    std::vector<std::size_t> chosen;
    for (std::size_t c = 0; c < components.size(); ++c) {
      if (components[c].size() < kLeastFacets) continue;
      total += components[c].size();
      chosen.push_back(c);
    }
    std::erase_if(chosen,
                  [&](std::size_t c) { return 2 * workers * components[c].size() > total; });
    if (chosen.size() < 2) return;
    std::stable_sort(chosen.begin(), chosen.end(), [&](std::size_t a, std::size_t b) {
      return components[a].size() > components[b].size();
    });
    std::deque<Forecaster> forecasters;
    for (std::size_t w = 0; w < workers; ++w) forecasters.emplace_back(input_, found_.group_of);
    forecasts_.resize(components.size());
    at_start_ = found_.group_of;
    for_each_with_worker(run_.threads, workers, chosen.size(),
                         [&](std::size_t worker, std::size_t i) {
                           if (run_.is_cancelled()) return;
                           const std::vector<int>& component = components[chosen[i]];
                           forecasts_[chosen[i]] = forecast(component, forecasters[worker]);
                           report(component.size());
                         });
  }

  Forecast forecast(const std::vector<int>& component, Forecaster& forecaster) const {
    Forecast result;
    ComponentGrower grower(input_, {&forecaster.finder, 1}, forecaster.group_of);
    Result<Growth> growth = grower.grow(component, run_);
    if (!growth) return result;
    for (const GrownGroup& group : growth->groups) {
      for (const int f : group.facets) forecaster.group_of[f] = -1;
    }
    result.growth = std::move(*growth);
    const std::span<const int> foreign = forecaster.finder.foreign_facets();
    result.foreign.assign(foreign.begin(), foreign.end());
    return result;
  }

  bool still_holds(const Forecast& forecast, const std::vector<int>& component) const {
    const auto is_unchanged = [&](int f) { return found_.group_of[f] < 0 || at_start_[f] >= 0; };
    return forecast.growth && std::all_of(component.begin(), component.end(), is_unchanged) &&
           std::all_of(forecast.foreign.begin(), forecast.foreign.end(), is_unchanged);
  }

  void report(std::size_t facets) {
    done_ += facets;
    run_.report("segment", static_cast<double>(done_) / input_.graph.size());
  }

  const GrowthInput& input_;
  FacetGroups& found_;
  const RunContext& run_;
  std::vector<Forecast> forecasts_;
  std::vector<int> at_start_;
  std::atomic<std::size_t> done_{0};
};

FacetSteps fine_steps(const SegmentOptions& options) {
  const double smooth = options.smooth_angle_deg * kPi / 180;
  return {.smooth_rad = smooth,
          .growth_rad = kGrowthSlack * smooth,
          .sagitta_share = kSagittaShare,
          .sagitta_outlier = kSagittaOutlier};
}

FacetSteps coarse_steps(double diagonal) {
  return {.smooth_rad = kCoarseTurn * kPi / 180,
          .growth_rad = kCoarseGrowthTurn * kPi / 180,
          .sagitta_share = kCoarseSagitta,
          .sagitta_outlier = kCoarseSagitta,
          .max_cylinder_depth = kCoarseCylinderDepth * diagonal,
          .max_depth = kCoarseDepth * diagonal,
          .only_exact = true,
          .least_slack_rad = kCoarseTurn / 2 * kPi / 180,
          .least_sides = 3};
}

/// Facets of the kind joined by rims that turn by less than `smooth_rad`.
template <class IsOfKind>
std::vector<std::vector<int>> components(const FacetGraph& graph, double smooth_rad,
                                         const IsOfKind& is_of_kind) {
  std::vector<std::vector<int>> all;
  std::vector<bool> is_seen(graph.facets.size(), false);
  const auto is_open = [&](int f) {
    return !is_seen[f] && graph.facets[f].area > 0 && is_of_kind(f);
  };
  for (int start = 0; start < graph.size(); ++start) {
    if (!is_open(start)) continue;
    std::vector<int> component = {start};
    is_seen[start] = true;
    for (std::size_t i = 0; i < component.size(); ++i) {
      for (const FacetNeighbor& n : graph.neighbors(component[i])) {
        if (n.angle_rad >= smooth_rad || !is_open(n.facet)) continue;
        is_seen[n.facet] = true;
        component.push_back(n.facet);
      }
    }
    all.push_back(std::move(component));
  }
  return all;
}

}  // namespace

Result<int> grow_curved_groups(const Mesh& mesh, const FacetGraph& graph,
                               const SurfaceTolerance& tolerance, const SegmentOptions& options,
                               FacetGroups& found, const RunContext& run) {
  const FacetSteps fine = fine_steps(options);
  const auto grow = [&](const FacetSteps& steps, const std::vector<std::vector<int>>& within) {
    std::vector<int> component_of(graph.facets.size(), -1);
    for (std::size_t c = 0; c < within.size(); ++c) {
      for (const int f : within[c]) component_of[f] = static_cast<int>(c);
    }
    const GrowthInput input{mesh, graph, tolerance, options, steps, component_of};
    return Growing(input, found, run).grow_all(within);
  };
  const Result<int> given_up =
      grow(fine, components(graph, fine.smooth_rad, [](int) { return true; }));
  if (!given_up) return given_up;
  const FacetSteps coarse = coarse_steps(tolerance.diagonal);
  const std::size_t least = tolerance.is_resampled ? kLeastTriangles : 1;
  const auto may_be_side = [&](int f) {
    return found.group_of[f] < 0 && graph.facets[f].triangles.size() >= least;
  };
  auto rest = components(graph, coarse.smooth_rad, may_be_side);
  std::erase_if(rest, [](const auto& component) { return component.size() > kMostCoarse; });
  const Result<int> added = grow(coarse, rest);
  return added ? given_up : added;
}

}  // namespace hewn
