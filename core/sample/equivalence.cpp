#include "core/sample/equivalence.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <memory>

#include "core/base/rng.h"
#include "core/compute/parallel.h"
#include "core/csg/literal_set.h"
#include "core/csg/tree_ray.h"
#include "core/sample/octant.h"

namespace hewn {
namespace {

/// Variables of a truth table in one word: bit i of variable k is bit k of i.
constexpr std::array<std::uint64_t, 6> kVariables = {0xAAAAAAAAAAAAAAAAull, 0xCCCCCCCCCCCCCCCCull,
                                                     0xF0F0F0F0F0F0F0F0ull, 0xFF00FF00FF00FF00ull,
                                                     0xFFFF0000FFFF0000ull, 0xFFFFFFFF00000000ull};
constexpr std::size_t kMostVariables = kVariables.size();

constexpr double kUncertain = 1e-9;      ///< share of the scale
constexpr double kUncertainMesh = 3e-7;  ///< share of a polyhedron's diagonal
constexpr std::size_t kMostExamples = 1000;
constexpr std::size_t kMostMeasured = 30;  ///< in each of the 64 parts of the box
constexpr int kDeepest = 16;
/// In one part; more would add nothing but time.
constexpr std::size_t kEnoughDifferent = 100;
constexpr std::size_t kParts = 64;
constexpr int kSplitDepth = 2;  ///< levels above the parallel loop

/// A tree in postfix order over words: one per literal. Operations whose right operand is a literal
/// take it from where it is.
class WordProgram {
 public:
  WordProgram(const Tree& tree, const std::vector<int>& literal_of) {
    if (!tree.is_empty()) append(tree, tree.root, literal_of);
    if (steps_.empty()) push(-1);
  }

  std::uint64_t run(const std::vector<std::uint64_t>& literals,
                    std::vector<std::uint64_t>& stack) const {
    if (stack.size() < deepest_ + 1) stack.resize(deepest_ + 1);
    std::uint64_t* top = stack.data();  // one beyond the last value
    for (const Step& step : steps_) {
      const std::uint64_t right = step.literal >= 0
                                      ? literals[static_cast<std::size_t>(step.literal)]
                                  : step.pops_right ? *--top
                                                    : 0;
      switch (step.op) {
        case Op::Literal:
          *top++ = right;
          break;
        case Op::Complement:
          top[-1] = ~top[-1];
          break;
        case Op::Union:
          top[-1] |= right;
          break;
        case Op::Intersection:
          top[-1] &= right;
          break;
        case Op::Difference:
          top[-1] &= ~right;
          break;
      }
    }
    return top[-1];
  }

 private:
  struct Step {
    Op op = Op::Literal;  ///< `Literal` pushes
    int literal = -1;     ///< right operand; -1: see below
    bool pops_right = false;
  };

  void push(int literal) {
    steps_.push_back({Op::Literal, literal, false});
    deepest_ = std::max(deepest_, ++depth_);
  }

  void append(const Tree& tree, int index, const std::vector<int>& literal_of) {
    const Node& node = tree.nodes[static_cast<std::size_t>(index)];
    if (node.op == Op::Literal) {
      push(literal_of[static_cast<std::size_t>(node.literal)]);
      return;
    }
    if (node.children.empty()) push(-1);
    for (std::size_t i = 0; i < node.children.size(); ++i) {
      append(tree, node.children[i], literal_of);
      if (i > 0) join(node.op);
    }
    if (node.op == Op::Complement) steps_.push_back({Op::Complement, -1, false});
  }

  /// With the value on top as the right operand.
  void join(Op op) {
    --depth_;
    if (steps_.back().op == Op::Literal) {
      steps_.back().op = op;
    } else {
      steps_.push_back({op, -1, true});
    }
  }

  std::vector<Step> steps_;
  std::size_t depth_ = 0, deepest_ = 0;
};

/// A box of the octree with the literals whose surfaces may pass through it.
struct Cell {
  Box3 box;
  std::vector<int> open;
  std::vector<std::uint64_t> values;  ///< of all literals: 0 or all bits; of open ones 0
  int depth = 0;
};

class TreeComparison {
 public:
  TreeComparison(const Tree& a, const Tree& b, const EquivalenceOptions& options,
                 const RunContext& run)
      : options_(options), run_(run), rays_(a) {
    LiteralSet set;
    const std::vector<int> of_a = set.add(a);
    const std::vector<int> of_b = set.add(b);
    literals_ = set.literals();
    program_a_ = std::make_unique<WordProgram>(a, of_a);
    program_b_ = std::make_unique<WordProgram>(b, of_b);
    for (const Literal& s : literals_) {
      const Box3& box = bounds_.emplace_back(s).box;
      if (box.is_empty()) continue;
      box_.extend(box.lo);
      box_.extend(box.hi);
    }
    const Box3 solid = a.bounds();
    scale_ = std::isfinite(solid.diagonal()) && solid.diagonal() > 0 ? solid.diagonal()
                                                                     : box_.diagonal();
    if (options.scale > 0) scale_ = options.scale;
  }

