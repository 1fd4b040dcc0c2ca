#include "core/synth/find_tree.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <optional>
#include <string>

#include "core/compute/parallel.h"
#include "core/sample/bar_ends.h"
#include "core/sample/cells.h"
#include "core/sample/separate.h"
#include "core/synth/decompose/gather.h"
#include "core/synth/decompose/list_search.h"
#include "core/synth/decompose/lower.h"
#include "core/synth/decompose/relax.h"
#include "core/synth/decompose/tighten.h"
#include "core/synth/verify.h"

namespace hewn {
namespace {

/// Errors closer than this are equal; the smaller list then wins.
constexpr double kSameError = 3e-5;
/// What a wrong share of the points along lines counts beside one of the uniform points.
constexpr double kLineWeight = 0.1;
/// Counts for more than all errors close to the surface.
constexpr double kStrayError = 1;
constexpr int kFewCounterexamples = 3;
constexpr std::size_t kMaxDensified = 2000;
constexpr int kDensifyCopies = 4;
constexpr double kDensifyReach = 0.01;  // of the diagonal
/// More surfaces than any design has: the mesh is free-form or hopelessly noisy.
constexpr std::size_t kMaxHalfspaces = 1500;
constexpr double kOnBox = 3e-4;  // of the diagonal: a halfspace that is a side of the box
/// What a primitive at an angle that no surface of the part has counts more than another one: its
/// dimensions are none that a person would type.
constexpr double kOddAngle = 1;
/// Halfspaces of a problem that is searched twice for the sake of its dimensions.
constexpr std::size_t kMostSearchedTwice = 50;

/// The halfspaces that a partition may use: its own groups' and those without groups (cut planes).
SurfaceSet select_surfaces(const SurfaceSet& all, const Labeller& label) {
  if (label.owns_all()) return all;
  std::vector<char> use(all.halfspaces.size(), 0);
  std::vector<char> has_group(all.halfspaces.size(), 0);
  for (std::size_t g = 0; g < all.halfspace_of_group.size(); ++g) {
    const int h = all.halfspace_of_group[g];
    if (h < 0) continue;
    has_group[h] = 1;
    if (label.owns_group(static_cast<int>(g))) use[h] = 1;
  }
  SurfaceSet out;
  out.directions = all.directions;
  std::vector<int> renumbered(all.halfspaces.size(), -1);
  for (std::size_t h = 0; h < all.halfspaces.size(); ++h) {
    if (!use[h] && has_group[h]) continue;
    renumbered[h] = static_cast<int>(out.halfspaces.size());
    out.halfspaces.push_back(all.halfspaces[h]);
  }
  for (const int h : all.halfspace_of_group) {
    out.halfspace_of_group.push_back(h < 0 ? -1 : renumbered[h]);
  }
  return out;
}

std::vector<int> triangles_of(const Segmentation& segmentation, const std::vector<int>& groups) {
  std::vector<int> out;
  for (const int g : groups) {
    const auto& t = segmentation.groups[g].triangles;
    out.insert(out.end(), t.begin(), t.end());
  }
  return out;
}

class TreeSearch {
 public:
  static constexpr double kProgressBegin = 0.2;
  static constexpr double kProgressEnd = 0.9;

  TreeSearch(const TreeProblem& problem, const TreeSearchOptions& options, ArcCut cut,
             const RunContext& run)
      : problem_(problem),
        options_(options),
        starts_(options.starts),
        cut_(cut),
        run_(run),
        tells_drafts_(problem.on_draft != nullptr),
        label_(*problem.query, *problem.segmentation, problem.groups, problem.is_subtracted),
        surfaces_(select_surfaces(*problem.surfaces, label_)),
        triangles_(triangles_of(*problem.segmentation, problem.groups)) {
    label_.ignore(problem.ignored);
    space_.label = &label_;
    space_.segmentation = problem.segmentation;
    space_.halfspaces = &surfaces_.halfspaces;
    space_.frame = find_frame(problem.query->mesh(), triangles_, surfaces_);
    space_.diagonal = problem.query->mesh().diagonal();
  }

