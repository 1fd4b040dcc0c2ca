#include "core/synth/simplify/dominant.h"

#include <algorithm>
#include <utility>

#include "core/synth/simplify/redundancy.h"

namespace hewn {
namespace {

using Kind = Formula::Kind;

void collect_literals(const Formula& f, std::vector<int>& out) {
  if (f.kind == Kind::Leaf) out.push_back(f.literal);
  for (const Formula& child : f.children) collect_literals(child, out);
}

/// How many cells of each kind lie inside and outside of a literal.
struct Sides {
  int on_in = 0, on_out = 0, off_in = 0, off_out = 0;
};

Sides count_sides(const Column& literal, const Column& value, const Column& care) {
  Sides n;
  for (std::size_t i = 0; i < care.size(); ++i) {
    const Word on = care[i] & value[i];
    const Word off = care[i] & ~value[i];
    n.on_in += std::popcount(on & literal[i]);
    n.on_out += std::popcount(on & ~literal[i]);
    n.off_in += std::popcount(off & literal[i]);
    n.off_out += std::popcount(off & ~literal[i]);
  }
  return n;
}

struct Peel {
  DominantStep step;
  int cells = 0;
};

Peel best_peel(const std::vector<int>& literals, const Formula& f, const CellColumns& cells,
               const Column& care) {
  Peel best;
  for (const int k : literals) {
    const Sides n = count_sides(cells.column(k), f.value, care);
    const auto offer = [&](bool is_dominant, int decided, bool is_negated, bool is_union) {
      if (is_dominant && decided > best.cells) best = {{k, is_negated, is_union}, decided};
    };
    offer(n.off_in == 0, n.on_in, false, true);
    offer(n.off_out == 0, n.on_out, true, true);
    offer(n.on_in == 0, n.off_in, true, false);
    offer(n.on_out == 0, n.off_out, false, false);
  }
  return best;
}

}  // namespace

Decomposition decompose(Formula formula, const CellColumns& cells, const Column& care,
                        const RunContext& run) {
  Decomposition out;
  out.care = care;
  out.rest = without_redundancy(std::move(formula), cells, care, run);
  while (leaf_count(out.rest) > 1 && !run.is_cancelled()) {
    evaluate(out.rest, cells);
    std::vector<int> literals;
    collect_literals(out.rest, literals);
    const Peel peel = best_peel(literals, out.rest, cells, out.care);
    if (peel.cells == 0) break;
    out.steps.push_back(peel.step);
    // United: what is inside is decided. Intersected: what is outside is.
    const Column& column = cells.column(peel.step.literal);
    const bool keeps_inside = peel.step.is_union == peel.step.is_negated;
    for (std::size_t i = 0; i < out.care.size(); ++i) {
      out.care[i] &= keeps_inside ? column[i] : ~column[i];
    }
    out.rest = without_redundancy(std::move(out.rest), cells, out.care, run);
  }
  return out;
}

Formula recomposed(const Decomposition& decomposition, Formula rest) {
  for (std::size_t k = decomposition.steps.size(); k-- > 0;) {
    const DominantStep& step = decomposition.steps[k];
    std::vector<Formula> parts;
    parts.push_back(std::move(rest));
    parts.push_back(Formula::leaf(step.literal, step.is_negated));
    rest = Formula::join(step.is_union ? Kind::Or : Kind::And, std::move(parts));
  }
  return normalised(std::move(rest));
}

}  // namespace hewn