  Result<Equivalence> compare() {
    Equivalence total;
    if (box_.is_empty()) {
      std::vector<std::uint64_t> none;
      const bool differs = (program_a_->run({}, none) ^ program_b_->run({}, none)) != 0;
      total.different = differs ? 1 : 0;
      total.points = 1;
      total.proved_share = 1;
      return total;
    }
    const Vec3 margin = Vec3::Constant(0.01 * box_.diagonal());
    box_.lo -= margin;
    box_.hi += margin;
    const double finest = options_.smallest_cell * scale_;
    depth_ = static_cast<int>(std::ceil(std::log2(box_.size().maxCoeff() / finest)));
    depth_ = std::clamp(depth_, kSplitDepth, kDeepest);
    std::vector<Cell> cells = first_cells();
    std::vector<Equivalence> parts(cells.size());
    for_each_index(run_.threads, cells.size(), [&](std::size_t i) {
      Worker worker{*this, parts[i], Rng(run_.seed + 31 * options_.stream, i), {}, 0, 0};
      worker.visit(cells[i]);
    });
    if (run_.is_cancelled()) return RunContext::cancelled();
    for (const Equivalence& p : parts) merge(total, p);
    total.proved_share /= volume(box_);
    total.smallest_cell = box_.size().maxCoeff() / std::pow(2.0, depth_);
    return total;
  }

 private:
  static double volume(const Box3& box) { return box.size().prod(); }

  static void merge(Equivalence& total, const Equivalence& part) {
    total.proved_share += part.proved_share;
    total.proved_cells += part.proved_cells;
    total.open_cells += part.open_cells;
    total.points += part.points;
    total.different += part.different;
    total.tolerated += part.tolerated;
    total.largest_distance = std::max(total.largest_distance, part.largest_distance);
    for (const Vec3& p : part.examples) {
      if (total.examples.size() < kMostExamples) total.examples.push_back(p);
    }
  }

  std::vector<Cell> first_cells() const {
    Cell root;
    root.box = box_;
    root.values.assign(literals_.size(), 0);
    for (std::size_t k = 0; k < literals_.size(); ++k) root.open.push_back(static_cast<int>(k));
    std::vector<Cell> cells = {std::move(root)};
    for (int level = 0; level < kSplitDepth; ++level) {
      std::vector<Cell> next;
      for (const Cell& cell : cells) {
        for (int k = 0; k < 8; ++k) next.push_back(octant(cell, k));
      }
      cells = std::move(next);
    }
    return cells;
  }

  Cell octant(const Cell& parent, int octant) const {
    Cell cell;
    cell.box = octant_of(parent.box, octant);
    cell.depth = parent.depth + 1;
    cell.values = parent.values;
    const double radius = cell.box.diagonal() / 2 * (1 + 1e-9) + kUncertain * scale_;
    const Vec3 center = cell.box.center();
    for (const int literal : parent.open) {
      const double reach = radius + mesh_margin(literal);
      const auto k = static_cast<std::size_t>(literal);
      const double d = distance_within(literals_[k], bounds_[k], center, reach);
      if (std::abs(d) <= reach) {
        cell.open.push_back(literal);
      } else {
        cell.values[k] = d < 0 ? ~std::uint64_t{0} : 0;
      }
    }
    return cell;
  }

  double mesh_margin(int literal) const {
    const Literal& s = literals_[static_cast<std::size_t>(literal)];
    return s.polyhedron ? kUncertainMesh * s.polyhedron->diagonal() : 0;
  }

  /// Walks one part of the octree.
  struct Worker {
    const TreeComparison& all;
    Equivalence& out;
    Rng rng;
    std::vector<std::uint64_t> stack;
    std::size_t visited;
    double owed;  ///< points that smaller cells were too small for
    TreeRayScratch ray_scratch = {};

    bool is_proved(Cell& cell) {
      if (cell.open.size() > kMostVariables) return false;
      for (std::size_t i = 0; i < cell.open.size(); ++i) {
        cell.values[static_cast<std::size_t>(cell.open[i])] = kVariables[i];
      }
      const bool same =
          all.program_a_->run(cell.values, stack) == all.program_b_->run(cell.values, stack);
      for (const int literal : cell.open) cell.values[static_cast<std::size_t>(literal)] = 0;
      return same;
    }

    void visit(Cell& cell) {
      if (all.run_.is_cancelled() || out.different >= kEnoughDifferent) return;
      ++visited;
      const bool proved = is_proved(cell);
      if (!proved && cell.depth < all.depth_ && visited < all.options_.most_cells / kParts) {
        for (int k = 0; k < 8; ++k) {
          Cell child = all.octant(cell, k);
          visit(child);
        }
        return;
      }
      if (proved) {
        ++out.proved_cells;
        out.proved_share += volume(cell.box);
      } else {
        ++out.open_cells;
        test_points(cell, all.options_.points_per_open_cell);
      }
      owed += static_cast<double>(all.options_.points) * volume(cell.box) / volume(all.box_);
      while (owed >= 1 && !all.run_.is_cancelled()) {
        const int count = static_cast<int>(std::min(owed, 64.0));
        owed -= count;
        test_points(cell, count);
      }
    }

