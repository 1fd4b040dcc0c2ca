#include "core/synth/simplify/rewrite_search.h"

#include <algorithm>
#include <limits>
#include <utility>

#include "core/synth/simplify/resynthesise.h"
#include "core/synth/simplify/sibling_care.h"

namespace hewn {
namespace {

using Kind = Formula::Kind;

/// A part of a formula: some operands of an operation, or the whole root.
struct Window {
  std::vector<std::size_t> path;      ///< operand indices from the root to the operation
  std::vector<std::size_t> operands;  ///< ascending
};

bool uses_literal(const Formula& f, int literal) {
  if (f.kind == Kind::Leaf) return f.literal == literal;
  return std::any_of(f.children.begin(), f.children.end(),
                     [&](const Formula& child) { return uses_literal(child, literal); });
}

bool share_literal(const Formula& a, const Formula& b) {
  if (a.kind == Kind::Leaf) return uses_literal(b, a.literal);
  return std::any_of(a.children.begin(), a.children.end(),
                     [&](const Formula& child) { return share_literal(child, b); });
}

class RewriteSearch {
 public:
  RewriteSearch(const CellColumns& cells, const Column& care, const RewriteOptions& options,
                const RunContext& run)
      : cells_(cells),
        care_(care),
        options_(options),
        run_(run),
        resynthesis_(cells),
        rng_(run.seed, 4711) {}

  Formula search(Formula start) {
    current_ = std::move(start);
    evaluate(current_, cells_);
    leaves_ = leaf_count(current_);
    keep_best();
    const int steps = steps_from(leaves_);
    int last_gain = 0;
    for (int step = 0; step < steps; ++step) {
      if (is_best_possible() || run_.should_stop() || resynthesis_.work() > options_.most_work)
        break;
      if (leaves_ <= 1 || step - last_gain > steps / 2) break;
      if (step % 64 == 0) run_.report("rewrite", static_cast<double>(step) / steps);
      const int before = leaves_;
      try_window();
      if (leaves_ < before) last_gain = step;
    }
    return std::move(best_);
  }

 private:
  /// Less for what can hardly get smaller.
  int steps_from(int leaves) const {
    const int steps = std::min(options_.most_steps, 400 + options_.steps_per_literal * leaves);
    if (options_.least_literals <= 0) return steps;
    const double gap = static_cast<double>(leaves - options_.least_literals) / leaves;
    return static_cast<int>(steps * std::clamp(4 * gap, 0.2, 1.0));
  }

  bool is_best_possible() const {
    return options_.least_literals > 0 && best_size_ < 2 * options_.least_literals &&
           best_proximity_ >= 1;
  }

  /// Of formulas of one length the one with the best proximity, of those near enough first.
  void keep_best() {
    const int size = formula_size(current_);
    if (best_meets_ && size > best_size_) return;
    const double proximity = formula_proximity(current_, cells_);
    const bool meets = proximity >= options_.least_proximity;
    if (best_meets_ && !meets) return;
    if (meets == best_meets_ &&
        (size > best_size_ || (size == best_size_ && proximity <= best_proximity_))) {
      return;
    }
    best_meets_ = meets;
    best_ = current_;
    best_size_ = size;
    best_proximity_ = proximity;
  }

  void try_window() {
    Column care = care_;
    const Window window = random_window(care);
    Formula* node = &current_;
    for (const std::size_t i : window.path) node = &node->children[i];
    int size = 0;
    const Column value = value_of(*node, window, size);
    if (size < 2 || size > options_.largest_window) return;
    CellTask task{care, care};
    for (std::size_t i = 0; i < care.size(); ++i) {
      task.on[i] &= value[i];
      task.off[i] &= ~value[i];
    }
    for (int k = 0; k < options_.attempts; ++k) {
      // Equal sizes only now and then: they cost a new evaluation.
      const int budget = rng_.below(3) == 0 ? size : size - 1;
      auto found = resynthesis_.attempt(task, budget, rng_);
      if (!found) continue;
      accept(*node, window, std::move(*found));
      return;
    }
  }

  /// Walks down at random; narrows `care` to the cells where the window matters.
  Window random_window(Column& care) {
    Window window;
    Formula* node = &current_;
    while (node->kind == Kind::And || node->kind == Kind::Or) {
      const int leaves = leaf_count(*node);
      const std::size_t operands = node->children.size();
      if (leaves <= options_.largest_window && rng_.below(3) == 0) break;
      if (operands > 2 && rng_.below(3) == 0) break;
      const std::size_t down = rng_.below(operands);
      if (node->children[down].children.empty()) break;
      care = care_of_child(*node, down, care);
      window.path.push_back(down);
      node = &node->children[down];
    }
    choose_operands(*node, window);
    for (std::size_t k = 0; k < node->children.size(); ++k) {
      if (std::binary_search(window.operands.begin(), window.operands.end(), k)) continue;
      const Column& v = node->children[k].value;
      for (std::size_t i = 0; i < care.size(); ++i) {
        care[i] &= node->kind == Kind::And ? v[i] : ~v[i];
      }
    }
    return window;
  }

  /// All operands, or some when they are many or chance wants it.
  void choose_operands(const Formula& node, Window& window) {
    std::vector<std::size_t> order(node.children.size());
    for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
    const bool takes_all = leaf_count(node) <= options_.largest_window && rng_.coin();
    if (!takes_all && order.size() > 2) {
      rng_.shuffle(order);
      if (rng_.below(4) != 0) {
        // Operands that have nothing to do with each other can hardly be joined.
        const Formula& anchor = node.children[order[0]];
        std::stable_partition(order.begin() + 1, order.end(), [&](std::size_t k) {
          return intersects(node.children[k].value, anchor.value) ||
                 share_literal(node.children[k], anchor);
        });
      }
      std::size_t wanted = rng_.below(4);
      wanted += 2;
      order.resize(std::min(wanted, order.size()));
    }
    std::sort(order.begin(), order.end());
    window.operands = std::move(order);
  }

  Column value_of(const Formula& node, const Window& window, int& size) const {
    Column value = node.kind == Kind::And ? cells_.all() : cells_.empty();
    for (const std::size_t k : window.operands) {
      size += leaf_count(node.children[k]);
      const Column& v = node.children[k].value;
      for (std::size_t i = 0; i < v.size(); ++i) {
        value[i] = node.kind == Kind::And ? value[i] & v[i] : value[i] | v[i];
      }
    }
    return value;
  }

  void accept(Formula& node, const Window& window, Formula found) {
    for (std::size_t i = window.operands.size(); i-- > 0;) {
      node.children.erase(node.children.begin() + static_cast<std::ptrdiff_t>(window.operands[i]));
    }
    node.children.push_back(std::move(found));
    current_ = normalised(std::move(current_));
    evaluate(current_, cells_);
    leaves_ = leaf_count(current_);
    keep_best();
  }

  const CellColumns& cells_;
  const Column& care_;
  const RewriteOptions& options_;
  const RunContext& run_;
  Resynthesis resynthesis_;
  Rng rng_;
  Formula current_, best_;
  int leaves_ = 0;
  int best_size_ = std::numeric_limits<int>::max();
  double best_proximity_ = 0;
  bool best_meets_ = false;
};

}  // namespace

Formula rewrite_search(Formula formula, const CellColumns& cells, const Column& care,
                       const RewriteOptions& options, const RunContext& run) {
  return RewriteSearch(cells, care, options, run).search(normalised(std::move(formula)));
}

}  // namespace hewn
