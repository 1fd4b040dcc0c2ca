#include "core/synth/evolve/breeding.h"

#include <algorithm>

namespace hewn {

/// Puts `part` in the place of the subtree that ends at `last`, when there is room.
void Breeder::replace(Genome& genome, std::size_t last, const Genome& part) const {
  const std::size_t first = subtree_begin(genome, last);
  const std::size_t size = genome.size() - (last - first + 1) + part.size();
  if (static_cast<int>(size) > most_nodes_) return;
  const auto at = genome.begin() + static_cast<std::ptrdiff_t>(first);
  const auto rest = genome.erase(at, genome.begin() + static_cast<std::ptrdiff_t>(last) + 1);
  genome.insert(rest, part.begin(), part.end());
}

void Breeder::cross(Genome& genome, const Genome& other, Rng& rng) const {
  const std::size_t last = rng.below(other.size());
  const std::size_t first = subtree_begin(other, last);
  const Genome part(other.begin() + static_cast<std::ptrdiff_t>(first),
                    other.begin() + static_cast<std::ptrdiff_t>(last) + 1);
  const std::size_t place = rng.below(genome.size());
  replace(genome, place, part);
}

void Breeder::mutate(Genome& genome, Rng& rng) const {
  const std::size_t place = rng.below(genome.size());
  switch (rng.below(4)) {
    case 0:
      replace(genome, place, random_genome(literals_, 7, rng));
      return;
    case 1: {
      if (genome[place] >= 0) return;
      const std::size_t first = subtree_begin(genome, place - 1);
      replace(genome, place,
              Genome(genome.begin() + static_cast<std::ptrdiff_t>(first),
                     genome.begin() + static_cast<std::ptrdiff_t>(place)));
      return;
    }
    case 2:
      if (genome[place] < 0) return;
      genome[place] = static_cast<Token>(rng.below(static_cast<std::size_t>(literals_)));
      return;
    default: {
      if (genome[place] >= 0 || genome[place] == kComplementToken) return;
      constexpr Token kOps[] = {kUnionToken, kIntersectionToken, kDifferenceToken};
      genome[place] = kOps[rng.below(3)];
    }
  }
}

std::size_t Breeder::tournament(std::size_t creatures, Rng& rng) const {
  std::size_t best = rng.below(creatures);
  for (int i = 1; i < rates_.tournament; ++i) {
    const std::size_t other = rng.below(creatures);
    best = std::min(best, other);
  }
  return best;
}

}  // namespace hewn
