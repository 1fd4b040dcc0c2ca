#include "core/csg/boundary/patch_cutter.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "core/csg/boundary/partial_answer.h"
#include "core/csg/boundary/same_surface.h"

namespace hewn {
namespace {

// Shares of the diagonal.
constexpr double kCoarsest = 0.1;   ///< larger ones are cut, even when an edge seems straight
constexpr double kStraight = 5e-4;  ///< what an edge may be off a line that stands for it
constexpr double kEdge = 1e-5;      ///< to which edges are found
constexpr double kBeside = 2e-5;    ///< a point so far from a surface is on one side of it

/// A rectangle of a patch's unit square.
struct Cell {
  double u0 = 0, u1 = 1, v0 = 0, v1 = 1;
  Vec2 middle() const { return {(u0 + u1) / 2, (v0 + v1) / 2}; }
  Vec2 corner(int k) const { return {k == 1 || k == 2 ? u1 : u0, k >= 2 ? v1 : v0}; }
  /// A hair's breadth within the corner: patches often end right where other surfaces do.
  Vec2 near_corner(int k) const { return corner(k) + 1e-3 * (middle() - corner(k)); }
};

/// What is at a point of a patch.
struct Probe {
  bool is_boundary = false;  ///< of the solid
  bool is_outward = true;    ///< the literal's normal leads out of the solid
  bool is_anothers = false;  ///< another literal whose surface coincides here shows the face
};

/// What lies on both sides of a cell, as far as it is known.
struct Sides {
  Known behind = Known::Open;  ///< on the literal's inner side
  Known ahead = Known::Open;
  std::vector<int> flush;    ///< other literals with a face along the cell
  bool is_anothers = false;  ///< the first of them shows the face
};

/// Where an edge crosses a side of a cell.
struct Crossing {
  Vec2 uv = Vec2::Zero();
  bool goes_on = false;  ///< the surface does, as another literal's
};

/// The visible part of a cell.
struct CellCut {
  std::vector<Vec2> polygon;
  std::vector<Crossing> crossings;  ///< two for each edge
  Vec2 beyond = Vec2::Zero();       ///< a corner behind an edge
  bool is_outward = true;
};

/// Cuts one patch.
class PatchCutter {
 public:
  PatchCutter(const BoundaryModel& model, const BoundaryPatch& patch, PatchPart& out)
      : model_(model),
        patch_(patch),
        literal_(model.literal_of(patch)),
        inside_(model.tree),
        out_(out) {}

  void cut() {
    find_rivals();
    std::vector<int> others;
    for (int l = 0; l < static_cast<int>(model_.bounds.size()); ++l) {
      if (l != patch_.literal) others.push_back(l);
    }
    visit({}, others);
  }

 private:
  double distance(int l, const Vec3& p, double reach) const { return model_.distance(l, p, reach); }
  PatchPoint at(const Vec2& uv) const { return point_on(literal_, patch_, uv.x(), uv.y()); }
  double same() const { return model_.same(); }
  double beside() const { return kBeside * model_.diagonal; }

  /// Where faces of several literals coincide, the first shows them; which come before the patch's?
  void find_rivals() {
    rivals_.assign(model_.bounds.size(), false);
    for (const BoundaryPatch& other : model_.patches) {
      if (other.literal >= patch_.literal) break;  // patches come in the literals' order
      const auto l = static_cast<std::size_t>(other.literal);
      if (!rivals_[l]) rivals_[l] = on_same_surface(model_, patch_, other);
    }
  }

  /// Whether a rival's face may cover a part of the cell; `along`: those that cover it all.
  bool may_be_anothers(const std::vector<int>& open, const std::vector<int>& along) const {
    return std::any_of(open.begin(), open.end(), [&](int l) {
      return rivals_[static_cast<std::size_t>(l)] &&
             std::find(along.begin(), along.end(), l) == along.end();
    });
  }

