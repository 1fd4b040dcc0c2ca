#include "core/csg/protrude.h"

#include <algorithm>
#include <cmath>

namespace hewn {
namespace {

/// The flat end of a literal: the local axis it is at right angles to, and its side.
struct FlatEnd {
  int axis = 2;
  bool is_upper = false;
};

/// A box in a literal's local coordinates.
struct Cell {
  Vec3 lo, hi;
  Vec3 center() const { return (lo + hi) / 2; }
};

double radius_at(const Literal& s, double z) {
  return s.radius + (s.top_radius - s.radius) * z / s.height;
}

class Protruder {
 public:
  explicit Protruder(const Tree& tree) : tree_(tree), diagonal_(tree.bounds().diagonal()) {}

  Tree run() {
    if (!std::isfinite(diagonal_) || diagonal_ <= 0) return tree_;
    for (const Node& node : tree_.nodes) {
      if (node.op != Op::Difference) continue;
      for (std::size_t i = 1; i < node.children.size(); ++i) extend_tool(node, i);
    }
    return std::move(tree_);
  }

 private:
  static constexpr double kTouching = 1e-7;   ///< share of the diagonal
  static constexpr double kFinestCell = 128;  ///< cells to a diagonal
  static constexpr int kProbes = 9;           ///< per direction of an end

  void extend_tool(const Node& difference, std::size_t index) {
    const Node& tool = tree_.nodes[difference.children[index]];
    if (tool.op != Op::Literal) return;
    Literal& literal = tree_.literals[tool.literal];
    const bool is_box = literal.kind == SolidKind::Box;
    if (!is_box && literal.kind != SolidKind::Cylinder) return;
    // What is left for this tool to cut: the first operand less the other tools.
    rest_.nodes = tree_.nodes;
    rest_.literals = tree_.literals;
    std::vector<int> others = difference.children;
    others.erase(others.begin() + static_cast<std::ptrdiff_t>(index));
    rest_.root = rest_.add_node(Op::Difference, std::move(others));
    for (int axis = is_box ? 0 : 2; axis < 3; ++axis) {
      for (const bool is_upper : {false, true}) extend_end(literal, {axis, is_upper});
    }
  }

  void extend_end(Literal& literal, FlatEnd end) const {
    if (!is_flush(literal, end)) return;
    const double most = std::pow(10, std::floor(std::log10(diagonal_ / 10)));
    for (const double share : {1.0, 0.5, 0.2, 0.1, 0.05, 0.02, 0.01}) {
      const double amount = most * share;
      const Literal longer = extended(literal, end, amount);
      if (longer.radius < 0 || longer.top_radius < 0) continue;
      if (!is_clear(literal, end, amount)) continue;
      literal = longer;
      return;
    }
  }

  static Literal extended(Literal s, FlatEnd end, double amount) {
    if (s.kind == SolidKind::Box) {
      s.size[end.axis] += amount;
    } else {
      const double slope = (s.top_radius - s.radius) / s.height;
      if (end.is_upper) s.top_radius += slope * amount;
      if (!end.is_upper) s.radius -= slope * amount;
      s.height += amount;
    }
    if (!end.is_upper) s.origin[end.axis] -= amount;
    return s;
  }

  /// The box around what lies between `from` and `to` beyond the end.
  static Cell beyond(const Literal& s, FlatEnd end, double from, double to) {
    Cell cell;
    if (s.kind == SolidKind::Box) {
      cell = {Vec3::Zero(), s.size};
    } else {
      const double r = std::max(s.radius, s.top_radius);
      cell = {Vec3(-r, -r, 0), Vec3(r, r, s.height)};
    }
    const double face = end.is_upper ? cell.hi[end.axis] : cell.lo[end.axis];
    const double sign = end.is_upper ? 1 : -1;
    cell.lo[end.axis] = std::min(face + sign * from, face + sign * to);
    cell.hi[end.axis] = std::max(face + sign * from, face + sign * to);
    return cell;
  }

  static bool is_over_end(const Literal& s, FlatEnd end, const Vec3& local, double margin) {
    if (s.kind == SolidKind::Box) return true;
    const double r = end.is_upper ? std::max(s.top_radius, radius_at(s, local.z()))
                                  : std::max(s.radius, radius_at(s, local.z()));
    return std::hypot(local.x(), local.y()) < r + margin;
  }

  double rest_at(const Literal& s, const Vec3& local) const {
    return rest_.signed_distance(s.to_world(local));
  }

  /// Whether some of the solid lies right under the end and none right above it.
  bool is_flush(const Literal& s, FlatEnd end) const {
    const double touching = kTouching * diagonal_;
    const Cell plane = beyond(s, end, 0, 0);
    const Vec3 outward = Vec3::Unit(end.axis) * (end.is_upper ? 1 : -1);
    const int u = (end.axis + 1) % 3;
    const int v = (end.axis + 2) % 3;
    for (int i = 0; i < kProbes * kProbes; ++i) {
      Vec3 p = plane.lo;
      p[u] += (plane.hi[u] - plane.lo[u]) * (i % kProbes + 0.5) / kProbes;
      p[v] += (plane.hi[v] - plane.lo[v]) * (i / kProbes + 0.5) / kProbes;
      if (!is_over_end(s, end, p, 0)) continue;
      if (std::abs(rest_at(s, p)) <= touching && rest_at(s, p - outward * 4 * touching) < 0) {
        return true;
      }
    }
    return false;
  }

  bool is_clear(const Literal& s, FlatEnd end, double amount) const {
    return is_clear(s, end, beyond(s, end, kTouching * diagonal_, amount));
  }

  /// Bisects until distances prove each cell empty; cells that only touch the solid count as empty
  /// once they are small.
  bool is_clear(const Literal& s, FlatEnd end, const Cell& cell) const {
    const Vec3 size = cell.hi - cell.lo;
    const double reach = size.norm() / 2;
    const Vec3 middle = cell.center();
    if (!is_over_end(s, end, middle, reach)) return true;
    const double distance = rest_at(s, middle);
    if (distance >= reach) return true;
    if (distance < -kTouching * diagonal_ && is_over_end(s, end, middle, 0)) return false;
    int axis = 0;
    if (size.maxCoeff(&axis) < diagonal_ / kFinestCell) return true;
    Cell lower = cell;
    Cell upper = cell;
    lower.hi[axis] = upper.lo[axis] = middle[axis];
    return is_clear(s, end, lower) && is_clear(s, end, upper);
  }

  Tree tree_;
  Tree rest_;
  double diagonal_;
};

}  // namespace

Tree with_protruding_tools(const Tree& tree) { return Protruder(tree).run(); }

}  // namespace hewn
