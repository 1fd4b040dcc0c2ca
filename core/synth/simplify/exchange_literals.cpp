#include "core/synth/simplify/exchange_literals.h"

#include <algorithm>
#include <utility>

#include "core/synth/simplify/sibling_care.h"

namespace hewn {
namespace {

constexpr int kMostRounds = 4;
constexpr double kGain = 1e-12;

class Exchange {
 public:
  Exchange(Formula formula, const CellColumns& cells, const Column& care, const RunContext& run)
      : best_(std::move(formula)), cells_(cells), care_(care), run_(run) {}

  Formula work() {
    proximity_ = formula_proximity(best_, cells_);
    for (int round = 0; round < kMostRounds && proximity_ < 1; ++round) {
      evaluate(best_, cells_);
      if (!visit(best_, care_)) break;
    }
    return std::move(best_);
  }

 private:
  /// Whether a leaf below `node`, whose value counts on `care`, was exchanged. One exchange changes
  /// what the leaves after it are asked for, so values are computed anew on the way back.
  bool visit(Formula& node, const Column& care) {
    if (run_.is_cancelled()) return false;
    if (node.kind == Formula::Kind::Leaf) return exchange(node, care);
    bool has_changed = false;
    SiblingCare siblings(node);
    for (std::size_t i = 0; i < node.children.size(); ++i) {
      if (!visit(node.children[i], siblings.of(i, care))) continue;
      has_changed = true;
      evaluate(node, cells_);
      siblings.renew();
    }
    return has_changed;
  }

  bool exchange(Formula& leaf, const Column& care) {
    const int before = leaf.literal;
    int chosen = before;
    const Column& own = cells_.column(before);
    for (int k = 0; k < cells_.literals(); ++k) {
      if (k == before || !agree(cells_.column(k), own, care)) continue;
      leaf.literal = k;
      const double proximity = formula_proximity(best_, cells_);
      if (proximity <= proximity_ + kGain) continue;
      proximity_ = proximity;
      chosen = k;
    }
    leaf.literal = chosen;
    if (chosen == before) return false;
    evaluate(leaf, cells_);
    return true;
  }

  static bool agree(const Column& a, const Column& b, const Column& care) {
    for (std::size_t i = 0; i < care.size(); ++i) {
      if (((a[i] ^ b[i]) & care[i]) != 0) return false;
    }
    return true;
  }

  Formula best_;
  const CellColumns& cells_;
  const Column& care_;
  const RunContext& run_;
  double proximity_ = 0;
};

}  // namespace

Formula exchange_literals(Formula formula, const CellColumns& cells, const Column& care,
                          const RunContext& run) {
  if (formula.is_constant()) return formula;
  return Exchange(std::move(formula), cells, care, run).work();
}

}  // namespace hewn
