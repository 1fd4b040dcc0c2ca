#include "core/synth/evolve/genetic.h"

#include <algorithm>
#include <utility>

#include "core/synth/evolve/breeding.h"

namespace hewn {
namespace {

struct Creature {
  Genome genome;
  Measures measures;
  double geometry = 0;
  double score = 0;
  bool is_right() const { return geometry >= 1; }
};

class Evolution {
 public:
  Evolution(const std::vector<Genome>& starts, const CellColumns& cells, const Column& wanted,
            const Column& care, const GeneticOptions& options, const RunContext& run)
      : starts_(starts),
        options_(options),
        run_(run),
        table_(cells, wanted, care, run),
        rng_(run.seed, 2020) {}

  Result<GeneticResult> work() {
    if (auto done = begin(); !done) return done.error();
    double best_score = 0;
    int idle = 0;
    for (int i = 0; i < options_.iterations && idle < options_.most_idle; ++i, ++idle) {
      if (run_.is_cancelled()) return RunContext::cancelled();
      if (run_.should_stop()) break;
      if (i % 16 == 0) run_.report("evolve", static_cast<double>(i) / options_.iterations);
      rank();
      if (i == 0 || population_[0].score > best_score + 1e-12) {
        best_score = population_[0].score;
        idle = 0;
      }
      if (auto done = breed(); !done) return done.error();
      result_.iterations = i + 1;
    }
    result_.best = best_;
    result_.front = archive_.front();
    return std::move(result_);
  }

 private:
  Result<void> begin() {
    std::size_t largest = 0;
    for (const Genome& start : starts_) largest = std::max(largest, start.size());
    const int most_nodes =
        std::max(3, static_cast<int>(options_.largest * static_cast<double>(largest)));
    rules_ = {table_.literals(), most_nodes, options_.mutation, options_.crossover,
              options_.tournament};
    for (int i = 0; i < options_.population; ++i) {
      Creature c;
      const auto copy = static_cast<std::size_t>(i / 2) % starts_.size();
      c.genome = i % 2 == 0 ? starts_[copy]
                            : random_genome(table_.literals(), static_cast<int>(largest), rng_);
      population_.push_back(std::move(c));
    }
    return measure(population_);
  }

  /// In one batch, then judged one after the other.
  Result<void> measure(std::span<Creature> creatures) {
    std::vector<const Genome*> genomes;
    for (const Creature& c : creatures) genomes.push_back(&c.genome);
    const auto measures = table_.measure(genomes, run_);
    if (!measures) return measures.error();
    result_.evaluations += static_cast<long>(creatures.size());
    for (std::size_t i = 0; i < creatures.size(); ++i) {
      creatures[i].measures = (*measures)[i];
      judge(creatures[i]);
    }
    return {};
  }

  void judge(Creature& c) {
    const auto share = [](int right, int all) {
      return all > 0 ? static_cast<double>(right) / all : 1.0;
    };
    c.geometry = (share(c.measures.inside_right, table_.inside_rows()) +
                  share(c.measures.outside_right, table_.outside_rows())) /
                 2;
    const double proximity = static_cast<double>(c.measures.proximity) / c.measures.size;
    archive_.offer({c.genome, c.geometry, c.measures.size, proximity});
    if (!c.is_right()) return;
    if (!best_.empty() && !is_better_than_best(c)) return;
    best_ = c.genome;
    best_proximity_ = c.measures.proximity;
  }

  /// Of two right ones, after the signs of the weights.
  bool is_better_than_best(const Creature& c) const {
    if (c.genome.size() != best_.size()) {
      return (c.genome.size() < best_.size()) == (options_.size_weight >= 0);
    }
    return options_.proximity_weight >= 0 ? c.measures.proximity > best_proximity_
                                          : c.measures.proximity < best_proximity_;
  }

  /// Scores are relative to the sizes in the population.
  void rank() {
    int least = population_[0].measures.size;
    int most = least;
    for (const Creature& c : population_) {
      least = std::min(least, c.measures.size);
      most = std::max(most, c.measures.size);
    }
    for (Creature& c : population_) {
      const double proximity = static_cast<double>(c.measures.proximity) / c.measures.size;
      const double smallness =
          most > least ? static_cast<double>(most - c.measures.size) / (most - least) : 1.0;
      // Both shares count in the paper: twice the mean.
      c.score = options_.geometry_weight * 2 * c.geometry + options_.proximity_weight * proximity +
                options_.size_weight * smallness;
    }
    std::stable_sort(population_.begin(), population_.end(),
                     [](const Creature& a, const Creature& b) { return a.score > b.score; });
  }

  Result<void> breed() {
    std::vector<Creature> next(
        population_.begin(),
        population_.begin() + std::min<std::ptrdiff_t>(
                                  options_.elite, static_cast<std::ptrdiff_t>(population_.size())));
    const std::size_t kept = next.size();
    while (next.size() < population_.size()) {
      Creature child;
      child.genome = child_of(population_, rules_, rng_);
      next.push_back(std::move(child));
    }
    population_ = std::move(next);
    return measure(std::span(population_).subspan(kept));
  }

  const std::vector<Genome>& starts_;
  const GeneticOptions& options_;
  const RunContext& run_;
  FitnessTable table_;
  Rng rng_;
  BreedingRules rules_;
  std::vector<Creature> population_;
  Genome best_;
  int best_proximity_ = 0;
  ParetoArchive archive_;
  GeneticResult result_;
};

}  // namespace

Result<GeneticResult> evolve(const std::vector<Genome>& starts, const CellColumns& cells,
                             const Column& wanted, const Column& care,
                             const GeneticOptions& options, const RunContext& run) {
  if (starts.empty() || options.population < 2 || options.tournament < 1 ||
      options.iterations < 0 || !(options.largest >= 1)) {
    return Error{ErrorCode::InvalidArgument,
                 "a genetic search needs a tree, two creatures and a tournament of one"};
  }
  return Evolution(starts, cells, wanted, care, options, run).work();
}

}  // namespace hewn
