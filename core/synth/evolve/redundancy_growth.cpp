#include "core/synth/evolve/redundancy_growth.h"

#include <algorithm>
#include <utility>

#include "core/csg/literal_set.h"
#include "core/sample/equivalence.h"
#include "core/synth/evolve/genetic.h"

namespace hewn {
namespace {

/// By which a tree may grow at a time: the published inflated trees gain up to four an iteration.
constexpr int kMoreNodes = 4;

GeneticOptions growing(std::size_t nodes) {
  GeneticOptions options;
  options.population = 60;
  options.iterations = 20;
  options.proximity_weight = -1;
  options.size_weight = -10;
  options.largest = static_cast<double>(nodes + kMoreNodes) / static_cast<double>(nodes);
  return options;
}

Column value_of(const Genome& genome, const CellColumns& cells) {
  Formula formula = formula_of(genome);
  return evaluate(formula, cells);
}

}  // namespace

RedundancyGrowth::RedundancyGrowth(std::vector<Literal> literals, std::vector<int> column_of,
                                   CellColumns cells)
    : literals_(std::move(literals)), column_of_(std::move(column_of)), cells_(std::move(cells)) {
  for (int column = 0; column < cells_.literals(); ++column) {
    const auto first = std::find(column_of_.begin(), column_of_.end(), column);
    literal_of_.push_back(static_cast<int>(first - column_of_.begin()));
  }
}

Result<RedundancyGrowth> RedundancyGrowth::of(const Tree& tree, const RunContext& run) {
  LiteralSet set;
  std::vector<int> column_of = set.add(tree);
  ArrangementSampler sampler(set.literals(), scale_of(tree));
  if (auto done = sampler.sample({}, run); !done) return done.error();
  return RedundancyGrowth(set.literals(), std::move(column_of), CellColumns(sampler.arrangement()));
}

Tree RedundancyGrowth::tree_of(const Genome& genome) const {
  return to_tree(formula_of(genome), literals_, cells_);
}

Result<Genome> RedundancyGrowth::grow(const Genome& genome, int most_nodes,
                                      const RunContext& run) const {
  if (static_cast<int>(genome.size()) + kMoreNodes > most_nodes) return genome;
  Genome start = genome;
  for (Token& t : start) {
    if (t >= 0) t = static_cast<Token>(column_of_[static_cast<std::size_t>(t)]);
  }
  auto evolved =
      evolve({start}, cells_, value_of(start, cells_), cells_.all(), growing(start.size()), run);
  if (!evolved) return evolved.error();
  const auto compared = compare_trees(tree_of(start), tree_of(evolved->best), {}, run);
  if (!compared) return compared.error();
  if (!compared->is_same()) return genome;
  for (Token& t : evolved->best) {
    if (t >= 0) t = static_cast<Token>(literal_of_[static_cast<std::size_t>(t)]);
  }
  return std::move(evolved->best);
}

}  // namespace hewn
