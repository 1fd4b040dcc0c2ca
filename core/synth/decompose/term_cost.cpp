#include "core/synth/decompose/term_cost.h"

#include <algorithm>
#include <cmath>

namespace hewn {
namespace {

/// Directions this close to a right angle may share a box: its error over a whole part stays far
/// below every tolerance.
constexpr double kSquare = 1e-6;
constexpr double kParallel = 1e-9;

bool contains(const std::vector<TermLiteral>& literals, const TermLiteral& wanted) {
  return std::find(literals.begin(), literals.end(), wanted) != literals.end();
}

}  // namespace

Combinability::Combinability(const SurfaceSet& surfaces)
    : direction_count_(surfaces.directions.size()), prisms_(find_regular_prisms(surfaces)) {
  for (const Halfspace& h : surfaces.halfspaces) {
    kinds_.push_back(h.surface.kind);
    directions_.push_back(h.direction);
  }
  const auto& d = surfaces.directions;
  relations_.assign(direction_count_ * direction_count_, Relation::Oblique);
  for (std::size_t i = 0; i < d.size(); ++i) {
    for (std::size_t j = 0; j < d.size(); ++j) {
      Relation& r = relations_[i * direction_count_ + j];
      if (i == j) r = Relation::Parallel;
      if (i != j && d[i].cross(d[j]).norm() < kParallel) r = Relation::Parallel;
      if (i != j && std::abs(d[i].dot(d[j])) < kSquare) r = Relation::Square;
    }
  }
  for (const RegularPrism& prism : prisms_) {
    std::vector<char>& caps = prism_caps_.emplace_back();
    for (const Halfspace& h : surfaces.halfspaces) {
      const bool is_plane = h.surface.kind == SurfaceKind::Plane;
      caps.push_back(is_plane && h.surface.axis.cross(prism.axis).norm() < kParallel ? 1 : 0);
    }
  }
}

std::vector<PrimitivePlan> plan_primitives(const std::vector<TermLiteral>& literals,
                                           const Combinability& combinability) {
  std::vector<PrimitivePlan> plans;
  for (const TermLiteral& l : literals) {
    if (!combinability.is_plane(l.halfspace)) plans.push_back({l.halfspace, -1, l.inside, {}});
  }
  std::vector<TermLiteral> sides;  // of prisms
  for (std::size_t k = 0; k < combinability.prisms().size(); ++k) {
    const RegularPrism& prism = combinability.prisms()[k];
    const bool is_whole =
        std::all_of(prism.sides.begin(), prism.sides.end(), [&](const TermLiteral& side) {
          return contains(literals, side) && !contains(sides, side);
        });
    if (!is_whole) continue;
    plans.push_back({-1, static_cast<int>(k), true, {}});
    sides.insert(sides.end(), prism.sides.begin(), prism.sides.end());
  }
  const std::size_t uprights = plans.size();
  const auto capped_by = [&](const TermLiteral& l) {
    return std::find_if(
        plans.begin(), plans.begin() + static_cast<long>(uprights), [&](const PrimitivePlan& p) {
          return p.prism >= 0 ? combinability.caps_prism(l.halfspace, p.prism)
                              : p.inside && combinability.caps(l.halfspace, p.curved);
        });
  };
  const auto box_for = [&](const TermLiteral& l) {
    return std::find_if(
        plans.begin() + static_cast<long>(uprights), plans.end(), [&](const auto& p) {
          return std::all_of(p.planes.begin(), p.planes.end(), [&](const TermLiteral& side) {
            return combinability.share_box(side.halfspace, l.halfspace);
          });
        });
  };
  for (const TermLiteral& l : literals) {
    if (!combinability.is_plane(l.halfspace) || contains(sides, l)) continue;
    const auto upright = capped_by(l);
    if (upright != plans.begin() + static_cast<long>(uprights)) {
      upright->planes.push_back(l);
      continue;
    }
    const auto box = box_for(l);
    if (box != plans.end()) {
      box->planes.push_back(l);
    } else {
      plans.push_back({-1, -1, true, {l}});
    }
  }
  if (std::none_of(plans.begin(), plans.end(), [](const auto& p) { return p.is_positive(); })) {
    plans.insert(plans.begin(), PrimitivePlan{});
  }
  return plans;
}

int term_cost(const std::vector<TermLiteral>& literals, const Combinability& combinability) {
  return static_cast<int>(plan_primitives(literals, combinability).size());
}

}  // namespace hewn
