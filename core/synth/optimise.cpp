#include "core/synth/optimise.h"

#include <algorithm>
#include <optional>
#include <utility>

#include <fmt/format.h>

#include "core/csg/literal_set.h"
#include "core/csg/protrude.h"
#include "core/csg/tree_inside.h"
#include "core/csg/tree_ray.h"
#include "core/synth/formula_search.h"
#include "core/synth/free_cells.h"
#include "core/synth/inside_diagonal.h"
#include "core/synth/rebuild/boundary.h"
#include "core/synth/rebuild/second_start.h"
#include "core/synth/simplify/derived_literals.h"
#include "core/synth/simplify/exchange_literals.h"
#include "core/synth/simplify/grow_overlaps.h"
#include "core/synth/stage_timer.h"
#include "core/synth/tree_front.h"

namespace hewn {
namespace {

/// Many literals see each other's cells, so that each needs fewer lines.
ArrangementOptions lines_for(ArrangementOptions options, std::size_t literals) {
  constexpr double kFew = 60;
  const double share =
      std::min(1.0, kFew / static_cast<double>(std::max<std::size_t>(1, literals)));
  options.lines_per_face = std::max(3, static_cast<int>(options.lines_per_face * share));
  options.curves_per_face = std::max(2, static_cast<int>(options.curves_per_face * share));
  return options;
}

/// Fresh lines see fewer cells than the first ones, but other ones.
ArrangementOptions fresh_lines(ArrangementOptions options, int round) {
  options.stream = static_cast<std::uint64_t>(round) + 1;
  options.lines_per_face = options.lines_per_face / 2 + 1;
  options.curves_per_face = options.curves_per_face / 2 + 1;
  options.crossing_lines /= 2;
  return options;
}

class Optimiser {
 public:
  Optimiser(const Tree& tree, const OptimiseOptions& options, const RunContext& run)
      : input_(tree),
        options_(options),
        run_(run),
        literal_of_(set_.add(tree)),
        lines_(lines_for(options.arrangement, set_.literals().size())),
        sampler_(set_.literals(), scale_of(tree)),
        free_(tree) {}

  Result<OptimiseResult> work() {
    {
      StageTimer timer(out_.seconds, "cells");
      run_.report("cells", 0);
      if (auto done = find_cells(); !done) return done.error();
    }
    start_anew();
    for (int round = 0; round < options_.rounds; ++round) {
      out_.rounds = round + 1;
      if (auto done = rebuild(); !done) return done.error();
      CellColumns cells(sampler_.arrangement());
      derive(cells);
      const Result<Formula> found = search(cells);
      if (!found) return found.error();
      if (run_.is_cancelled()) return RunContext::cancelled();
      auto good = check(*found, round);
      if (!good) return good.error();
      if (*good && is_near_enough()) return finish(*found);
      if (*good && aims_.least_proximity > 0) break;
      if (*good) {
        // Once more, with proximity as the first aim.
        aims_.least_proximity = proximity_before();
        fallback_ = {*found, derived_, proved_, out_.equivalence};
        continue;
      }
      run_.info(fmt::format("round {}: the tree found differs on cells unseen before", round + 1));
    }
    if (fallback_ && restore_fallback()) return finish(fallback_->formula);
    run_.warn("nothing smaller could be proved to be the same solid; the tree is kept as it is");
    out_.is_input = true;
    return finish(formula_of(input_, literal_of_));
  }

 private:
  /// Points nearer to the surface than this are free; model units.
  double depth() const { return options_.tolerance * sampler_.arrangement().scale / 2; }
  Formula input_formula() const { return formula_of(input_, literal_of_); }

  Result<void> find_cells() {
    if (auto done = sample_cells(sampler_, options_.cells, lines_, run_); !done) {
      return done.error();
    }
    const CellColumns cells(sampler_.arrangement());
    Formula wanted = input_formula();
    const double diagonal =
        diagonal_of_inside(input_, sampler_.arrangement(), evaluate(wanted, cells));
    // A box of less than twice the size is not far too large.
    if (diagonal <= 0 || 2 * diagonal > sampler_.arrangement().scale) return {};
    sampler_ = ArrangementSampler(set_.literals(), diagonal);
    if (auto done = sample_cells(sampler_, options_.cells, lines_, run_); !done) {
      return done.error();
    }
    return {};
  }

