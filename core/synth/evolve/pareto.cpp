#include "core/synth/evolve/pareto.h"

#include <algorithm>

namespace hewn {

bool dominates(const ParetoMember& a, const ParetoMember& b) {
  if (a.geometry < b.geometry || a.size > b.size || a.proximity < b.proximity) return false;
  return a.geometry > b.geometry || a.size < b.size || a.proximity > b.proximity;
}

bool ParetoArchive::offer(const ParetoMember& member) {
  for (const ParetoMember& m : members_) {
    const bool is_equal =
        m.geometry == member.geometry && m.size == member.size && m.proximity == member.proximity;
    if (is_equal || dominates(m, member)) return false;
  }
  std::erase_if(members_, [&](const ParetoMember& m) { return dominates(member, m); });
  members_.push_back(member);
  return true;
}

std::vector<ParetoMember> ParetoArchive::front() const {
  std::vector<ParetoMember> sorted = members_;
  std::sort(sorted.begin(), sorted.end(), [](const ParetoMember& a, const ParetoMember& b) {
    if (a.geometry != b.geometry) return a.geometry > b.geometry;
    if (a.size != b.size) return a.size < b.size;
    if (a.proximity != b.proximity) return a.proximity > b.proximity;
    return a.genome < b.genome;
  });
  return sorted;
}

}  // namespace hewn
