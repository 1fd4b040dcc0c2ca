#include "core/synth/tree_front.h"

#include <utility>

namespace hewn {

Result<std::vector<FrontMember>> find_front(const FrontStart& start, const GeneticOptions& options,
                                            const RunContext& run) {
  std::vector<Genome> genomes;
  for (const Formula& f : start.formulas) genomes.push_back(genome_of(f));
  Formula wanted = start.formulas.front();
  evaluate(wanted, start.cells);
  const auto evolved = evolve(genomes, start.cells, wanted.value, start.cells.all(), options, run);
  if (!evolved) return evolved.error();
  std::vector<FrontMember> front;
  for (const ParetoMember& m : evolved->front) {
    FrontMember member{to_tree(formula_of(m.genome), start.literals, start.cells), m.geometry,
                       m.size, m.proximity};
    member.size = tree_size(member.tree);
    if (m.geometry >= 1) {
      const auto compared = compare_trees(start.tree, member.tree, start.equivalence, run);
      if (!compared) return compared.error();
      if (!compared->is_same()) continue;
    }
    front.push_back(std::move(member));
  }
  return front;
}

}  // namespace hewn
