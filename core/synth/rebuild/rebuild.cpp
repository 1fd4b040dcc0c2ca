#include "core/synth/rebuild/rebuild.h"

#include <algorithm>
#include <cmath>
#include <unordered_set>
#include <utility>

#include "core/sample/cells.h"
#include "core/synth/decompose/gather.h"
#include "core/synth/decompose/lower.h"
#include "core/synth/decompose/relax.h"
#include "core/synth/rebuild/bounding_surfaces.h"
#include "core/synth/rebuild/feature_points.h"
#include "core/synth/rebuild/least_literals.h"

namespace hewn {
namespace {

constexpr int kPairsPerSurface = 64;
/// Nearer to a surface than this share of the scale, rounding may decide the side.
constexpr double kUncertain = 2e-9;
/// Distances of pairs from their surface, as shares of the scale.
constexpr double kPairReach[] = {1e-5, 1e-4, 1e-3};
constexpr double kMargin = 0.05;
/// Points this deep, as a share of the depth that is free, have to be right: a feature that is just
/// thick enough to matter shows to few points that are as deep as it gets.
constexpr double kSureDepth = 0.75;
/// In the feature of a point that refuted an answer.
constexpr int kPointsBeside = 32;
/// More surfaces and cells than a search over them is worth.
constexpr std::size_t kMostSurfaces = 1000;

}  // namespace

/// The search over the surfaces that bound the solid.
class TreeRebuilder::Search {
 public:
  Search(const Tree& tree, const std::vector<Vec3>& points, double scale,
         const RebuildOptions& options, const RunContext& run)
      : solid_{TreeInside(tree), TreeRays(tree), scale, options.depth},
        given_(points),
        options_(options),
        run_(run),
        surfaces_(solid_, points, run) {}

  Result<std::optional<Tree>> next(int most_literals) {
    if (round_ == 0 && (!surfaces_.find_bounding() || !fill_table())) return nothing();
    if (run_.is_cancelled()) return RunContext::cancelled();
    const bool has_list = search_round(most_literals);
    if (run_.is_cancelled()) return RunContext::cancelled();
    ++round_;
    if (!has_list) return nothing();
    return std::optional<Tree>(lowered());
  }

  int least_literals() {
    if (options_.depth > 0 || !surfaces_.find_all()) return 0;
    return hewn::least_literals(surfaces_.surely_bounding());
  }

  std::vector<LabelledPoint> labelled(const std::vector<Vec3>& points) const {
    std::vector<LabelledPoint> out;
    out.reserve(points.size());
    for (const Vec3& p : points) out.push_back({p, solid_.inside.contains(p)});
    return out;
  }

  std::size_t refute(const Tree& found, const std::vector<LabelledPoint>& points, Take take) {
    const TreeInside other(found);
    std::size_t wrong = 0;
    std::vector<Vec3> telling;
    for (const auto& [p, is_inside] : points) {
      const bool is_wrong = is_inside != other.contains(p);
      if (!is_wrong && (take == Take::Wrong || is_known_cell(p))) continue;
      if (!is_usable(p)) continue;
      telling.push_back(p);
      if (!is_wrong) continue;
      ++wrong;
      if (options_.depth > 0) take_feature_of(p, wrong, telling);
    }
    add_points(labelled(telling));
    return wrong;
  }

 private:
  static Result<std::optional<Tree>> nothing() { return std::optional<Tree>(); }
  const std::vector<Halfspace>& used() const { return surfaces_.used().halfspaces; }

  bool is_known_cell(const Vec3& p) {
    signature_.assign(table_.stride, 0);
    for (std::size_t k = 0; k < used().size(); ++k) {
      if (used()[k].surface.signed_distance(p) < 0) set_bit(signature_.data(), k);
    }
    return !known_cells_.insert(hash_words(signature_)).second;
  }

  bool is_certain(const Vec3& p) const {
    const auto is_far = [&](const Halfspace& h) {
      return std::abs(h.surface.signed_distance(p)) > kUncertain * solid_.scale;
    };
    return std::all_of(surfaces_.all().begin(), surfaces_.all().end(), is_far);
  }

