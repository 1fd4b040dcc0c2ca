#include "core/synth/simplify/grow_overlaps.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "core/base/rng.h"
#include "core/csg/bounds_table.h"

namespace hewn {
namespace {

constexpr double kParallel = 1e-9;
constexpr int kSlabPoints = 150;
constexpr int kKeptPoints = 12;  ///< of each slab tried, for the measure of proximity
constexpr int kPasses = 2;

/// A flat end of a literal: where along one of its own axes it lies.
struct End {
  int axis = 2;
  bool is_upper = false;
};

bool has_flat_ends(const Literal& s) {
  return !s.stretch &&
         (s.kind == SolidKind::Box || (s.kind == SolidKind::Cylinder && s.radius == s.top_radius));
}

double length_along(const Literal& s, int axis) {
  return s.kind == SolidKind::Box ? s.size[axis] : s.height;
}

/// The literal with one end moved outward to `place`, in its rotated coordinates.
Literal moved(Literal s, const End& end, double place) {
  const double lo = s.origin[end.axis];
  const double length = end.is_upper ? place - lo : lo + length_along(s, end.axis) - place;
  if (!end.is_upper) s.origin[end.axis] = place;
  if (s.kind == SolidKind::Box) {
    s.size[end.axis] = length;
  } else {
    s.height = length;
  }
  return s;
}

/// A random point of the part that moving an end adds.
Vec3 point_of_slab(const Literal& s, const End& end, double place, Rng& rng) {
  const double from = s.origin[end.axis] + (end.is_upper ? length_along(s, end.axis) : 0);
  Vec3 rotated;
  if (s.kind == SolidKind::Box) {
    for (int c = 0; c < 3; ++c) rotated[c] = s.origin[c] + rng.uniform() * s.size[c];
  } else {
    const double angle = rng.uniform(0, 2 * kPi);
    // Many near the flank, where neighbours are.
    const double radius = s.radius * std::sqrt(rng.uniform());
    rotated = s.origin + radius * Vec3(std::cos(angle), std::sin(angle), 0);
  }
  rotated[end.axis] = from + rng.uniform() * (place - from);
  return s.rotation * rotated;
}

class Growth {
 public:
  Growth(const Formula& formula, const std::vector<Literal>& literals,
         const std::vector<Vec3>& points, const TreeInside& solid, const RunContext& run)
      : solid_(solid), run_(run), rng_(run.seed, 0x960) {
    formula_ = formula;
    literals_ = literals;
    points_ = points;
  }

  GrownTree grow() {
    std::vector<Leaf> leaves;
    collect(formula_, formula_.is_negated, leaves);
    for (const Leaf& leaf : leaves) propose(leaf);
    measure_columns(leaves);
    out_.proximity = formula_proximity(formula_, *cells_);
    for (int pass = 0; pass < kPasses && out_.proximity < 1; ++pass) {
      for (const Proposal& p : proposals_) {
        if (run_.is_cancelled() || out_.proximity >= 1) break;
        try_proposal(p);
      }
    }
    out_.tree = to_tree(formula_, literals_, *cells_);
    return std::move(out_);
  }

 private:
  struct Leaf {
    Formula* formula;
    bool is_taken_away;
  };
  /// Another literal for a leaf.
  struct Proposal {
    Formula* leaf;
    int instead_of;
    int literal;
  };

  void collect(Formula& f, bool is_taken_away, std::vector<Leaf>& leaves) {
    if (f.kind == Formula::Kind::Leaf) leaves.push_back({&f, is_taken_away});
    for (Formula& child : f.children) {
      collect(child, is_taken_away != child.is_negated, leaves);
    }
  }

  void propose(const Leaf& leaf) {
    const Literal s = literals_[static_cast<std::size_t>(leaf.formula->literal)];
    if (!has_flat_ends(s)) return;
    for (int axis = s.kind == SolidKind::Box ? 0 : 2; axis < 3; ++axis) {
      for (const bool is_upper : {false, true}) {
        const End end{axis, is_upper};
        for (const double place : places_beyond(s, end)) {
          if (!is_free(s, end, place, leaf.is_taken_away)) break;
          proposals_.push_back(
              {leaf.formula, leaf.formula->literal, static_cast<int>(literals_.size())});
          literals_.push_back(moved(s, end, place));
        }
      }
    }
  }

