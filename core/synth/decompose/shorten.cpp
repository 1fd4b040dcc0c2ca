#include "core/synth/decompose/shorten.h"

#include <algorithm>
#include <cmath>

#include "core/base/rng.h"
#include "core/compute/parallel.h"
#include "core/csg/flat_end.h"
#include "core/csg/tree_inside.h"
#include "core/csg/tree_ray.h"
#include "core/mesh/sampling.h"

namespace hewn {
namespace {

constexpr int kPoints = 64;   ///< of each literal in what is given up
constexpr int kLines = 3072;  ///< through the whole tree, in the end
constexpr int kLinesPerChunk = 128;
/// Stretches of a line shorter than this share of the tree are rounding.
constexpr double kRounding = 1e-6;

/// Marks the literals that add to the solid.
void find_united(const Tree& tree, int index, bool is_united, std::vector<char>& united) {
  const Node& node = tree.nodes[static_cast<std::size_t>(index)];
  if (node.op == Op::Literal) united[static_cast<std::size_t>(node.literal)] = is_united ? 1 : 0;
  for (std::size_t i = 0; i < node.children.size(); ++i) {
    const bool turns = node.op == Op::Complement || (node.op == Op::Difference && i > 0);
    find_united(tree, node.children[i], is_united != turns, united);
  }
}

using Stretches = std::vector<TreeInterval>;

/// Calls `visit(t)` in the middle of what `now` has beyond `then`, unless it is as short as
/// rounding.
template <class Visit>
void visit_gained(const Stretches& now, const Stretches& then, double rounding,
                  const Visit& visit) {
  std::size_t first = 0;
  for (const TreeInterval& s : now) {
    double from = s.enter.t;
    while (first < then.size() && then[first].leave.t <= from) ++first;
    for (std::size_t k = first; from < s.leave.t; ++k) {
      const bool is_last = k == then.size();
      const double to = is_last ? s.leave.t : std::min(then[k].enter.t, s.leave.t);
      if (to - from > rounding) visit((from + to) / 2);
      from = is_last ? s.leave.t : std::max(from, then[k].leave.t);
    }
  }
}

bool is_empty(const LocalBox& box) { return (box.lo.array() >= box.hi.array()).any(); }

class Shortener {
 public:
  explicit Shortener(Tree& tree)
      : tree_(tree), longest_(tree), before_(tree), united_(tree.literals.size(), 0) {
    find_united(tree, tree.root, true, united_);
  }

  void shorten(const Shortening& wanted) {
    const auto k = static_cast<std::size_t>(wanted.literal);
    const Literal longest = tree_.literals[k];
    for (const FlatEnd end : flat_ends(longest)) {
      const double amount = plane_offset(wanted.shorter, end) - plane_offset(longest, end);
      if (!(amount < 0)) continue;
      const Literal shorter = with_moved_end(before_.literals[k], end, amount);
      if (!is_valid_flat(shorter)) continue;
      tree_.literals[k] = shorter;
      const bool is_free = !is_missed(before_.literals[k], end, amount);
      (is_free ? before_ : tree_).literals[k] = (is_free ? tree_ : before_).literals[k];
    }
  }

  /// What is left of a large literal may be a sheet or a chip that no point was in, but lines meet.
  void restore_where_lines_meet_more(int threads) {
    if (!std::isfinite(tree_.bounds().diagonal())) return;
    const TreeRays rays(tree_);
    const TreeRays rays_before(longest_);
    const Box3 box = tree_.bounds();
    std::vector<std::vector<Vec3>> missed(kLines / kLinesPerChunk);
    for_each_index(threads, missed.size(), [&](std::size_t chunk) {
      TreeRayScratch scratch;
      TreeRayScratch scratch_before;
      Rng rng(0x11E5, chunk);
      for (int i = 0; i < kLinesPerChunk; ++i) {
        const Line line = draw_line(box.center(), box.diagonal() / 2, rng);
        visit_gained(rays.cast(line.origin, line.direction, scratch),
                     rays_before.cast(line.origin, line.direction, scratch_before),
                     kRounding * box.diagonal(), [&](double t) {
                       missed[chunk].emplace_back(line.origin + t * line.direction);
                     });
      }
    });
    for (const auto& points : missed) {
      for (const Vec3& p : points) restore_at(p);
    }
  }

 private:
  /// Makes those literals long again that gave up the point.
  void restore_at(const Vec3& p) {
    for (std::size_t k = 0; k < tree_.literals.size(); ++k) {
      const Literal& longest = longest_.literals[k];
      const bool gave_up =
          longest.signed_distance(p) < 0 && tree_.literals[k].signed_distance(p) >= 0;
      if (gave_up) tree_.literals[k] = longest;
    }
  }

  /// Whether some of what the literal gave up has become part of the solid.
  bool is_missed(const Literal& literal, FlatEnd end, double amount) const {
    const LocalBox given_up = beyond_end(literal, end, amount, 0);
    const TreeInside inside(tree_);
    const TreeInside inside_before(before_);
    Rng rng(0x5A07);
    for (std::size_t k = 0; k < tree_.literals.size(); ++k) {
      if (!united_[k]) continue;
      LocalBox shared = local_bounds_of(tree_.literals[k], literal);
      shared.lo = shared.lo.cwiseMax(given_up.lo);
      shared.hi = shared.hi.cwiseMin(given_up.hi);
      if (is_empty(shared)) continue;
      for (int i = 0; i < kPoints; ++i) {
        const Vec3 p = literal.to_world(sample_box({shared.lo, shared.hi}, rng));
        if (literal.signed_distance(p) >= 0) continue;
        if (inside.contains(p) && !inside_before.contains(p)) return true;
      }
    }
    return false;
  }

  /// The bounds of `other` in the local coordinates of `literal`.
  static LocalBox local_bounds_of(const Literal& other, const Literal& literal) {
    const Box3 bounds = other.bounds();
    LocalBox box{Vec3::Constant(kInfinity), Vec3::Constant(-kInfinity)};
    for (int k = 0; k < 8; ++k) {
      const Vec3 corner((k & 1) != 0 ? bounds.hi.x() : bounds.lo.x(),
                        (k & 2) != 0 ? bounds.hi.y() : bounds.lo.y(),
                        (k & 4) != 0 ? bounds.hi.z() : bounds.lo.z());
      const Vec3 local = literal.to_local(corner);
      box.lo = box.lo.cwiseMin(local);
      box.hi = box.hi.cwiseMax(local);
    }
    return box;
  }

  Tree& tree_;
  const Tree longest_;
  Tree before_;  ///< the last end's move
  std::vector<char> united_;
};

}  // namespace

void shorten_tools(Tree& tree, const std::vector<Shortening>& wanted, int threads) {
  if (tree.is_empty()) return;
  Shortener shortener(tree);
  for (const Shortening& s : wanted) shortener.shorten(s);
  if (!wanted.empty()) shortener.restore_where_lines_meet_more(threads);
}

}  // namespace hewn
