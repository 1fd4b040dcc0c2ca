#pragma once
/// What a tree's solid holds while only some of its literals are known.
#include <vector>

#include "core/csg/tree.h"

namespace hewn {

/// Whether a point lies inside, as far as that is known (Kleene's logic).
enum class Known : char { No, Yes, Open };

inline Known inverse(Known k) {
  if (k == Known::Open) return k;
  return k == Known::Yes ? Known::No : Known::Yes;
}

inline Known known(bool is_inside) { return is_inside ? Known::Yes : Known::No; }

/// Answers whether a tree's solid holds a point, from what is known of the literals.
class PartialAnswer {
 public:
  explicit PartialAnswer(const Tree& tree)
      : tree_(tree),
        literals_(tree.literals.size(), Known::Open),
        settled_(tree.nodes.size(), Known::Open) {}

  void set(int literal, Known k) { literals_[static_cast<std::size_t>(literal)] = k; }
  Known of(int literal) const { return literals_[static_cast<std::size_t>(literal)]; }
  Known answer() const { return answer(tree_.root); }

  /// Remembers the nodes whose answers the open literals do not change, until `forget` is given
  /// the number that is returned. Known literals must stay as they are until then.
  std::size_t settle() {
    const std::size_t before = trail_.size();
    settle(tree_.root);
    return before;
  }
  void forget(std::size_t before) {
    for (; trail_.size() > before; trail_.pop_back()) at(trail_.back()) = Known::Open;
  }

 private:
  Known& at(int node) { return settled_[static_cast<std::size_t>(node)]; }

  Known settle(int node) {
    if (at(node) != Known::Open) return at(node);
    const Known k = combine(node, [this](int child) { return settle(child); });
    if (k != Known::Open) {
      at(node) = k;
      trail_.push_back(node);
    }
    return k;
  }

  Known answer(int node) const {
    const Known k = settled_[static_cast<std::size_t>(node)];
    return k != Known::Open ? k : combine(node, [this](int child) { return answer(child); });
  }

  template <class Below>
  Known combine(int node, const Below& below) const {
    const Node& n = tree_.nodes[static_cast<std::size_t>(node)];
    if (n.op == Op::Literal) return literals_[static_cast<std::size_t>(n.literal)];
    if (n.children.empty()) return n.op == Op::Complement ? Known::Yes : Known::No;
    if (n.op == Op::Complement) return inverse(below(n.children.front()));
    // A union holds when one operand does; the others, when one operand does not, do not.
    const Known deciding = n.op == Op::Union ? Known::Yes : Known::No;
    Known out = inverse(deciding);
    for (const int child : n.children) {
      const bool is_taken_away = n.op == Op::Difference && child != n.children.front();
      const Known k = is_taken_away ? inverse(below(child)) : below(child);
      if (k == deciding) return deciding;
      if (k == Known::Open) out = Known::Open;
    }
    return out;
  }

  const Tree& tree_;
  std::vector<Known> literals_;
  std::vector<Known> settled_;  ///< by node
  std::vector<int> trail_;      ///< nodes that were settled, in order
};

}  // namespace hewn