  /// A second start for the search, unless there is little to gain.
  void start_anew() {
    if (!options_.rebuilds || options_.method != OptimiseMethod::Rewrite) return;
    StageTimer timer(out_.seconds, "rebuild");
    const Arrangement& a = sampler_.arrangement();
    second_.emplace(input_, a.points, a.scale, depth(), run_);
    aims_.least_literals = second_->least_literals();
    if (is_hardly_larger_than_needed()) second_.reset();
  }

  /// The solid built anew, again as soon as a cell speaks against the last answer.
  Result<void> rebuild() {
    while (second_) {
      if (rebuilt_ && is_rebuilt_right()) return {};
      StageTimer timer(out_.seconds, "rebuild");
      rebuilt_.reset();
      if (fallback_) second_.reset();  // its formula is over the literals as they are
      if (!second_) return {};
      auto found =
          second_->find(sampler_.arrangement(), free_.deep_points(), lines_, most_rebuilt_);
      if (!found) return found.error();
      if (!*found) {
        second_.reset();
        return {};
      }
      rebuilt_ = std::move((*found)->tree);
      rebuilt_literal_of_ = std::move((*found)->literal_of);
      set_ = std::move((*found)->set);
      sampler_ = std::move((*found)->sampler);
      free_.renumber(sampler_);
    }
    return {};
  }

  bool is_rebuilt_right() {
    const CellColumns cells(sampler_.arrangement());
    Formula wanted = input_formula();
    Formula other = formula_of(*rebuilt_, rebuilt_literal_of_);
    evaluate(wanted, cells);
    evaluate(other, cells);
    Column wrong = differences(wanted.value, other.value, cells.all());
    remove_free(wrong);
    return std::all_of(wrong.begin(), wrong.end(), [](Word word) { return word == 0; });
  }

  /// Whether the solid's surfaces ask for nearly as many literals as there are without redundancy.
  bool is_hardly_larger_than_needed() {
    constexpr int kShareWorthBuilding = 8;
    const CellColumns cells(sampler_.arrangement());
    const int leaves = leaf_count(without_redundancy(input_formula(), cells, cells.all(), run_));
    // Rewriting finds about a tenth more.
    most_rebuilt_ = leaves + leaves / 8;
    if (aims_.least_literals == 0) return false;
    return kShareWorthBuilding * (leaves - aims_.least_literals) < leaves;
  }

  /// The smaller of two formulas.
  Formula start(const CellColumns& cells, const Column& cared) {
    Formula best = without_redundancy(input_formula(), cells, cared, run_, &out_.redundancy);
    if (!rebuilt_) return best;
    Formula other = formula_of(*rebuilt_, rebuilt_literal_of_);
    other = without_redundancy(std::move(other), cells, cared, run_);
    return leaf_count(other) < leaf_count(best) ? other : best;
  }

  /// Finds the primitives that stand for several; they are the columns behind the input's.
  void derive(CellColumns& cells) {
    derived_.clear();
    if (!options_.derives_primitives || options_.method != OptimiseMethod::Rewrite) return;
    StageTimer timer(out_.seconds, "derive");
    Formula wanted = input_formula();
    evaluate(wanted, cells);
    const std::size_t most = std::min<std::size_t>(400, 100 + 2 * set_.literals().size());
    derived_ = derive_literals(set_.literals(), cells, wanted.value, most);
    add_derived(cells);
  }

  void add_derived(CellColumns& cells) const {
    std::vector<Column> columns;
    for (const DerivedLiteral& d : derived_) columns.push_back(column_of(d, cells));
    for (Column& c : columns) cells.add(std::move(c));
  }

  std::vector<Literal> all_literals() const {
    std::vector<Literal> all = set_.literals();
    for (const DerivedLiteral& d : derived_) all.push_back(d.solid);
    return all;
  }

  /// The cells that must keep their value.
  Column care(const CellColumns& cells) {
    Column care = cells.all();
    remove_free(care);
    return care;
  }

  void remove_free(Column& cells) {
    if (options_.tolerance <= 0) return;
    StageTimer timer(out_.seconds, "thin");
    free_.remove_from(cells, sampler_, depth(), run_);
  }