  /// `open`: the literals whose surfaces may cross the cell; of others it is known what they hold.
  void visit(const Cell& cell, const std::vector<int>& open) {
    const double reach = radius(cell) + beside();
    const Vec3 middle = at(cell.middle()).position;
    std::vector<int> still_open;
    std::vector<int> coincident;
    for (const int l : open) {
      const double d = distance(l, middle, reach);
      if (std::abs(d) > reach) {
        inside_.set(l, known(d < 0));
        continue;
      }
      inside_.set(l, Known::Open);
      still_open.push_back(l);
      if (std::abs(d) < same() && runs_along(cell, l)) coincident.push_back(l);
    }
    inside_.set(patch_.literal, Known::Open);
    const std::size_t before = inside_.settle();
    if (inside_.answer() == Known::Open) resolve(cell, still_open, coincident);
    inside_.forget(before);
  }

  /// Where the solid may depend on the patch's literal.
  void resolve(const Cell& cell, const std::vector<int>& open, const std::vector<int>& coincident) {
    const Sides sides =
        look_at_sides(at(cell.middle()), coincident, [this] { return inside_.answer(); });
    if (sides.is_anothers) return;
    if (sides.behind != Known::Open && sides.ahead != Known::Open) {
      if (sides.behind == sides.ahead) return;
      if (!may_be_anothers(open, coincident)) {
        note_flush(sides.flush);
        emit_whole(cell, sides.behind == Known::Yes);
        return;
      }
    }
    forget_answers(open.size());
    const bool is_within_facet = !has_columns(cell) && !has_rows(cell);
    if (is_within_facet && radius(cell) < model_.finest) {
      emit_cut(cut_cell(cell, open));
      return;
    }
    if (is_within_facet && radius(cell) < kCoarsest * model_.diagonal && is_one_convex(open)) {
      const CellCut cut = cut_cell(cell, open);
      if (is_straight(cut, open)) {
        emit_cut(cut);
        return;
      }
    }
    visit_halves(cell, open);
  }

  bool is_one_convex(const std::vector<int>& open) const {
    if (open.size() != 1) return false;
    const SolidKind kind = model_.tree.literals[static_cast<std::size_t>(open.front())].kind;
    return kind != SolidKind::Torus && kind != SolidKind::Polyhedron;
  }

  void visit_halves(const Cell& cell, const std::vector<int>& open) {
    const bool is_small = radius(cell) < model_.finest;
    if (is_small ? has_columns(cell) : u_length(cell) > v_length(cell)) {
      visit({cell.u0, cell.middle().x(), cell.v0, cell.v1}, open);
      visit({cell.middle().x(), cell.u1, cell.v0, cell.v1}, open);
    } else {
      visit({cell.u0, cell.u1, cell.v0, cell.middle().y()}, open);
      visit({cell.u0, cell.u1, cell.middle().y(), cell.v1}, open);
    }
  }

  double u_length(const Cell& cell) const { return patch_.u_length * (cell.u1 - cell.u0); }
  double v_length(const Cell& cell) const { return patch_.v_length * (cell.v1 - cell.v0); }
  /// No point of the cell is further from its middle.
  double radius(const Cell& cell) const {
    const double u = u_length(cell);
    const double v = v_length(cell);
    return (patch_.is_orthogonal ? std::hypot(u, v) : u + v) / 2;
  }
  bool has_columns(const Cell& cell) const { return (cell.u1 - cell.u0) * patch_.u_facets > 1; }
  bool has_rows(const Cell& cell) const { return (cell.v1 - cell.v0) * patch_.v_facets > 1; }