  /// Samples the problem; what is wrong with it, if anything.
  std::optional<Error> prepare() {
    if (surfaces_.halfspaces.empty()) {
      return Error{ErrorCode::NotFound,
                   "no face group has a surface that could bound a solid; loosen the fit "
                   "tolerances or segment by curvature"};
    }
    if (surfaces_.halfspaces.size() > kMaxHalfspaces) {
      return Error{
          ErrorCode::NotFound,
          std::to_string(surfaces_.halfspaces.size()) +
              " different surfaces are more than a design has: the mesh is free-form or "
              "noisy; reconstruct its regular parts as partitions or loosen the tolerances"};
    }
    add_bar_ends();
    Result<SampleTable> table =
        build_sample_table(space_, options_.volume_points, surfaces_.halfspace_of_group, run_);
    if (!table) return table.error();
    table_ = std::move(*table);
    cells_ = find_cells(table_, run_);
    separate();
    return std::nullopt;
  }

  /// Requires: prepared.
  Result<TreeAnswer> find() {
    for (int round = 0; round <= last_round(); ++round) {
      const bool has_list = search_round(round);
      if (run_.is_cancelled()) return RunContext::cancelled();
      if (!has_list) break;
      if (!check_round(round)) break;
    }
    if (!best_) {
      return Error{ErrorCode::NotFound,
                   "no tree separates inside from outside with the surfaces found; the mesh may "
                   "be open or its free-form parts need a cut or a looser tolerance"};
    }
    return finish();
  }

  bool has_cut_corners() const { return corners_ > 0; }

  /// For the second search of a problem, whose first lists are no news.
  void keep_drafts() { tells_drafts_ = false; }

  /// For one of two searches of the same problem, whose constructions differ enough.
  void halve_starts() { starts_ = (starts_ + 1) / 2; }

  /// Requires: both have found a tree.
  bool is_better_than(const TreeSearch& other) const {
    if (std::abs(best_error_ - other.best_error_) >= kSameError) {
      return best_error_ < other.best_error_;
    }
    return weight() < other.weight();
  }

  void show_progress_in(double begin, double end) {
    progress_begin_ = begin;
    progress_end_ = end;
  }

 private:
  /// Their directions count as the part's own: its sides tell them.
  void add_bar_ends() {
    const std::vector<Halfspace> ends = bar_ends(space_, surfaces_);
    surfaces_.halfspaces.insert(surfaces_.halfspaces.end(), ends.begin(), ends.end());
    own_directions_ = static_cast<int>(surfaces_.directions.size());
  }

  void separate() {
    const Separation done =
        add_separating_halfspaces(space_, surfaces_, table_, cells_, cut_, run_);
    answer_.separating += done.added;
    corners_ += done.corners;
  }

  double weight() const {
    const auto has_odd_angle = [this](const TermPtr& item) {
      return std::any_of(item->literals.begin(), item->literals.end(), [this](const auto& l) {
        return surfaces_.halfspaces[static_cast<std::size_t>(l.halfspace)].direction >=
               own_directions_;
      });
    };
    const auto& items = best_->list.items;
    return best_->cost() + kOddAngle * static_cast<double>(std::count_if(items.begin(), items.end(),
                                                                         has_odd_angle));
  }

  /// Everything that depends on the cells.
  void rebuild_columns() {
    columns_.emplace(table_, cells_);
    combinability_.emplace(surfaces_);
    for (const bool clip : {false, true}) {
      SearchSpace& s = spaces_[clip ? 1 : 0];
      s.columns = &*columns_;
      s.combinability = &*combinability_;
      s.care = columns_->all();
    }
    drop_outside_box(spaces_[1].care);
    answer_.cells = static_cast<int>(columns_->cells());
  }

