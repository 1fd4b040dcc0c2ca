#include "core/synth/simplify/derived_literals.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>
#include <unordered_set>
#include <utility>

namespace hewn {
namespace {

constexpr double kAligned = 1e-9;
constexpr int kRounds = 3;

struct Extent {
  Vec3 lo, hi;
};

/// The box in the rotated coordinates of `frame` when it is aligned with it; turns between the two
/// are made exact, so that coincident faces stay coincident.
std::optional<Extent> extent_in(const Literal& box, const Mat3& frame) {
  if (box.kind != SolidKind::Box || box.stretch) return std::nullopt;
  const Mat3 turn = frame.transpose() * box.rotation;
  Mat3 exact = Mat3::Zero();
  for (int column = 0; column < 3; ++column) {
    int row = 0;
    turn.col(column).cwiseAbs().maxCoeff(&row);
    exact(row, column) = turn(row, column) < 0 ? -1 : 1;
  }
  if ((turn - exact).cwiseAbs().maxCoeff() > kAligned) return std::nullopt;
  const Vec3 a = exact * box.origin;
  const Vec3 b = exact * (box.origin + box.size);
  return Extent{a.cwiseMin(b), a.cwiseMax(b)};
}

using Span = std::pair<double, double>;

/// Where along the axis of `tube` the box stands, when it covers the tube's whole width.
std::optional<Span> box_span_over(const Literal& box, const Literal& tube) {
  const Vec3 axis = box.rotation.transpose() * tube.rotation.col(2);
  int along = 0;
  axis.cwiseAbs().maxCoeff(&along);
  const double sign = axis[along] < 0 ? -1 : 1;
  if ((axis - sign * Vec3::Unit(along)).cwiseAbs().maxCoeff() > kAligned) return std::nullopt;
  const Vec3 foot = box.to_local(tube.to_world(Vec3::Zero()));
  const double radius = std::max(tube.radius, tube.top_radius);
  for (int k = 0; k < 3; ++k) {
    if (k != along && (foot[k] - radius < 0 || foot[k] + radius > box.size[k])) {
      return std::nullopt;
    }
  }
  // In the tube's rotated z coordinate.
  const double a = sign * box.origin[along];
  const double b = sign * (box.origin[along] + box.size[along]);
  return Span(std::min(a, b), std::max(a, b));
}

/// The same of a tube with a parallel axis.
std::optional<Span> tube_span_over(const Literal& other, const Literal& tube) {
  const Vec3 axis = tube.rotation.transpose() * other.rotation.col(2);
  const double sign = axis.z() < 0 ? -1 : 1;
  if ((axis - sign * Vec3::UnitZ()).cwiseAbs().maxCoeff() > kAligned) return std::nullopt;
  const Vec3 foot = tube.rotation == other.rotation
                        ? other.origin  // exact, so that coincident faces stay coincident
                        : tube.rotation.transpose() * (other.rotation * other.origin);
  const double radius = std::max(tube.radius, tube.top_radius);
  const double reach = (foot - tube.origin).head<2>().norm() + radius;
  if (std::min(other.radius, other.top_radius) < reach - kAligned * radius) return std::nullopt;
  const double a = foot.z();
  const double b = a + sign * other.height;
  return Span(std::min(a, b), std::max(a, b));
}

std::optional<Span> span_over(const Literal& tool, const Literal& tube) {
  if (tool.stretch) return std::nullopt;
  if (tool.kind == SolidKind::Box) return box_span_over(tool, tube);
  if (tool.kind == SolidKind::Cylinder) return tube_span_over(tool, tube);
  return std::nullopt;
}

/// The interval that is left of [lo, hi]; nothing when it is all, none or two pieces.
std::optional<Span> clipped(double lo, double hi, double from, double to, bool is_cut) {
  if (to <= lo || from >= hi) return std::nullopt;
  if (!is_cut) {
    if (from <= lo && to >= hi) return std::nullopt;
    return Span(std::max(lo, from), std::min(hi, to));
  }
  if (from <= lo && to < hi) return Span(to, hi);
  if (to >= hi && from > lo) return Span(lo, from);
  return std::nullopt;
}

std::optional<Literal> clip_box(const Literal& s, const Literal& tool, bool is_cut) {
  const auto other = extent_in(tool, s.rotation);
  if (!other) return std::nullopt;
  Vec3 lo = s.origin;
  Vec3 hi = s.origin + s.size;
  if (!is_cut) {
    const Vec3 from = lo.cwiseMax(other->lo);
    const Vec3 to = hi.cwiseMin(other->hi);
    if ((from.array() >= to.array()).any()) return std::nullopt;
    lo = from;
    hi = to;
  } else {
    // One axis may be cut short; the tool has to cover the other two.
    int open = -1;
    for (int k = 0; k < 3; ++k) {
      if (other->lo[k] <= lo[k] && other->hi[k] >= hi[k]) continue;
      if (open >= 0) return std::nullopt;
      open = k;
    }
    if (open < 0) return std::nullopt;
    const auto left = clipped(lo[open], hi[open], other->lo[open], other->hi[open], true);
    if (!left) return std::nullopt;
    lo[open] = left->first;
    hi[open] = left->second;
  }
  Literal made = s;
  made.origin = lo;
  made.size = hi - lo;
  return made;
}

std::optional<Literal> clip_tube(const Literal& s, const Literal& tool, bool is_cut) {
  const auto span = span_over(tool, s);
  if (!span) return std::nullopt;
  const double base = s.origin.z();
  const auto left = clipped(base, base + s.height, span->first, span->second, is_cut);
  if (!left || !(left->second > left->first)) return std::nullopt;
  const auto radius_at = [&](double z) {
    return s.radius + (s.top_radius - s.radius) * (z - base) / s.height;
  };
  Literal made = s;
  made.origin.z() = left->first;
  made.height = left->second - left->first;
  made.radius = radius_at(left->first);
  made.top_radius = s.radius == s.top_radius ? s.radius : radius_at(left->second);
  return made;
}

std::optional<Literal> clip(const Literal& s, const Literal& tool, bool is_cut) {
  if (s.stretch) return std::nullopt;
  if (s.kind == SolidKind::Box) return clip_box(s, tool, is_cut);
  if (s.kind == SolidKind::Cylinder) return clip_tube(s, tool, is_cut);
  return std::nullopt;
}

/// Keeps the cells on one side of a literal.
void keep_side(Column& cells, const Column& literal, bool is_negated) {
  const Word flip = is_negated ? ~Word{0} : Word{0};
  for (std::size_t i = 0; i < cells.size(); ++i) cells[i] &= literal[i] ^ flip;
}

class Derivation {
 public:
  Derivation(const std::vector<Literal>& literals, const CellColumns& cells, const Column& wanted,
             std::size_t most)
      : literals_(literals), cells_(cells), wanted_(wanted), most_(most) {
    for (int k = 0; k < cells.literals(); ++k) known_.insert(hash_words(cells.column(k)));
    known_.insert(hash_words(cells.empty()));
  }

