#include "core/csg/protrude.h"

#include <algorithm>
#include <cmath>

#include "core/csg/flat_end.h"

namespace hewn {
namespace {

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
    const std::vector<FlatEnd> ends = flat_ends(literal);
    if (ends.empty()) return;
    // What is left for this tool to cut: the first operand less the other tools.
    rest_.nodes = tree_.nodes;
    rest_.literals = tree_.literals;
    std::vector<int> others = difference.children;
    others.erase(others.begin() + static_cast<std::ptrdiff_t>(index));
    rest_.root = rest_.add_node(Op::Difference, std::move(others));
    for (const FlatEnd end : ends) extend_end(literal, end);
  }

  void extend_end(Literal& literal, FlatEnd end) const {
    if (!is_flush(literal, end)) return;
    const double most = std::pow(10, std::floor(std::log10(diagonal_ / 10)));
    for (const double share : {1.0, 0.5, 0.2, 0.1, 0.05, 0.02, 0.01}) {
      const double amount = most * share;
      const Literal longer = with_moved_end(literal, end, amount);
      if (!is_valid_flat(longer)) continue;
      if (!is_clear(literal, end, amount)) continue;
      literal = longer;
      return;
    }
  }

  double rest_at(const Literal& s, const Vec3& local) const {
    return rest_.signed_distance(s.to_world(local));
  }

  /// Whether some of the solid lies right under the end and none right above it.
  bool is_flush(const Literal& s, FlatEnd end) const {
    const double touching = kTouching * diagonal_;
    const LocalBox plane = beyond_end(s, end, 0, 0);
    const Vec3 outward = Vec3::Unit(end.axis) * (end.is_upper ? 1 : -1);
    const int u = (end.axis + 1) % 3;
    const int v = (end.axis + 2) % 3;
    for (int i = 0; i < kProbes * kProbes; ++i) {
      const int row = i / kProbes;
      Vec3 p = plane.lo;
      p[u] += plane.size()[u] * (i % kProbes + 0.5) / kProbes;
      p[v] += plane.size()[v] * (row + 0.5) / kProbes;
      if (!is_over_end(s, end, p, 0)) continue;
      if (std::abs(rest_at(s, p)) <= touching && rest_at(s, p - outward * 4 * touching) < 0) {
        return true;
      }
    }
    return false;
  }

  bool is_clear(const Literal& s, FlatEnd end, double amount) const {
    return is_clear(s, end, beyond_end(s, end, kTouching * diagonal_, amount));
  }

  /// Bisects until distances prove each cell empty; cells that only touch the solid count as empty
  /// once they are small.
  bool is_clear(const Literal& s, FlatEnd end, const LocalBox& cell) const {
    const Vec3 size = cell.size();
    const double reach = size.norm() / 2;
    const Vec3 middle = cell.center();
    if (!is_over_end(s, end, middle, reach)) return true;
    const double distance = rest_at(s, middle);
    if (distance >= reach) return true;
    if (distance < -kTouching * diagonal_ && is_over_end(s, end, middle, 0)) return false;
    int axis = 0;
    if (size.maxCoeff(&axis) < diagonal_ / kFinestCell) return true;
    LocalBox lower = cell;
    LocalBox upper = cell;
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