  /// Removes the cells beyond the sides of the frame's box.
  void drop_outside_box(std::vector<Word>& care) const {
    const Frame& frame = space_.frame;
    for (int c = 0; c < 3; ++c) {
      const Vec3 axis = frame.rotation.col(c);
      for (std::size_t k = 0; k < surfaces_.halfspaces.size(); ++k) {
        const Surface& s = surfaces_.halfspaces[k].surface;
        if (s.kind != SurfaceKind::Plane || s.axis.cross(axis).norm() > 1e-9) continue;
        const bool same_sense = s.axis.dot(axis) > 0;
        const double offset = same_sense ? s.offset : -s.offset;
        const bool is_low = std::abs(offset - frame.box.lo[c]) < kOnBox * space_.diagonal;
        const bool is_high = std::abs(offset - frame.box.hi[c]) < kOnBox * space_.diagonal;
        if (!is_low && !is_high) continue;
        const Word* inner = columns_->column(k, is_high == same_sense);
        for (std::size_t i = 0; i < care.size(); ++i) care[i] &= inner[i];
      }
    }
    std::vector<char> reaches_in(columns_->cells(), 0);
    for (std::size_t i = 0; i < table_.size(); ++i) {
      const int kept = columns_->kept_index(cells_.cell_of_point[i]);
      if (kept < 0 || reaches_in[kept]) continue;
      reaches_in[kept] =
          frame.box.contains(frame.to_local(table_.points[i]), 1e-5 * space_.diagonal) ? 1 : 0;
    }
    for (std::size_t i = 0; i < reaches_in.size(); ++i) {
      if (!reaches_in[i]) care[i >> 6] &= ~(Word{1} << (i & 63));
    }
  }

  void tell_draft(const FoundList& found) const {
    problem_.on_draft([&] { return lowered(found.list, found.is_clipped(), false); });
  }

  bool search_round(int round) {
    rebuild_columns();
    run_.report("search", share_done(round, 0));
    ListSearchOptions list;
    list.starts = starts_;
    list.beam_width = options_.beam_width;
    list.neighbourhood_steps = options_.neighbourhood_steps;
    list.regrow_tries = options_.regrow_tries;
    list.may_clip = !problem_.is_subtracted;
    ListSearch search(spaces_, list, stream(round, 0), run_);
    if (tells_drafts_) search.on_found([this](const FoundList& f) { tell_draft(f); });
    bool has_list = round > 0 && search.repair(current_);
    if (!has_list) {
      const auto progress = [&](double share) { run_.report("search", share_done(round, share)); };
      auto found = search.construct(progress);
      has_list = found.has_value();
      if (found) current_ = std::move(*found);
    }
    answer_.terms_grown += search.terms_grown();
    return has_list;
  }

  int last_round() const { return options_.rounds + options_.stray_rounds; }

  /// Rounds are seldom all needed, but none is known to be the last.
  double share_done(int round, double of_round) const {
    const double done = (round + of_round) / (last_round() + 1);
    return progress_begin_ + (progress_end_ - progress_begin_) * done;
  }

  std::uint64_t stream(int round, int task) const {
    return 0x500000 + static_cast<std::uint64_t>(round) * 1000 + static_cast<std::uint64_t>(task);
  }

  const SearchSpace& space_of(const FoundList& s) const { return spaces_[s.is_clipped() ? 1 : 0]; }