    /// Random points of the cell, at most 64, one in each bit.
    void test_points(Cell& cell, int count) {
      Vec3 points[64];
      for (const int literal : cell.open) cell.values[static_cast<std::size_t>(literal)] = 0;
      std::uint64_t certain = 0;
      for (int i = 0; i < count; ++i) {
        for (int k = 0; k < 3; ++k) points[i][k] = rng.uniform(cell.box.lo[k], cell.box.hi[k]);
        if (is_certain(points[i], std::uint64_t{1} << i, cell)) certain |= std::uint64_t{1} << i;
      }
      out.points += static_cast<std::size_t>(std::popcount(certain));
      const std::uint64_t in_a = all.program_a_->run(cell.values, stack);
      const std::uint64_t in_b = all.program_b_->run(cell.values, stack);
      for (const int literal : cell.open) cell.values[static_cast<std::size_t>(literal)] = 0;
      for (std::uint64_t wrong = (in_a ^ in_b) & certain; wrong != 0; wrong &= wrong - 1) {
        judge(points[std::countr_zero(wrong)]);
      }
    }

    /// Sets the point's bit in the values of the literals that hold it.
    bool is_certain(const Vec3& p, std::uint64_t bit, Cell& cell) const {
      for (const int literal : cell.open) {
        const auto k = static_cast<std::size_t>(literal);
        const double margin = kUncertain * all.scale_ + all.mesh_margin(literal);
        const double d = distance_within(all.literals_[k], all.bounds_[k], p, margin);
        if (std::abs(d) < margin) return false;
        if (d < 0) cell.values[k] |= bit;
      }
      return true;
    }

    /// A point inside one solid only.
    void judge(const Vec3& p) {
      const double allowed = all.options_.allowed_distance;
      const bool is_measured = out.different + out.tolerated < kMostMeasured;
      const double d = distance_along_rays(all.rays_, p, is_measured ? 0 : allowed, ray_scratch);
      if (is_measured || d <= allowed) out.largest_distance = std::max(out.largest_distance, d);
      if (d <= allowed) {
        ++out.tolerated;
        return;
      }
      ++out.different;
      if (out.examples.size() < kMostExamples) out.examples.push_back(p);
    }
  };

  const EquivalenceOptions& options_;
  const RunContext& run_;
  TreeRays rays_;
  std::vector<Literal> literals_;
  std::vector<LiteralBounds> bounds_;  ///< of each literal
  std::unique_ptr<WordProgram> program_a_, program_b_;
  Box3 box_;
  double scale_ = 1;
  int depth_ = kSplitDepth;
};

/// To the faces, the edges and the corners of a cube: the first ones mostly meet something first.
const std::array<Vec3, 26> kDirections = [] {
  std::array<Vec3, 26> all;
  std::size_t count = 0;
  for (int sides = 1; sides <= 3; ++sides) {
    for (int k = 0; k < 27; ++k) {
      const Vec3 d(k % 3 - 1, k / 3 % 3 - 1, k / 9 - 1);
      if (d.squaredNorm() == sides) all[count++] = d.normalized();
    }
  }
  return all;
}();

/// How much larger a ball is so that rounding leaves no surface out that it touches.
constexpr double kBeyondRounding = 1 + 1e-9;

}  // namespace

double distance_along_rays(const TreeRays& rays, const Vec3& p, double enough,
                           TreeRayScratch& scratch) {
  bool is_nearby = enough > 0;
  if (is_nearby && rays.look_around(p, enough, scratch) != Nearby::Surface) return kInfinity;
  double nearest = kInfinity;
  double reach = is_nearby ? enough : kInfinity;
  for (const Vec3& d : kDirections) {
    // Only what is nearer than all so far still counts.
    if (enough <= 0 && 2 * nearest < reach) {
      is_nearby = true;
      reach = kBeyondRounding * nearest;
      rays.look_around(p, reach, scratch);
    }
    const auto& stretches = is_nearby ? rays.cast_nearby(p, d, scratch) : rays.cast(p, d, scratch);
    if (stretches.empty()) continue;
    const TreeInterval& first = stretches.front();
    const double t = first.enter.t > 0 ? first.enter.t : first.leave.t;
    nearest = std::min(nearest, t);
    if (nearest <= enough) break;
  }
  return nearest;
}

Result<Equivalence> compare_trees(const Tree& a, const Tree& b, const EquivalenceOptions& options,
                                  const RunContext& run) {
  return TreeComparison(a, b, options, run).compare();
}

}  // namespace hewn