  Result<Formula> search(const CellColumns& cells) {
    const Column cared = care(cells);
    out_.redundancy = {};
    Formula f;
    {
      StageTimer timer(out_.seconds, "redundancy");
      f = start(cells, cared);
    }
    if (options_.method == OptimiseMethod::Redundancy) return f;
    {
      StageTimer timer(out_.seconds, "search");
      auto found = search_formula(std::move(f), cells, cared, options_, aims_, run_);
      if (!found) return found.error();
      f = std::move(found->formula);
      out_.remaining_literals = found->remaining_literals;
      out_.qubo = std::move(found->qubo);
    }
    StageTimer timer(out_.seconds, "redundancy");
    f = without_redundancy(std::move(f), cells, cared, run_);
    if (options_.method != OptimiseMethod::Rewrite) return f;
    return exchange_literals(std::move(f), cells, cared, run_);
  }

  /// Whether `found` holds on cells and points that the search has not seen. Those where it does
  /// not join the cells.
  Result<bool> check(const Formula& found, int round) {
    {
      StageTimer timer(out_.seconds, "cells");
      run_.report("check", 0);
      auto fresh = sampler_.sample(fresh_lines(lines_, round), run_);
      if (!fresh) return fresh.error();
    }
    CellColumns cells(sampler_.arrangement());
    add_derived(cells);
    const Column cared = care(cells);
    Formula wanted = input_formula();
    evaluate(wanted, cells);
    Formula value = found;
    evaluate(value, cells);
    if (count_differences(wanted.value, value.value, cared) > 0) return false;
    if (grow(found, cells)) {
      auto same = prove(proved_.tree, round);
      if (!same || *same) return same;
    }
    const Tree plain = to_tree(found, all_literals(), cells);
    for (const Tree& tree : {with_protruding_tools(plain), plain}) {
      proved_ = {tree, formula_proximity(found, cells), false};
      auto same = prove(tree, round);
      if (!same || *same) return same;
    }
    sampler_.add(out_.equivalence.examples, run_);
    for (const Vec3& p : out_.equivalence.examples) free_.hold(p, sampler_);
    return false;
  }

  Result<bool> prove(const Tree& tree, int round) {
    StageTimer timer(out_.seconds, "proof");
    EquivalenceOptions options = options_.equivalence;
    options.stream = static_cast<std::uint64_t>(round) + 1;
    options.scale = sampler_.arrangement().scale;
    options.allowed_distance = depth();
    auto compared = compare_trees(input_, tree, options, run_);
    if (!compared) return compared.error();
    out_.equivalence = std::move(*compared);
    return out_.equivalence.is_same();
  }

  /// Lets operands that only touch overlap, into `proved_`. False when that changes nothing, or
  /// changes the solid on a cell beside the new primitives.
  bool grow(const Formula& found, const CellColumns& cells) {
    if (options_.method != OptimiseMethod::Rewrite || !options_.derives_primitives) return false;
    if (found.is_constant() || found.is_negated || formula_proximity(found, cells) >= 1) {
      return false;
    }
    StageTimer timer(out_.seconds, "grow");
    const TreeInside inside(input_);
    proved_ = grow_overlaps(found, all_literals(), sampler_.arrangement().points, inside, run_);
    if (!proved_.is_changed) return false;
    // Other cells than the known ones lie beside new primitives only.
    LiteralSet all = set_;
    ArrangementOptions lines = fresh_lines(lines_, 0);
    lines.first_literal = all.literals().size();
    all.add(proved_.tree);
    ArrangementSampler beside(all.literals(), sampler_.arrangement().scale);
    if (!beside.sample(lines, run_)) return false;
    const TreeInside other(proved_.tree);
    const TreeRays rays(input_);
    const auto is_wrong = [&](const Vec3& p) {
      return inside.contains(p) != other.contains(p) && !is_free(rays, p, depth());
    };
    return std::ranges::none_of(sampler_.arrangement().points, is_wrong) &&
           std::ranges::none_of(beside.arrangement().points, is_wrong);
  }

  /// False when a cell found since speaks against it.
  bool restore_fallback() {
    derived_ = fallback_->derived;
    proved_ = fallback_->proved;
    out_.equivalence = fallback_->equivalence;
    CellColumns cells(sampler_.arrangement());
    add_derived(cells);
    const Column cared = care(cells);
    Formula wanted = input_formula();
    Formula value = fallback_->formula;
    return count_differences(evaluate(wanted, cells), evaluate(value, cells), cared) == 0;
  }

  double proximity_before() const {
    return tree_proximity(input_, literal_of_, CellColumns(sampler_.arrangement()));
  }

  /// Whether the tree proved is as near together as the input. If not, the search runs once more
  /// for one that is; when there is none, or none smaller than the input, size goes first.
  bool is_near_enough() const {
    return options_.method != OptimiseMethod::Rewrite ||
           (proved_.proximity >= proximity_before() - 1e-12 &&
            (!fallback_ || tree_size(proved_.tree) < tree_size(input_)));
  }