  /// Verifies the round's list; true when another round is worthwhile.
  bool check_round(int round) {
    answer_.rounds = round + 1;
    // What the cells do not show, the fresh points may.
    relax_list(space_of(current_), surfaces_, current_.list);
    if (!problem_.is_subtracted) tighten_list(space_of(current_), surfaces_, current_.list);
    gather_runs(space_of(current_), current_.list);
    const ListSolid solid(current_.list, surfaces_.halfspaces, space_.frame, current_.is_clipped());
    const Tree tree = lowered(current_.list, current_.is_clipped(), false);
    const SolidTest contains = [&solid](const Vec3& p) { return solid.contains(p); };
    const Candidate candidate{current_.list, contains, tree};
    Verification v = verify_list(space_, candidate, {}, stream(round, 0), run_);
    if (!v.has_stray) look_again(candidate, round, v);
    const double error =
        (1 - v.agreement) + kLineWeight * (1 - v.line_agreement) + (v.has_stray ? kStrayError : 0);
    const bool is_better = !best_ || error < best_error_ - kSameError ||
                           (error < best_error_ + kSameError && current_.cost() < best_->cost());
    if (is_better) {
      best_ = current_;
      best_error_ = error;
      if (tells_drafts_) tell_draft(current_);
    }
    if (round >= (v.has_stray ? last_round() : options_.rounds) || run_.should_stop()) return false;
    if (!v.has_stray && static_cast<int>(v.counterexamples.size()) < kFewCounterexamples) {
      return false;
    }
    append_points(table_, surfaces_.halfspaces, v.counterexamples, run_);
    densify(v.counterexamples, round);
    cells_ = find_cells(table_, run_);
    separate();
    return true;
  }

  /// A small piece that sticks out may escape one look: once more along lines aimed at the
  /// literals.
  void look_again(const Candidate& candidate, int round, Verification& v) const {
    const VerifyOptions aimed{.uniform_points = 0,
                              .near_points = 0,
                              .around_points = 0,
                              .lines = 0,
                              .lines_per_literal = 192};
    const Verification more = verify_list(space_, candidate, aimed, stream(round, 1), run_);
    v.has_stray = more.has_stray;
    v.counterexamples.insert(v.counterexamples.end(), more.counterexamples.begin(),
                             more.counterexamples.end());
  }

  void densify(const std::vector<LabelledPoint>& around, int round) {
    const std::size_t count = std::min(around.size(), kMaxDensified);
    const auto nearby = [&](std::size_t i, Rng& rng, const auto& emit) {
      for (int k = 0; k < kDensifyCopies; ++k) {
        Vec3 p = around[i].position;
        for (double& c : p) c += (rng.uniform() - 0.5) * kDensifyReach * space_.diagonal;
        emit(p);
      }
    };
    append_proposed(table_, space_, count, stream(round, 300), run_, nearby);
  }

  Result<TreeAnswer> finish() {
    const FoundList& solution = *best_;
    answer_.tree = lowered(solution.list, false, true);
    if (solution.is_clipped() && !problem_.is_subtracted && reaches_outside(answer_.tree)) {
      answer_.tree = lowered(solution.list, true, true);
    }
    answer_.halfspaces = static_cast<int>(surfaces_.halfspaces.size());
    answer_.agreement = measure_agreement(
        space_, [this](const Vec3& p) { return answer_.tree.contains(p); }, 10000, stream(999, 0),
        run_);
    if (run_.is_cancelled()) return RunContext::cancelled();
    return std::move(answer_);
  }

  /// The list as a tree; `clip` cuts it to the frame's box unless it is a tool. Long tools show
  /// what a term does beyond the cells, so only the answer's are shortened.
  Tree lowered(const DecisionList& list, bool clip, bool shortens_tools) const {
    LoweringOptions options;
    options.is_tool = problem_.is_subtracted;
    options.clip = clip && !options.is_tool;
    options.shortens_tools = shortens_tools;
    options.threads = run_.threads;
    return lower_list(list, surfaces_, problem_.query->mesh(), triangles_, space_.frame, options);
  }

  /// Whether the tree holds points outside the frame's box that the labels do not.
  bool reaches_outside(const Tree& tree) const {
    constexpr std::size_t kProbes = 20000;
    constexpr std::size_t kProbesPerTask = 200;
    Rng rng(run_.seed, stream(998, 0));
    std::vector<Vec3> probes(kProbes);
    for (Vec3& p : probes) p = sample_around_box(space_, rng);
    std::atomic<bool> is_found{false};
    const auto look = [&](std::size_t i) {
      if (is_found.load(std::memory_order_relaxed) || !tree.contains(probes[i])) return;
      if (label_(probes[i]) == Label::Outside) is_found = true;
    };
    for_each_index(run_.threads, kProbes, look, kProbesPerTask);
    return is_found;
  }

