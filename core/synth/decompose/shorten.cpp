#include "core/synth/decompose/shorten.h"

#include <algorithm>
#include <cmath>

#include "core/base/rng.h"
#include "core/csg/flat_end.h"
#include "core/csg/tree_inside.h"

namespace hewn {
namespace {

constexpr int kPoints = 64;  ///< of each literal in what is given up

/// Marks the literals that add to the solid.
void find_united(const Tree& tree, int index, bool is_united, std::vector<char>& united) {
  const Node& node = tree.nodes[static_cast<std::size_t>(index)];
  if (node.op == Op::Literal) united[static_cast<std::size_t>(node.literal)] = is_united ? 1 : 0;
  for (std::size_t i = 0; i < node.children.size(); ++i) {
    const bool turns = node.op == Op::Complement || (node.op == Op::Difference && i > 0);
    find_united(tree, node.children[i], is_united != turns, united);
  }
}

class Shortener {
 public:
  explicit Shortener(Tree& tree) : tree_(tree), before_(tree), united_(tree.literals.size(), 0) {
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

 private:
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
      if ((shared.lo.array() >= shared.hi.array()).any()) continue;
      for (int i = 0; i < kPoints; ++i) {
        Vec3 local;
        for (int c = 0; c < 3; ++c) local[c] = rng.uniform(shared.lo[c], shared.hi[c]);
        const Vec3 p = literal.to_world(local);
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
  Tree before_;  ///< the last end's move
  std::vector<char> united_;
};

}  // namespace

void shorten_tools(Tree& tree, const std::vector<Shortening>& wanted) {
  if (tree.is_empty()) return;
  Shortener shortener(tree);
  for (const Shortening& s : wanted) shortener.shorten(s);
}

}  // namespace hewn