  /// The next two planes of literals beyond an end, the nearer first.
  std::vector<double> places_beyond(const Literal& s, const End& end) const {
    const Vec3 axis = s.rotation.col(end.axis);
    const double at = s.origin[end.axis] + (end.is_upper ? length_along(s, end.axis) : 0);
    const double least = 1e-6 * s.bounds().diagonal();
    std::vector<double> places;
    const auto offer = [&](double place) {
      if ((end.is_upper ? place - at : at - place) > least) places.push_back(place);
    };
    for (const Literal& other : literals_) {
      if (!has_flat_ends(other)) continue;
      for (int k = other.kind == SolidKind::Box ? 0 : 2; k < 3; ++k) {
        const Vec3 normal = other.rotation.col(k);
        if (normal.cross(axis).norm() > kParallel) continue;
        const double sign = normal.dot(axis) < 0 ? -1 : 1;
        offer(sign * other.origin[k]);
        offer(sign * (other.origin[k] + length_along(other, k)));
      }
    }
    std::sort(places.begin(), places.end());
    if (!end.is_upper) std::reverse(places.begin(), places.end());
    places.erase(std::unique(places.begin(), places.end(),
                             [&](double a, double b) { return std::abs(a - b) < least; }),
                 places.end());
    if (places.size() > 2) places.resize(2);
    return places;
  }

  /// Whether the slab that the end would pass lies in the solid, or outside of it for tools.
  bool is_free(const Literal& s, const End& end, double place, bool is_taken_away) {
    std::vector<Vec3> kept;
    for (int i = 0; i < kSlabPoints; ++i) {
      const Vec3 p = point_of_slab(s, end, place, rng_);
      if (solid_.contains(p) == is_taken_away) return false;
      if (i < kKeptPoints) kept.push_back(p);
    }
    points_.insert(points_.end(), kept.begin(), kept.end());
    return true;
  }

  /// Of the literals that are or may become leaves; the others' columns stay empty.
  void measure_columns(const std::vector<Leaf>& leaves) {
    const std::size_t n = points_.size();
    std::vector<int> used;
    for (const Leaf& leaf : leaves) used.push_back(leaf.formula->literal);
    for (const Proposal& p : proposals_) used.push_back(p.literal);
    std::vector<LiteralBounds> bounds;
    for (const int k : used) bounds.emplace_back(literals_[static_cast<std::size_t>(k)]);
    const BoundsTable near(bounds, std::vector<double>(bounds.size(), 0));
    std::vector<Column> columns(literals_.size(), Column(padded_words(n), 0));
    for (std::size_t i = 0; i < n && !run_.is_cancelled(); ++i) {
      near.visit_near(points_[i], [&](std::size_t u) {
        const auto k = static_cast<std::size_t>(used[u]);
        if (literal_contains(literals_[k], bounds[u], points_[i])) set_bit(columns[k].data(), i);
        return true;
      });
    }
    cells_.emplace(n, std::move(columns));
  }

  void try_proposal(const Proposal& p) {
    if (p.leaf->literal != p.instead_of) return;
    p.leaf->literal = p.literal;
    const double proximity = formula_proximity(formula_, *cells_);
    if (proximity > out_.proximity) {
      out_.proximity = proximity;
      out_.is_changed = true;
    } else {
      p.leaf->literal = p.instead_of;
    }
  }

  const TreeInside& solid_;
  const RunContext& run_;
  Rng rng_;
  Formula formula_;
  std::vector<Literal> literals_;
  std::vector<Vec3> points_;  ///< the cells over which proximity is measured
  GrownTree out_;
  std::vector<Proposal> proposals_;
  std::optional<CellColumns> cells_;
};

}  // namespace

GrownTree grow_overlaps(const Formula& formula, const std::vector<Literal>& literals,
                        const std::vector<Vec3>& points, const TreeInside& solid,
                        const RunContext& run) {
  return Growth(formula, literals, points, solid, run).grow();
}

}  // namespace hewn