  const TreeProblem& problem_;
  const TreeSearchOptions& options_;
  int starts_;
  ArcCut cut_;
  const RunContext& run_;
  bool tells_drafts_;
  Labeller label_;
  SurfaceSet surfaces_;
  std::vector<int> triangles_;
  int own_directions_ = 0;  ///< those after them come with separating halfspaces
  int corners_ = 0;         ///< cut off by pairs of planes
  double progress_begin_ = kProgressBegin, progress_end_ = kProgressEnd;
  SampleSpace space_;
  SampleTable table_;
  Cells cells_;
  std::optional<ColumnTable> columns_;
  std::optional<Combinability> combinability_;
  std::array<SearchSpace, 2> spaces_;  ///< everywhere; inside the frame's box only
  FoundList current_;
  std::optional<FoundList> best_;
  double best_error_ = 0;
  TreeAnswer answer_;
};

constexpr OptionField<TreeSearchOptions> kOptions[] = {
    {"search", &TreeSearchOptions::search, 0, 1,
     "list: a decision list; evolve: the published genetic search over bounded primitives, to "
     "compare with",
     "list,evolve"},
    {"volume-points", &TreeSearchOptions::volume_points, 1000, 10'000'000,
     "uniform sample points of the first round"},
    {"starts", &TreeSearchOptions::starts, 1, 64, "independent constructions that are compared"},
    {"beam-width", &TreeSearchOptions::beam_width, 1, 64, "states kept by each construction"},
    {"neighbourhood-steps", &TreeSearchOptions::neighbourhood_steps, 0, 1'000'000,
     "steps without improvement after which the neighbourhood search ends"},
    {"regrow-tries", &TreeSearchOptions::regrow_tries, 1, 1000,
     "terms tried for each gap that the neighbourhood search cuts"},
    {"rounds", &TreeSearchOptions::rounds, 0, 32, "counterexample rounds at most"},
    {"stray-rounds", &TreeSearchOptions::stray_rounds, 0, 32,
     "more such rounds while points far from the mesh are wrong"},
};

}  // namespace

template <>
std::span<const OptionField<TreeSearchOptions>> option_table<TreeSearchOptions>() {
  return kOptions;
}

Result<TreeAnswer> find_tree(const TreeProblem& problem, const TreeSearchOptions& options,
                             const RunContext& run) {
  const bool may_search_twice = problem.surfaces->halfspaces.size() <= kMostSearchedTwice;
  TreeSearch search(problem, options, may_search_twice ? ArcCut::Corner : ArcCut::Chord, run);
  if (const std::optional<Error> error = search.prepare()) return *error;
  if (!search.has_cut_corners()) return search.find();

  // Corners have typed dimensions and chords are fewer literals: which list is the better one only
  // its search tells.
  constexpr double kBetween = 0.6;  // of the progress
  search.halve_starts();
  search.show_progress_in(TreeSearch::kProgressBegin, kBetween);
  Result<TreeAnswer> answer = search.find();
  if (run.should_stop()) return answer;
  TreeSearch chords(problem, options, ArcCut::Chord, run);
  if (const std::optional<Error> error = chords.prepare()) return *error;
  chords.halve_starts();
  chords.keep_drafts();
  chords.show_progress_in(kBetween, TreeSearch::kProgressEnd);
  Result<TreeAnswer> other = chords.find();
  if (!answer || (!other && other.error().code == ErrorCode::Cancelled)) return other;
  if (!other || search.is_better_than(chords)) return answer;
  return other;
}

}  // namespace hewn
