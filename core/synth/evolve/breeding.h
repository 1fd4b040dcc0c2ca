#pragma once
/// The operators of core/compute/kernels/breeding.h for creatures of the host.
#include "core/compute/kernels/breeding.h"
#include "core/synth/evolve/genome.h"

namespace hewn {

/// Creatures, which have a `genome`, sorted by falling score.
template <class Creature>
class SortedParents {
 public:
  explicit SortedParents(const std::vector<Creature>& sorted) : sorted_(sorted) {}

  std::size_t size() const { return sorted_.size(); }
  bool is_better(std::int32_t a, std::int32_t b) const { return a < b; }
  const Token* tokens(std::int32_t i) const { return genome(i).data(); }
  std::int32_t token_count(std::int32_t i) const {
    return static_cast<std::int32_t>(genome(i).size());
  }

 private:
  const Genome& genome(std::int32_t i) const { return sorted_[static_cast<std::size_t>(i)].genome; }
  const std::vector<Creature>& sorted_;
};

/// Requires: no parent longer than `rules.most_tokens`.
template <class Creature>
Genome child_of(const std::vector<Creature>& sorted, const BreedingRules& rules, Rng& rng) {
  Genome child(static_cast<std::size_t>(rules.most_tokens));
  TokenRow row{child.data(), 0};
  breed(rules, SortedParents(sorted), rng, row);
  child.resize(static_cast<std::size_t>(row.size));
  return child;
}

}  // namespace hewn
