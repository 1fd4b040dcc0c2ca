#include "core/synth/evolve/surface_evolution.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "core/compute/generations.h"

namespace hewn {
namespace {

constexpr std::uint64_t kEvolveStream = 0x610000;
constexpr int kMostNodes = 255;
static_assert(kMostNodes <= static_cast<int>(Generations::kMostTokens));

/// Every combination of one or two primitives.
std::vector<Genome> all_combinations(int primitives) {
  if (primitives < 2) return {{0}};
  return {{0},
          {1},
          {0, 1, kUnionToken},
          {0, 1, kIntersectionToken},
          {0, 1, kDifferenceToken},
          {1, 0, kDifferenceToken}};
}

class SurfaceEvolution {
 public:
  SurfaceEvolution(SurfaceFitness& fitness, const EvolveOptions& options, const RunContext& run)
      : fitness_(fitness), options_(options), run_(run) {
    const auto n = static_cast<double>(std::max<std::size_t>(2, fitness.samples()));
    worth_ = {fitness.perfect_total(), options.size_penalty * std::log(n) / (2 * n)};
    const int largest = largest_first();
    rules_ = {fitness.primitives(), std::min(2 * largest, kMostNodes), options.mutation,
              options.crossover, options.tournament};
  }

  Result<Evolved> find() {
    Rng rng(run_.seed, kEvolveStream);
    std::vector<Genome> first;
    if (fitness_.primitives() <= 2) {
      first = all_combinations(fitness_.primitives());
      most_generations_ = 0;
    } else {
      for (int i = 0; i < options_.population; ++i) {
        first.push_back(random_genome(fitness_.primitives(), largest_first(), rng));
      }
      most_generations_ = options_.iterations;
    }
    seed_ = rng.next();
    // A device that fails has its part done again: the next one begins with the same trees.
    const auto job = [&](Device& device) { return evolve(device, first); };
    if (auto done = fitness_.compute().run(seconds(), run_, job); !done) return done.error();
    return std::move(result_);
  }

 private:
  int largest_first() const { return std::clamp(2 * fitness_.primitives() - 1, 3, kMostNodes); }

  /// Of one core, should no tree be found early.
  double seconds() const {
    const double steps = rules_.most_tokens / 4.0;
    const double generations = 1 + std::min(most_generations_, options_.most_idle);
    return fitness_.scores().seconds_for(generations * options_.population * steps);
  }

  Result<void> evolve(Device& device, std::span<const Genome> first) {
    Generations trees(device, fitness_.scores(), rules_, worth_);
    if (auto done = trees.begin(first, run_); !done) return done;
    result_.evaluations = static_cast<long>(trees.size());
    double best = -kInfinity;
    int idle = 0;
    for (int i = 0; i < most_generations_ && idle < options_.most_idle; ++i, ++idle) {
      if (run_.is_cancelled()) return RunContext::cancelled();
      if (run_.should_stop()) break;
      run_.report("evolve", static_cast<double>(i) / most_generations_);
      std::vector<std::int32_t> elite = best_of(trees, std::max<std::size_t>(1, elite_size(trees)));
      const auto leader = static_cast<std::size_t>(elite[0]);
      elite.resize(elite_size(trees));
      if (trees.score(leader) > best + 1e-12) {
        best = trees.score(leader);
        idle = 0;
      }
      if (trees.fit(leader) >= options_.enough) break;
      const std::uint64_t seed = Rng(seed_, static_cast<std::uint64_t>(i)).next();
      if (auto done = trees.breed(elite, seed, run_); !done) return done;
      result_.evaluations += static_cast<long>(trees.size() - elite.size());
    }
    auto found = trees.tree(static_cast<std::size_t>(best_of(trees, 1)[0]));
    if (!found) return found.error();
    result_.best = std::move(*found);
    return {};
  }

  std::size_t elite_size(const Generations& trees) const {
    return std::min(static_cast<std::size_t>(options_.elite), trees.size());
  }

  /// The places of the best trees, the best first.
  static std::vector<std::int32_t> best_of(const Generations& trees, std::size_t count) {
    std::vector<std::int32_t> order(trees.size());
    std::iota(order.begin(), order.end(), 0);
    const auto end = order.begin() + static_cast<std::ptrdiff_t>(count);
    std::partial_sort(order.begin(), end, order.end(), [&](std::int32_t a, std::int32_t b) {
      return is_better(trees.score(static_cast<std::size_t>(a)), a,
                       trees.score(static_cast<std::size_t>(b)), b);
    });
    order.resize(count);
    return order;
  }

  SurfaceFitness& fitness_;
  const EvolveOptions& options_;
  const RunContext& run_;
  TreeWorth worth_;
  BreedingRules rules_;
  int most_generations_ = 0;
  std::uint64_t seed_ = 0;
  Evolved result_;
};

}  // namespace

Result<Evolved> evolve_on_surface(SurfaceFitness& fitness, const EvolveOptions& options,
                                  const RunContext& run) {
  return SurfaceEvolution(fitness, options, run).find();
}

}  // namespace hewn
