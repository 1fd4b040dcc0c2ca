#pragma once
/// How creatures are chosen and changed: the operators of Fayolle and Pasko 2016, on postfix
/// strings.
#include "core/synth/evolve/genome.h"

namespace hewn {

struct BreedingRates {
  double mutation = 0;   ///< share of the children that are changed at random
  double crossover = 0;  ///< share of the children with two parents
  int tournament = 1;    ///< creatures of which the best becomes a parent, > 0
};

/// Makes genomes over literals 0 .. `literals` - 1; none grows beyond `most_nodes`.
class Breeder {
 public:
  Breeder(int literals, int most_nodes, const BreedingRates& rates)
      : literals_(literals), most_nodes_(most_nodes), rates_(rates) {}

  /// A child of creatures, which have a `genome` and are sorted by falling score.
  template <class Creature>
  Genome child_of(const std::vector<Creature>& sorted, Rng& rng) const {
    Genome child = sorted[tournament(sorted.size(), rng)].genome;
    if (rng.uniform() < rates_.crossover) {
      cross(child, sorted[tournament(sorted.size(), rng)].genome, rng);
    }
    if (rng.uniform() < rates_.mutation) mutate(child, rng);
    return child;
  }

 private:
  /// The winner's index.
  std::size_t tournament(std::size_t creatures, Rng& rng) const;

  /// Puts a random subtree of the other parent in the place of one of `genome`'s.
  void cross(Genome& genome, const Genome& other, Rng& rng) const;

  /// A new subtree, a subtree in the place of its parent, another literal, or another operation.
  void mutate(Genome& genome, Rng& rng) const;

  void replace(Genome& genome, std::size_t last, const Genome& part) const;

  int literals_;
  int most_nodes_;
  BreedingRates rates_;
};

}  // namespace hewn