  /// On both sides of a point of the patch, along which the coincident literals' surfaces run, as
  /// far as `answer` tells.
  template <class Answer>
  Sides look_at_sides(const PatchPoint& on, const std::vector<int>& coincident,
                      const Answer& answer) {
    const auto beside_patch = [&](double offset) {
      for (const int l : coincident) {
        inside_.set(l, known(distance(l, on.position + offset * on.normal, 0) < 0));
      }
      inside_.set(patch_.literal, known(offset < 0));
      return answer();
    };
    Sides out;
    out.behind = beside_patch(-beside());
    behind_.clear();
    for (const int l : coincident) behind_.push_back(inside_.of(l));
    out.ahead = beside_patch(beside());
    for (std::size_t i = 0; i < coincident.size(); ++i) {
      if (behind_[i] == inside_.of(coincident[i])) continue;
      out.flush.push_back(coincident[i]);
      out.is_anothers |= coincident[i] < patch_.literal;
    }
    return out;
  }

  /// Whether the literal's surface runs along the whole cell: through a grid of its points. The
  /// corners would not do: of a whole cylinder's side they lie on one line, and any plane through
  /// the axis holds them and the middle.
  bool runs_along(const Cell& cell, int literal) const {
    constexpr int kSteps = 4;
    for (int i = 0; i <= kSteps; ++i) {
      for (int j = 0; j <= kSteps; ++j) {
        const Vec3 p = at({std::lerp(cell.u0, cell.u1, double(i) / kSteps),
                           std::lerp(cell.v0, cell.v1, double(j) / kSteps)})
                           .position;
        if (std::abs(distance(literal, p, same())) >= same()) return false;
      }
    }
    return true;
  }

  Probe probe(const Vec2& uv, const std::vector<int>& open) {
    const PatchPoint point = at(uv);
    tied_.clear();
    for (const int l : open) {
      const double d = distance(l, point.position, same());
      inside_.set(l, known(d < 0));
      if (std::abs(d) < same()) tied_.push_back(l);
    }
    const Sides sides = look_at_sides(point, tied_, [&] { return answer_for(open); });
    Probe out;
    out.is_boundary = sides.behind != sides.ahead;
    out.is_outward = sides.behind == Known::Yes;
    out.is_anothers = sides.is_anothers;
    if (out.is_boundary) note_flush(sides.flush);
    return out;
  }

  /// The answer for what the literals of the cell hold; each case is worked out once.
  Known answer_for(const std::vector<int>& open) {
    if (remembered_.empty()) return inside_.answer();
    std::size_t number = inside_.of(patch_.literal) == Known::Yes ? 1 : 0;
    for (const int l : open) number = 2 * number + (inside_.of(l) == Known::Yes ? 1 : 0);
    Known& answer = remembered_[number];
    if (answer == Known::Open) answer = inside_.answer();
    return answer;
  }

  void forget_answers(std::size_t open) {
    constexpr std::size_t kMostLiterals = 8;
    remembered_.assign(open > kMostLiterals ? 0 : std::size_t{2} << open, Known::Open);
  }

  bool is_mine(const Probe& p) const { return p.is_boundary && !p.is_anothers; }

  void emit_whole(const Cell& cell, bool is_outward) {
    const int columns = facets_across(cell.u1 - cell.u0, patch_.u_facets);
    const int rows = facets_across(cell.v1 - cell.v0, patch_.v_facets);
    for (int i = 0; i < columns; ++i) {
      for (int j = 0; j < rows; ++j) {
        const Cell facet{std::lerp(cell.u0, cell.u1, double(i) / columns),
                         std::lerp(cell.u0, cell.u1, double(i + 1) / columns),
                         std::lerp(cell.v0, cell.v1, double(j) / rows),
                         std::lerp(cell.v0, cell.v1, double(j + 1) / rows)};
        emit_polygon({facet.corner(0), facet.corner(1), facet.corner(2), facet.corner(3)},
                     is_outward);
      }
    }
  }

  static int facets_across(double share, int facets) {
    return std::max(1, static_cast<int>(std::lround(share * facets)));
  }