  std::vector<DerivedLiteral> run() {
    std::vector<DerivedLiteral> from;
    for (std::size_t k = 0; k < literals_.size(); ++k) {
      from.push_back({literals_[k], {{static_cast<int>(k), false}}});
    }
    std::vector<Candidate> all;
    for (int round = 0; round < kRounds && !from.empty(); ++round) {
      std::vector<Candidate> made;
      for (const DerivedLiteral& s : from) derive_from(s, made);
      keep_best(made);
      from.clear();
      for (const Candidate& c : made) from.push_back(c.derived);
      all.insert(all.end(), made.begin(), made.end());
    }
    keep_best(all);
    std::vector<DerivedLiteral> out;
    out.reserve(all.size());
    for (Candidate& c : all) out.push_back(std::move(c.derived));
    return out;
  }

 private:
  struct Candidate {
    DerivedLiteral derived;
    int score = 0;
  };

  void derive_from(const DerivedLiteral& s, std::vector<Candidate>& made) {
    const Column whole = column_of(s, cells_);
    for (std::size_t k = 0; k < literals_.size(); ++k) {
      for (const bool is_cut : {false, true}) {
        const auto solid = clip(s.solid, literals_[k], is_cut);
        if (!solid) continue;
        DerivedLiteral derived{*solid, s.sides};
        const DerivedLiteral::Side side{static_cast<int>(k), is_cut};
        const auto at =
            std::lower_bound(derived.sides.begin(), derived.sides.end(), side,
                             [](const auto& a, const auto& b) { return a.literal < b.literal; });
        if (at != derived.sides.end() && at->literal == side.literal) continue;
        derived.sides.insert(at, side);
        clipped_ = whole;
        keep_side(clipped_, cells_.column(side.literal), side.is_negated);
        if (!known_.insert(hash_words(clipped_)).second) continue;
        made.push_back({std::move(derived), score(clipped_)});
      }
    }
  }

  /// Pure ones count their cells; of the others a few may still be good to cut with.
  int score(const Column& column) const {
    const BitKernels& bits = bit_kernels();
    const int on = bits.count_and(column.data(), wanted_.data(), column.size());
    const int off = bits.count(column.data(), column.size()) - on;
    if (on == 0) return off;
    return off == 0 ? 2 * on : 0;
  }

  void keep_best(std::vector<Candidate>& candidates) const {
    std::stable_sort(candidates.begin(), candidates.end(),
                     [](const Candidate& a, const Candidate& b) { return a.score > b.score; });
    if (candidates.size() > most_) candidates.resize(most_);
  }

  const std::vector<Literal>& literals_;
  const CellColumns& cells_;
  const Column& wanted_;
  std::size_t most_;
  std::unordered_set<std::uint64_t> known_;  ///< hashes of columns; never iterated
  Column clipped_;                           ///< scratch memory
};

}  // namespace

Column column_of(const DerivedLiteral& derived, const CellColumns& cells) {
  Column column = cells.all();
  for (const DerivedLiteral::Side& side : derived.sides) {
    keep_side(column, cells.column(side.literal), side.is_negated);
  }
  return column;
}

std::vector<DerivedLiteral> derive_literals(const std::vector<Literal>& literals,
                                            const CellColumns& cells, const Column& wanted,
                                            std::size_t most) {
  return Derivation(literals, cells, wanted, most).run();
}

}  // namespace hewn
