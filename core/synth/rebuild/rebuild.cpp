#include "core/synth/rebuild/rebuild.h"

#include <algorithm>
#include <cmath>
#include <unordered_set>
#include <utility>

#include "core/csg/tree_inside.h"
#include "core/sample/cells.h"
#include "core/sample/frame.h"
#include "core/synth/decompose/gather.h"
#include "core/synth/decompose/lower.h"
#include "core/synth/decompose/relax.h"
#include "core/synth/rebuild/boundary.h"
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
      : inside_(tree), given_(points), scale_(scale), options_(options), run_(run), rays_(tree) {}

  Result<std::optional<Tree>> next(int most_literals) {
    if (round_ == 0 && (!has_boundary() || !fill_table())) return nothing();
    if (run_.is_cancelled()) return RunContext::cancelled();
    const bool has_list = search_round(most_literals);
    if (run_.is_cancelled()) return RunContext::cancelled();
    ++round_;
    if (!has_list) return nothing();
    return std::optional<Tree>(lowered());
  }

  int least_literals() {
    if (options_.depth > 0 || !has_surfaces()) return 0;
    std::vector<char> is_sure(known_.all.halfspaces.size(), 0);
    for (const BoundaryHit& h : boundary_hits(rays_, known_, given_, kFewLines, run_)) {
      char& sure = is_sure[static_cast<std::size_t>(h.halfspace)];
      if (!sure && changes_label(h)) sure = 1;
    }
    std::vector<Halfspace> bounding;
    for (std::size_t k = 0; k < is_sure.size(); ++k) {
      if (is_sure[k]) bounding.push_back(known_.all.halfspaces[k]);
    }
    return hewn::least_literals(bounding);
  }

  std::vector<LabelledPoint> labelled(const std::vector<Vec3>& points) const {
    std::vector<LabelledPoint> out;
    out.reserve(points.size());
    for (const Vec3& p : points) out.push_back({p, inside_.contains(p)});
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
  const Tree& tree() const { return rays_.tree(); }

  /// Finds the surfaces of all literals, once. False when some have none, and without an end.
  bool has_surfaces() {
    if (!has_looked_) {
      has_looked_ = true;
      auto known = tree().is_empty() || !std::isfinite(tree().bounds().diagonal())
                       ? std::nullopt
                       : surfaces_of(tree().literals, scale_);
      if (known) known_ = std::move(*known);
    }
    return !known_.all.halfspaces.empty();
  }

  /// Finds those among them that bound the solid, once. False when there are none to search with.
  bool has_boundary() {
    if (!has_surfaces()) return false;
    if (is_used_.empty()) {
      is_used_.assign(known_.all.halfspaces.size(), 0);
      find_boundary();
    }
    return !surfaces_.halfspaces.empty();
  }

  /// The surfaces on which the solid changes even beyond the depth that is free.
  void find_boundary() {
    hits_ = boundary_hits(rays_, known_, given_, kManyLines, run_);
    std::vector<BoundaryHit> kept;
    surfaces_.directions = known_.all.directions;
    for (const BoundaryHit& h : hits_) {
      geometry_.vertices.push_back(h.position);
      if (options_.depth > 0 && !is_deep(h)) continue;
      kept.push_back(h);
      use(h.halfspace);
      surfaces_.halfspaces[index_of(h.halfspace)].area += 1;
    }
    hits_ = std::move(kept);
    geometry_ = make_mesh(std::move(geometry_.vertices), {});
    find_extent();
  }

  /// Where faces of operands touch, rounding can leave a gap that a line sees.
  bool changes_label(const BoundaryHit& h) const {
    const Vec3 step = 1e-7 * scale_ * h.normal;
    return inside_.contains(h.position - step) && !inside_.contains(h.position + step);
  }

  /// Whether the label changes for good there.
  bool is_deep(const BoundaryHit& h) const {
    const Vec3 step = 1.5 * options_.depth * h.normal;
    return inside_.contains(h.position - step) && !inside_.contains(h.position + step) &&
           !is_free(rays_, h.position - step, options_.depth) &&
           !is_free(rays_, h.position + step, options_.depth);
  }

  std::size_t index_of(int halfspace) const {
    return static_cast<std::size_t>(is_used_[static_cast<std::size_t>(halfspace)] - 1);
  }

  void use(int halfspace) {
    int& used = is_used_[static_cast<std::size_t>(halfspace)];
    if (used > 0) return;
    surfaces_.halfspaces.push_back(known_.all.halfspaces[static_cast<std::size_t>(halfspace)]);
    used = static_cast<int>(surfaces_.halfspaces.size());
  }

  /// The frame's box ends at planes where the solid does, else a little further out.
  void find_extent() {
    frame_ = find_frame(geometry_, {}, surfaces_);
    for (int c = 0; c < 3; ++c) {
      const Vec3 axis = frame_.rotation.col(c);
      double lo = frame_.box.lo[c] - 0.01 * scale_;
      double hi = frame_.box.hi[c] + 0.01 * scale_;
      for (const Halfspace& h : surfaces_.halfspaces) {
        const Surface& s = h.surface;
        if (s.kind != SurfaceKind::Plane || s.axis.cross(axis).norm() > 1e-9) continue;
        const double offset = s.axis.dot(axis) > 0 ? s.offset : -s.offset;
        if (std::abs(offset - frame_.box.lo[c]) < 1e-7 * scale_) lo = offset;
        if (std::abs(offset - frame_.box.hi[c]) < 1e-7 * scale_) hi = offset;
      }
      frame_.box.lo[c] = lo;
      frame_.box.hi[c] = hi;
    }
    std::vector<Vec3> corners;
    for (int k = 0; k < 8; ++k) {
      const Vec3 pick((k & 1) != 0, (k & 2) != 0, (k & 4) != 0);
      corners.push_back(frame_.to_space(frame_.box.lo + pick.cwiseProduct(frame_.box.size())));
    }
    geometry_ = make_mesh(std::move(corners), {});
  }

  bool is_known_cell(const Vec3& p) {
    signature_.assign(table_.stride, 0);
    for (std::size_t k = 0; k < surfaces_.halfspaces.size(); ++k) {
      if (surfaces_.halfspaces[k].surface.signed_distance(p) < 0) set_bit(signature_.data(), k);
    }
    return !known_cells_.insert(hash_words(signature_)).second;
  }

  bool is_certain(const Vec3& p) const {
    const auto is_far = [&](const Halfspace& h) {
      return std::abs(h.surface.signed_distance(p)) > kUncertain * scale_;
    };
    return std::all_of(known_.all.halfspaces.begin(), known_.all.halfspaces.end(), is_far);
  }

  bool is_usable(const Vec3& p) const {
    return is_certain(p) && !is_free(rays_, p, kSureDepth * options_.depth);
  }

  /// Further points of the wall or the gap that `p` lies in.
  void take_feature_of(const Vec3& p, std::size_t stream, std::vector<Vec3>& points) const {
    Rng rng(run_.seed, 0xFEA7 + stream);
    for (const Vec3& beside : points_beside(rays_, p, kPointsBeside, scale_, rng)) {
      if (is_usable(beside)) points.push_back(beside);
    }
  }

  void add_points(const std::vector<LabelledPoint>& points) {
    append_points(table_, surfaces_.halfspaces, points, run_);
  }

  bool fill_table() {
    if (surfaces_.halfspaces.size() > kMostSurfaces) return false;
    table_.halfspaces = surfaces_.halfspaces.size();
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
        const double extra = margin * frame_.box.size()[c];
        local[c] = rng.uniform(frame_.box.lo[c] - extra, frame_.box.hi[c] + extra);
      }
      const Vec3 p = frame_.to_space(local);
      if (is_usable(p)) points.push_back(p);
    }
    add_pairs(points);
    add_points(labelled(points));
    return true;
  }

  void add_pairs(std::vector<Vec3>& points) {
    std::vector<int> count(surfaces_.halfspaces.size(), 0);
    for (std::size_t i = 0; i < hits_.size() && !run_.is_cancelled(); ++i) {
      const BoundaryHit& h = hits_[i];
      int& pairs = count[index_of(h.halfspace)];
      if (pairs >= kPairsPerSurface) continue;
      const double reach = options_.depth > 0 ? 1.5 * options_.depth : kPairReach[i % 3] * scale_;
      const Vec3 inside = h.position - reach * h.normal;
      const Vec3 outside = h.position + reach * h.normal;
      if (!inside_.contains(inside) || inside_.contains(outside)) continue;
      if (!is_usable(inside) || !is_usable(outside)) continue;
      ++pairs;
      const int first = static_cast<int>(points.size());
      points.push_back(inside);
      points.push_back(outside);
      table_.pairs.push_back({first, first + 1, static_cast<int>(index_of(h.halfspace))});
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
      const int best = best_separating(mixed);
      if (best < 0) return;
      use(best);
      append_halfspaces(table_, surfaces_.halfspaces, run_);
    }
  }

  /// The unused surface that leaves the fewest points in the minority of their cell.
  int best_separating(const std::vector<std::vector<int>>& mixed) const {
    int best = -1;
    long best_gain = 0;
    for (std::size_t h = 0; h < is_used_.size(); ++h) {
      if (is_used_[h] > 0) continue;
      const Surface& s = known_.all.halfspaces[h].surface;
      long gain = 0;
      for (const std::vector<int>& points : mixed) {
        int count[2][2] = {{0, 0}, {0, 0}};
        for (const int i : points) {
          const auto k = static_cast<std::size_t>(i);
          ++count[s.signed_distance(table_.points[k]) < 0 ? 1 : 0][table_.is_inside[k] ? 1 : 0];
        }
        const auto minority = [](const int(&c)[2]) { return std::min(c[0], c[1]); };
        const int all = std::min(count[0][0] + count[1][0], count[0][1] + count[1][1]);
        gain += 4L * (all - minority(count[0]) - minority(count[1]));
        // A surface that only divides cells may still help the next one.
        if (count[0][0] + count[0][1] > 0 && count[1][0] + count[1][1] > 0) gain += 1;
      }
      if (gain <= best_gain) continue;
      best_gain = gain;
      best = static_cast<int>(h);
    }
    return best;
  }

  bool search_round(int most_literals) {
    separate();
    known_cells_.clear();
    for (const int i : cells_.first_point) {
      const auto row = static_cast<std::size_t>(i);
      known_cells_.insert(hash_words({table_.signature(row), table_.stride}));
    }
    columns_.emplace(table_, cells_, ColumnTable::Labels::Exact);
    combinability_.emplace(surfaces_);
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
      if (frame_.box.contains(frame_.to_local(table_.points[i]))) {
        reaches_in[static_cast<std::size_t>(kept)] = 1;
      }
    }
    for (std::size_t c = 0; c < reaches_in.size(); ++c) {
      if (!reaches_in[c]) care[c >> 6] &= ~(Word{1} << (c & 63));
    }
  }

  Tree lowered() {
    const SearchSpace& space = spaces_[found_.is_clipped() ? 1 : 0];
    relax_list(space, surfaces_, found_.list);
    gather_runs(space, found_.list);
    LoweringOptions options;
    Tree tree = lower_list(found_.list, surfaces_, geometry_, {}, frame_, options);
    if (!found_.is_clipped()) return tree;
    for (std::size_t i = 0; i < table_.size(); ++i) {
      if (table_.is_inside[i] || !tree.contains(table_.points[i])) continue;
      options.clip = true;
      return lower_list(found_.list, surfaces_, geometry_, {}, frame_, options);
    }
    return tree;
  }

  TreeInside inside_;
  const std::vector<Vec3>& given_;
  double scale_;
  const RebuildOptions& options_;
  const RunContext& run_;
  TreeRays rays_;
  TreeSurfaces known_;
  std::vector<int> is_used_;  ///< of `known_`: index into `surfaces_` plus one, else 0
  SurfaceSet surfaces_;
  std::vector<BoundaryHit> hits_;
  Mesh geometry_;  ///< vertices only: the extent of the solid
  Frame frame_;
  SampleTable table_;
  Cells cells_;
  std::unordered_set<std::uint64_t> known_cells_;  ///< hashes of signatures; never iterated
  std::vector<Word> signature_;
  std::optional<ColumnTable> columns_;
  std::optional<Combinability> combinability_;
  std::array<SearchSpace, 2> spaces_;  ///< everywhere; inside the frame's box only
  FoundList found_;
  bool has_looked_ = false;
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