  /// The visible part of a cell that no edge enters twice.
  CellCut cut_cell(const Cell& cell, const std::vector<int>& open) {
    CellCut out;
    std::array<Probe, 4> corners;
    for (int k = 0; k < 4; ++k) {
      corners[k] = probe(cell.near_corner(k), open);
      if (is_mine(corners[k])) out.is_outward = corners[k].is_outward;
    }
    for (int k = 0; k < 4; ++k) {
      const int next = (k + 1) % 4;
      const bool is_in = is_mine(corners[k]);
      if (is_in) out.polygon.push_back(cell.corner(k));
      if (is_in == is_mine(corners[next])) continue;
      const int from = is_in ? k : next;
      const int to = is_in ? next : k;
      out.polygon.push_back(crossing(cell.near_corner(from), cell.near_corner(to), open));
      // What lies beyond is no edge where the same face goes on as another literal's.
      out.crossings.push_back({out.polygon.back(), corners[to].is_boundary});
      out.beyond = cell.corner(to);
    }
    return out;
  }

  /// Between a point of the visible part and one beyond.
  Vec2 crossing(Vec2 mine, Vec2 other, const std::vector<int>& open) {
    const double length =
        std::hypot(patch_.u_length * (mine - other).x(), patch_.v_length * (mine - other).y());
    const int halvings =
        static_cast<int>(std::ceil(std::log2(length / (kEdge * model_.diagonal) + 1)));
    for (int i = 0; i < halvings; ++i) {
      const Vec2 middle = (mine + other) / 2;
      (is_mine(probe(middle, open)) ? mine : other) = middle;
    }
    return mine;
  }

  /// Whether one straight edge divides the cell. Requires: one convex literal makes the edge.
  bool is_straight(const CellCut& cut, const std::vector<int>& open) {
    if (cut.crossings.size() != 2) return false;
    const Vec2 from = cut.crossings[0].uv;
    const Vec2 along = cut.crossings[1].uv - from;
    // Across, in lengths of the model; the patch's axes are taken to be at right angles.
    const Vec2 scale(patch_.u_length, patch_.v_length);
    Vec2 across = Vec2(-along.y() * scale.y(), along.x() * scale.x());
    if (across.norm() <= 0) return false;
    across = across.normalized() * (kStraight * model_.diagonal);
    across = across.cwiseQuotient(scale);
    if (across.dot(cut.beyond - from) < 0) across = -across;
    for (const double t : {0.25, 0.5, 0.75}) {
      const Vec2 on = from + t * along;
      if (!is_mine(probe(on - across, open)) || is_mine(probe(on + across, open))) return false;
    }
    return true;
  }

  void emit_cut(const CellCut& cut) {
    if (cut.polygon.empty()) return;
    for (std::size_t i = 0; i + 1 < cut.crossings.size(); i += 2) {
      if (cut.crossings[i].goes_on && cut.crossings[i + 1].goes_on) continue;
      const Vec2& from = cut.crossings[i].uv;
      const Vec2& to = cut.crossings[i + 1].uv;
      add_line(from, to, (from + to) / 2);
    }
    emit_polygon(cut.polygon, cut.is_outward);
  }

  void emit_polygon(const std::vector<Vec2>& polygon, bool is_outward) {
    Vec2 middle = Vec2::Zero();
    for (const Vec2& uv : polygon) middle += uv / static_cast<double>(polygon.size());
    std::vector<BoundaryCorner> corners;
    for (const Vec2& uv : polygon) {
      const Vec3 normal = at(uv).normal;
      corners.push_back({shown_at(uv, middle), is_outward ? normal : Vec3(-normal), 0});
    }
    for (std::size_t i = 1; i + 1 < corners.size(); ++i) {
      emit_triangle(corners[0], corners[i], corners[i + 1]);
    }
    for (std::size_t i = 0; i < polygon.size(); ++i) {
      emit_border(polygon[i], polygon[(i + 1) % polygon.size()], middle);
    }
  }