  Result<OptimiseResult> finish(const Formula& found) {
    CellColumns cells(sampler_.arrangement());
    add_derived(cells);
    out_.cells = cells.cells();
    out_.resolution = sampler_.arrangement().resolution;
    out_.before = {literal_count(input_), tree_size(input_),
                   tree_proximity(input_, literal_of_, cells)};
    out_.tree = out_.is_input ? input_ : proved_.tree;
    if (found.is_constant()) {
      out_.extent = found.is_negated ? SolidExtent::Everything : SolidExtent::Empty;
    }
    out_.after = out_.before;
    if (!out_.is_input) {
      out_.after = {leaf_count(found), formula_size(found), proved_.proximity};
    }
    Formula wanted = input_formula();
    evaluate(wanted, cells);
    Formula value = found;
    evaluate(value, cells);
    const Column changed = differences(wanted.value, value.value, cells.all());
    out_.thin_features = thin_features(input_, sampler_.arrangement(), wanted.value, changed);
    for (const ThinFeature& f : out_.thin_features) out_.changed_cells += f.cells;
    out_.tolerated_cells = free_.count();
    if (options_.wants_front && !found.is_constant()) {
      if (auto done = add_front(found, cells); !done) return done.error();
    }
    return std::move(out_);
  }

  /// Evolves from the tree found and from the input.
  Result<void> add_front(const Formula& found, const CellColumns& cells) {
    StageTimer timer(out_.seconds, "front");
    FrontStart start{out_.tree, {found}, all_literals(), cells, options_.equivalence};
    const Formula input = input_formula();
    if (options_.tolerance <= 0 && !input.is_constant()) start.formulas.push_back(input);
    start.equivalence.scale = sampler_.arrangement().scale;
    auto front = find_front(start, options_.remaining.genetic, run_);
    if (!front) return front.error();
    out_.front = std::move(*front);
    return {};
  }

  const Tree& input_;
  const OptimiseOptions& options_;
  const RunContext& run_;
  LiteralSet set_;
  std::vector<int> literal_of_;
  std::optional<SecondStart> second_;  ///< while it may still be asked
  int most_rebuilt_ = 0;               ///< literals with which it is of use
  std::optional<Tree> rebuilt_;
  std::vector<int> rebuilt_literal_of_;
  ArrangementOptions lines_;
  ArrangementSampler sampler_;
  std::vector<DerivedLiteral> derived_;
  GrownTree proved_;  ///< what the last proof was about
  FormulaAims aims_;
  struct Proved {
    Formula formula;
    std::vector<DerivedLiteral> derived;
    GrownTree proved;
    Equivalence equivalence;
  };
  std::optional<Proved> fallback_;  ///< smaller, but with a lower proximity than the input
  FreeCells free_;
  OptimiseResult out_;
};

}  // namespace

RemainingMethod remaining_method(OptimiseMethod method) {
  switch (method) {
    case OptimiseMethod::QuineMcCluskey:
      return RemainingMethod::QuineMcCluskey;
    case OptimiseMethod::Espresso:
      return RemainingMethod::Espresso;
    case OptimiseMethod::SetCover:
      return RemainingMethod::SetCover;
    case OptimiseMethod::Annealing:
      return RemainingMethod::Annealing;
    case OptimiseMethod::Genetic:
      return RemainingMethod::Genetic;
    case OptimiseMethod::Rewrite:
      return RemainingMethod::Rewrite;
    case OptimiseMethod::Redundancy:
    case OptimiseMethod::Dominant:
      break;
  }
  return RemainingMethod::None;
}

Result<OptimiseResult> optimise(const Tree& tree, const OptimiseOptions& options,
                                const RunContext& run) {
  if (!(options.tolerance >= 0 && options.tolerance < 0.5)) {
    return Error{ErrorCode::InvalidArgument,
                 fmt::format("a tolerance of {} makes no sense; give a share of the diagonal below "
                             "0.5",
                             options.tolerance)};
  }
  const int literals = literal_count(tree);
  if (literals > kMostOptimisedLiterals) {
    return Error{
        ErrorCode::TooLarge,
        fmt::format("the tree has {} primitives, more than the {} that can be optimised at "
                    "once; optimise its parts one by one",
                    literals, kMostOptimisedLiterals)};
  }
  return Optimiser(tree, options, run).work();
}

}  // namespace hewn
