#include "core/synth/simplify/redundancy.h"

#include <algorithm>
#include <numeric>
#include <utility>

#include "core/synth/simplify/sibling_care.h"

namespace hewn {
namespace {

using Kind = Formula::Kind;

bool is_subset(const Column& care, const Column& value) {
  for (std::size_t i = 0; i < care.size(); ++i) {
    if ((care[i] & ~value[i]) != 0) return false;
  }
  return true;
}

class RedundancyRemover {
 public:
  RedundancyRemover(const CellColumns& cells, const RunContext& run, RedundancyCounts& counts)
      : cells_(cells), run_(run), counts_(counts) {}

  Formula run(Formula f, const Column& care) {
    f = normalised(std::move(f));
    bool has_changed = true;
    while (has_changed && !run_.is_cancelled()) {
      ++counts_.passes;
      evaluate(f, cells_);
      has_changed = visit(f, care);
      f = normalised(std::move(f));
    }
    evaluate(f, cells_);
    return f;
  }

 private:
  /// Simplifies `f` where `care` asks for it; its value may then change elsewhere.
  bool visit(Formula& f, const Column& care) {
    if (f.is_constant() || run_.is_cancelled()) return false;
    if (!intersects(care, f.value)) return decide(f, false);
    if (is_subset(care, f.value)) return decide(f, true);
    if (f.kind == Kind::Leaf) return false;
    if (replace(f, care)) return true;
    bool has_changed = drop_operands(f, care);
    SiblingCare siblings(f);
    for (std::size_t i = 0; i < f.children.size(); ++i) {
      if (!visit(f.children[i], siblings.of(i, care))) continue;
      has_changed = true;
      f.children[i] = normalised(std::move(f.children[i]));
      evaluate(f.children[i], cells_);
      siblings.renew();
    }
    return has_changed;
  }

  bool decide(Formula& f, bool is_everything) {
    ++counts_.decided;
    f = Formula::constant(is_everything);
    evaluate(f, cells_);
    return true;
  }

  /// The subtree's own literals come first in the order of columns that is tried.
  bool replace(Formula& f, const Column& care) {
    for (int k = 0; k < cells_.literals(); ++k) {
      const std::size_t differing = differences_up_to_two_kinds(f.value, cells_.column(k), care);
      if (differing == kBoth) continue;
      ++counts_.replaced;
      f = Formula::leaf(k, differing == kAllDiffer);
      evaluate(f, cells_);
      return true;
    }
    return false;
  }

  static constexpr std::size_t kNoneDiffers = 0, kAllDiffer = 1, kBoth = 2;

  /// Whether `a` and `b` agree on all cells of `mask`, on none, or on some.
  static std::size_t differences_up_to_two_kinds(const Column& a, const Column& b,
                                                 const Column& mask) {
    bool has_same = false;
    bool has_different = false;
    for (std::size_t i = 0; i < a.size(); ++i) {
      const Word differing = (a[i] ^ b[i]) & mask[i];
      has_different = has_different || differing != 0;
      has_same = has_same || differing != mask[i];
      if (has_same && has_different) return kBoth;
    }
    return has_different ? kAllDiffer : kNoneDiffers;
  }

  /// The largest operands go first: each one dropped may make others indispensable.
  bool drop_operands(Formula& f, const Column& care) {
    std::vector<std::size_t> order(f.children.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::vector<int> leaves;
    for (const Formula& child : f.children) leaves.push_back(leaf_count(child));
    std::stable_sort(order.begin(), order.end(),
                     [&](std::size_t a, std::size_t b) { return leaves[a] > leaves[b]; });
    bool has_changed = false;
    SiblingCare siblings(f);
    for (const std::size_t i : order) {
      const Column reach = siblings.of(i, care);
      const bool is_neutral = f.kind == Kind::And ? is_subset(reach, f.children[i].value)
                                                  : !intersects(reach, f.children[i].value);
      if (!is_neutral) continue;
      ++(f.kind == Kind::And ? counts_.universal : counts_.empty);
      f.children[i] = Formula::constant(f.kind == Kind::And);
      evaluate(f.children[i], cells_);
      siblings.renew();
      has_changed = true;
    }
    return has_changed;
  }

  const CellColumns& cells_;
  const RunContext& run_;
  RedundancyCounts& counts_;
};

}  // namespace

Formula without_redundancy(Formula formula, const CellColumns& cells, const Column& care,
                           const RunContext& run, RedundancyCounts* counts) {
  RedundancyCounts ignored;
  return RedundancyRemover(cells, run, counts ? *counts : ignored).run(std::move(formula), care);
}

}  // namespace hewn