  /// On the facet that stands for the true surface, the one that holds `within`.
  Vec3 shown_at(const Vec2& uv, const Vec2& within) const {
    if (patch_.is_flat && patch_.u_facets == 1 && patch_.v_facets == 1) return at(uv).position;
    const double u = std::floor(within.x() * patch_.u_facets);
    const double v = std::floor(within.y() * patch_.v_facets);
    const auto facet_corner = [&](double du, double dv) {
      return at({(u + du) / patch_.u_facets, (v + dv) / patch_.v_facets}).position;
    };
    const double s = uv.x() * patch_.u_facets - u;
    const double t = uv.y() * patch_.v_facets - v;
    return (1 - t) * ((1 - s) * facet_corner(0, 0) + s * facet_corner(1, 0)) +
           t * ((1 - s) * facet_corner(0, 1) + s * facet_corner(1, 1));
  }

  void emit_triangle(const BoundaryCorner& a, const BoundaryCorner& b, const BoundaryCorner& c) {
    const Vec3 across = (b.position - a.position).cross(c.position - a.position);
    if (across.norm() <= 0) return;
    out_.area += across.norm() / 2;
    const bool is_turned = across.dot(a.normal + b.normal + c.normal) < 0;
    out_.corners.insert(out_.corners.end(), {a, is_turned ? c : b, is_turned ? b : c});
  }

  /// A line where the patch ends, unless the surface goes on as another literal's.
  void emit_border(const Vec2& from, const Vec2& to, const Vec2& middle) {
    for (int k = 0; k < 4; ++k) {
      const int axis = k / 2;
      const double end = k % 2;
      if (!patch_.ends[k] || from[axis] != end || to[axis] != end) continue;
      Vec2 on_border = (from + to) / 2;
      const PatchPoint point = at(on_border);
      on_border[axis] = middle[axis];
      const Vec3 outward = point.position - at(on_border).position;
      if (outward.norm() <= 0 || goes_on(point, outward.normalized())) continue;
      add_line(from, to, middle);
    }
  }

  bool goes_on(const PatchPoint& point, const Vec3& outward) {
    const Vec3 beyond = point.position + 2 * beside() * outward;
    const Vec3 step = beside() * point.normal;
    if (model_.solid.contains(beyond + step) == model_.solid.contains(beyond - step)) return false;
    note_flush_at(beyond);
    return true;
  }

  /// The literals that carry a flat patch on.
  void note_flush_at(const Vec3& beyond) {
    if (!patch_.is_flat) return;
    for (int l = 0; l < static_cast<int>(model_.bounds.size()); ++l) {
      if (l != patch_.literal && std::abs(distance(l, beyond, same())) < same()) note_flush(l);
    }
  }

  void note_flush(const std::vector<int>& literals) {
    if (!patch_.is_flat) return;
    for (const int l : literals) note_flush(l);
  }

  void note_flush(int literal) {
    const bool is_known =
        std::find(out_.flush.begin(), out_.flush.end(), literal) != out_.flush.end();
    if (!is_known) out_.flush.push_back(literal);
  }

  void add_line(const Vec2& from, const Vec2& to, const Vec2& within) {
    out_.lines.push_back({shown_at(from, within), shown_at(to, within), 0});
  }

  const BoundaryModel& model_;
  const BoundaryPatch& patch_;
  const Literal& literal_;
  PartialAnswer inside_;
  PatchPart& out_;
  std::vector<Known> remembered_;  ///< answers in the cell, by the bits of its open literals
  std::vector<bool> rivals_;       ///< by literal
  std::vector<int> tied_;
  std::vector<Known> behind_;
};

}  // namespace

PatchPart cut_patch(const BoundaryModel& model, const BoundaryPatch& patch) {
  PatchPart out;
  PatchCutter(model, patch, out).cut();
  return out;
}

}  // namespace hewn