  bool is_usable(const Vec3& p) const {
    return is_certain(p) && !is_free(solid_.rays, p, kSureDepth * options_.depth);
  }

  /// Further points of the wall or the gap that `p` lies in.
  void take_feature_of(const Vec3& p, std::size_t stream, std::vector<Vec3>& points) const {
    Rng rng(run_.seed, 0xFEA7 + stream);
    for (const Vec3& beside : points_beside(solid_.rays, p, kPointsBeside, solid_.scale, rng)) {
      if (is_usable(beside)) points.push_back(beside);
    }
  }

  void add_points(const std::vector<LabelledPoint>& points) {
    append_points(table_, used(), points, run_);
  }

  bool fill_table() {
    if (used().size() > kMostSurfaces) return false;
    table_.halfspaces = used().size();
    table_.stride = (table_.halfspaces + 63) / 64;
    std::vector<Vec3> points;
    for (const Vec3& p : given_) {
      if (!run_.is_cancelled() && is_usable(p)) points.push_back(p);
    }
    Rng rng(run_.seed, 0x5EED);
    for (int i = 0; i < options_.volume_points && !run_.is_cancelled(); ++i) {
      // Every third one around the box.
      const double margin = i % 3 == 0 ? 0.5 : kMargin;
      Vec3 local;
      for (int c = 0; c < 3; ++c) {
        const double extra = margin * surfaces_.frame().box.size()[c];
        local[c] =
            rng.uniform(surfaces_.frame().box.lo[c] - extra, surfaces_.frame().box.hi[c] + extra);
      }
      const Vec3 p = surfaces_.frame().to_space(local);
      if (is_usable(p)) points.push_back(p);
    }
    add_pairs(points);
    add_points(labelled(points));
    return true;
  }

  void add_pairs(std::vector<Vec3>& points) {
    std::vector<int> count(used().size(), 0);
    for (std::size_t i = 0; i < surfaces_.hits().size() && !run_.is_cancelled(); ++i) {
      const BoundaryHit& h = surfaces_.hits()[i];
      int& pairs = count[surfaces_.index_in_used(h)];
      if (pairs >= kPairsPerSurface) continue;
      const double reach =
          options_.depth > 0 ? 1.5 * options_.depth : kPairReach[i % 3] * solid_.scale;
      const Vec3 inside = h.position - reach * h.normal;
      const Vec3 outside = h.position + reach * h.normal;
      if (!solid_.inside.contains(inside) || solid_.inside.contains(outside)) continue;
      if (!is_usable(inside) || !is_usable(outside)) continue;
      ++pairs;
      const int first = static_cast<int>(points.size());
      points.push_back(inside);
      points.push_back(outside);
      table_.pairs.push_back({first, first + 1, static_cast<int>(surfaces_.index_in_used(h))});
    }
  }

  /// Takes in further surfaces of the tree until no cell holds points of both kinds.
  void separate() {
    for (;;) {
      cells_ = find_cells(table_, run_);
      std::vector<std::vector<int>> mixed(cells_.size());
      for (std::size_t i = 0; i < table_.size(); ++i) {
        const auto c = static_cast<std::size_t>(cells_.cell_of_point[i]);
        if (std::min(cells_.inside_count[c], cells_.outside_count[c]) > 0) {
          mixed[c].push_back(static_cast<int>(i));
        }
      }
      std::erase_if(mixed, [](const auto& points) { return points.empty(); });
      if (mixed.empty()) return;
      if (!surfaces_.use_separating(table_, mixed)) return;
      append_halfspaces(table_, used(), run_);
    }
  }

