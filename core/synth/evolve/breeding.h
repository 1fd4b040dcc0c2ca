#pragma once
/// How creatures are chosen and changed: the operators of Fayolle and Pasko 2016, on postfix
/// strings.
#include "core/synth/evolve/genome.h"

namespace hewn {

/// Changes genomes over literals 0 .. `literals` - 1; none grows beyond `most_nodes`.
class Breeder {
 public:
  Breeder(int literals, int most_nodes) : literals_(literals), most_nodes_(most_nodes) {}

  /// Puts a random subtree of the other parent in the place of one of `genome`'s.
  void cross(Genome& genome, const Genome& other, Rng& rng) const;

  /// A new subtree, a subtree in the place of its parent, another literal, or another operation.
  void mutate(Genome& genome, Rng& rng) const;

 private:
  void replace(Genome& genome, std::size_t last, const Genome& part) const;

  int literals_;
  int most_nodes_;
};

/// The winner of a tournament among creatures sorted by falling score. Requires: `rounds` > 0.
std::size_t tournament(std::size_t creatures, int rounds, Rng& rng);

}  // namespace hewn
