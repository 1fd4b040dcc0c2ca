#include "core/synth/decompose/relax.h"

#include <algorithm>

namespace hewn {
namespace {

/// Parallel planes that make the term larger, the farthest first.
std::vector<int> farther_planes(const SurfaceSet& surfaces, const TermLiteral& literal) {
  const Halfspace& own = surfaces.halfspaces[literal.halfspace];
  std::vector<std::pair<double, int>> farther;
  for (std::size_t k = 0; k < surfaces.halfspaces.size(); ++k) {
    const Halfspace& h = surfaces.halfspaces[k];
    if (h.surface.kind != SurfaceKind::Plane || h.direction != own.direction) continue;
    // Planes of one direction index share the axis up to sign.
    const double sense = h.surface.axis.dot(own.surface.axis) < 0 ? -1 : 1;
    if (sense < 0) continue;
    const double gain = (h.surface.offset - own.surface.offset) * (literal.inside ? 1 : -1);
    if (gain > 0) farther.emplace_back(-gain, static_cast<int>(k));
  }
  std::sort(farther.begin(), farther.end());
  std::vector<int> out;
  out.reserve(farther.size());
  for (const auto& [gain, k] : farther) out.push_back(k);
  return out;
}

class Relaxation {
 public:
  Relaxation(const SearchSpace& space, const SurfaceSet& surfaces, DecisionList& list)
      : space_(space), surfaces_(surfaces), list_(list) {}

  void run() {
    for (std::size_t item = 0; item < list_.items.size(); ++item) {
      for (std::size_t k = 0; k < list_.items[item]->literals.size();) {
        if (!relax_literal(item, k)) ++k;
      }
    }
  }

 private:
  /// True when the literal was dropped.
  bool relax_literal(std::size_t item, std::size_t k) {
    const TermLiteral literal = list_.items[item]->literals[k];
    if (!space_.combinability->is_plane(literal.halfspace)) return false;
    Term candidate = *list_.items[item];
    if (candidate.literals.size() > 1) {
      candidate.literals.erase(candidate.literals.begin() + static_cast<long>(k));
      if (accept(item, candidate)) return true;
    }
    for (const int plane : farther_planes(surfaces_, literal)) {
      candidate = *list_.items[item];
      candidate.literals[k].halfspace = plane;
      if (accept(item, candidate)) break;
    }
    return false;
  }

  bool accept(std::size_t item, const Term& candidate) {
    return replace_item(space_, list_, list_.items[item], candidate);
  }

  const SearchSpace& space_;
  const SurfaceSet& surfaces_;
  DecisionList& list_;
};

}  // namespace

void relax_list(const SearchSpace& space, const SurfaceSet& surfaces, DecisionList& list) {
  if (is_right(space, list.items, list.base)) Relaxation(space, surfaces, list).run();
}

}  // namespace hewn