  bool search_round(int most_literals) {
    separate();
    known_cells_.clear();
    for (const int i : cells_.first_point) {
      const auto row = static_cast<std::size_t>(i);
      known_cells_.insert(hash_words({table_.signature(row), table_.stride}));
    }
    columns_.emplace(table_, cells_, ColumnTable::Labels::Exact);
    combinability_.emplace(surfaces_.used());
    for (SearchSpace& s : spaces_) {
      s.columns = &*columns_;
      s.combinability = &*combinability_;
      s.care = columns_->all();
    }
    keep_inside_box(spaces_[1].care);
    ListSearchOptions list = list_options();
    list.most_cost = most_literals;
    ListSearch search(spaces_, list, 0x700000 + 1000 * round_, run_);
    if (round_ > 0 && search.repair(found_)) return true;
    auto found = search.construct([](double) {});
    if (!found) return false;
    found_ = std::move(*found);
    return true;
  }

  /// The less a start takes the more of them; what they find is rewritten afterwards.
  ListSearchOptions list_options() const {
    constexpr double kFullEffortWork = 4000;  // halfspaces x words
    constexpr int kFewest = 3;                // starts, and states of a beam
    ListSearchOptions list = options_.list;
    const auto work = static_cast<double>(columns_->halfspaces() * columns_->words());
    const int affordable = static_cast<int>(list.starts * std::min(2.0, kFullEffortWork / work));
    list.starts = std::max(affordable, kFewest);
    if (affordable < kFewest) list.beam_width = kFewest;
    return list;
  }

  void keep_inside_box(std::vector<Word>& care) const {
    std::vector<char> reaches_in(columns_->cells(), 0);
    for (std::size_t i = 0; i < table_.size(); ++i) {
      const int kept = columns_->kept_index(cells_.cell_of_point[i]);
      if (kept < 0 || reaches_in[static_cast<std::size_t>(kept)]) continue;
      if (surfaces_.frame().box.contains(surfaces_.frame().to_local(table_.points[i]))) {
        reaches_in[static_cast<std::size_t>(kept)] = 1;
      }
    }
    for (std::size_t c = 0; c < reaches_in.size(); ++c) {
      if (!reaches_in[c]) care[c >> 6] &= ~(Word{1} << (c & 63));
    }
  }

  Tree lowered() {
    const SearchSpace& space = spaces_[found_.is_clipped() ? 1 : 0];
    relax_list(space, surfaces_.used(), found_.list);
    gather_runs(space, found_.list);
    LoweringOptions options;
    Tree tree = lower_list(found_.list, surfaces_.used(), surfaces_.extent(), {}, surfaces_.frame(),
                           options);
    if (!found_.is_clipped()) return tree;
    for (std::size_t i = 0; i < table_.size(); ++i) {
      if (table_.is_inside[i] || !tree.contains(table_.points[i])) continue;
      options.clip = true;
      return lower_list(found_.list, surfaces_.used(), surfaces_.extent(), {}, surfaces_.frame(),
                        options);
    }
    return tree;
  }

  GivenSolid solid_;
  const std::vector<Vec3>& given_;
  const RebuildOptions& options_;
  const RunContext& run_;
  BoundingSurfaces surfaces_;
  SampleTable table_;
  Cells cells_;
  std::unordered_set<std::uint64_t> known_cells_;  ///< hashes of signatures; never iterated
  std::vector<Word> signature_;
  std::optional<ColumnTable> columns_;
  std::optional<Combinability> combinability_;
  std::array<SearchSpace, 2> spaces_;  ///< everywhere; inside the frame's box only
  FoundList found_;
  std::uint64_t round_ = 0;
};

TreeRebuilder::TreeRebuilder(const Tree& tree, const std::vector<Vec3>& points, double scale,
                             const RebuildOptions& options, const RunContext& run)
    : search_(std::make_unique<Search>(tree, points, scale, options, run)) {}

TreeRebuilder::~TreeRebuilder() = default;

int TreeRebuilder::least_literals() { return search_->least_literals(); }

Result<std::optional<Tree>> TreeRebuilder::next(int most_literals) {
  return search_->next(most_literals);
}

std::vector<LabelledPoint> TreeRebuilder::labelled(const std::vector<Vec3>& points) const {
  return search_->labelled(points);
}

std::size_t TreeRebuilder::refute(const Tree& found, const std::vector<LabelledPoint>& points,
                                  Take take) {
  return search_->refute(found, points, take);
}

}  // namespace hewn
