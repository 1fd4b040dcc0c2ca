#pragma once
/// The non-dominated trees over geometry, size and proximity.
#include <vector>

#include "core/synth/evolve/genome.h"

namespace hewn {

struct ParetoMember {
  Genome genome;
  double geometry = 0;  ///< share of the rows that are right, the mean of inside and outside
  int size = 0;
  double proximity = 0;
};

/// Better or equal in all, better in one: geometry and proximity up, size down.
bool dominates(const ParetoMember& a, const ParetoMember& b);

/// Keeps the members that no other one dominates; of equals the first.
class ParetoArchive {
 public:
  /// Whether `member` was kept. Cost: O(members).
  bool offer(const ParetoMember& member);
  /// By falling geometry, then by size, then by falling proximity.
  std::vector<ParetoMember> front() const;
  std::size_t size() const { return members_.size(); }

 private:
  std::vector<ParetoMember> members_;
};

}  // namespace hewn
