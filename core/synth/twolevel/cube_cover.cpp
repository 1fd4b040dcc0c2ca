#include "core/synth/twolevel/cube_cover.h"

#include <algorithm>
#include <map>
#include <utility>

namespace hewn {
namespace {

void collect_literals(const Formula& f, std::vector<int>& out) {
  if (f.kind == Formula::Kind::Leaf) out.push_back(f.literal);
  for (const Formula& child : f.children) collect_literals(child, out);
}

void keep_side(Column& rows, const Column& variable, Cube::Side side) {
  if (side == Cube::Side::Free) return;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    rows[i] &= side == Cube::Side::Inside ? variable[i] : ~variable[i];
  }
}

int count(const Column& a, const Column& mask) {
  int n = 0;
  for (std::size_t i = 0; i < a.size(); ++i) n += std::popcount(a[i] & mask[i]);
  return n;
}

}  // namespace

TwoLevelProblem two_level_problem(Formula formula, const CellColumns& cells, const Column& care) {
  const Column value = evaluate(formula, cells);
  std::vector<int> literals;
  collect_literals(formula, literals);
  std::sort(literals.begin(), literals.end());
  literals.erase(std::unique(literals.begin(), literals.end()), literals.end());
  // Cells with the same sides of these literals are one row.
  std::map<std::vector<char>, bool> rows;
  for_each_bit(care, [&](std::size_t c) {
    std::vector<char> sides;
    sides.reserve(literals.size());
    for (const int k : literals) sides.push_back(test_bit(cells.column(k).data(), c) ? 1 : 0);
    rows.emplace(std::move(sides), test_bit(value.data(), c));
  });
  std::vector<Column> columns(literals.size(), Column(padded_words(rows.size()), 0));
  Column on(padded_words(rows.size()), 0);
  Column off = on;
  std::size_t row = 0;
  for (const auto& [sides, is_on] : rows) {
    for (std::size_t k = 0; k < sides.size(); ++k) {
      if (sides[k]) set_bit(columns[k].data(), row);
    }
    set_bit((is_on ? on : off).data(), row);
    ++row;
  }
  return {std::move(literals), CellColumns(rows.size(), std::move(columns)), std::move(on),
          std::move(off)};
}

int Cube::literals() const {
  return static_cast<int>(
      std::count_if(sides.begin(), sides.end(), [](Side s) { return s != Side::Free; }));
}

Column rows_of(const Cube& cube, const TwoLevelProblem& problem) {
  Column rows = problem.rows.all();
  for (std::size_t k = 0; k < cube.sides.size(); ++k) {
    keep_side(rows, problem.rows.column(static_cast<int>(k)), cube.sides[k]);
  }
  return rows;
}

Cube cube_of_row(const TwoLevelProblem& problem, std::size_t row) {
  Cube cube;
  for (int k = 0; k < problem.rows.literals(); ++k) {
    const bool is_inside = test_bit(problem.rows.column(k).data(), row);
    cube.sides.push_back(is_inside ? Cube::Side::Inside : Cube::Side::Outside);
  }
  return cube;
}

Cube expanded(Cube cube, const TwoLevelProblem& problem, const std::vector<int>& order) {
  for (const int k : order) {
    const Cube::Side side = cube.sides[static_cast<std::size_t>(k)];
    if (side == Cube::Side::Free) continue;
    cube.sides[static_cast<std::size_t>(k)] = Cube::Side::Free;
    if (intersects(rows_of(cube, problem), problem.off)) {
      cube.sides[static_cast<std::size_t>(k)] = side;
    }
  }
  return cube;
}

Cube expanded_towards(Cube cube, const TwoLevelProblem& problem, const Column& wanted) {
  while (true) {
    int best = -1;
    int most = -1;
    for (std::size_t k = 0; k < cube.sides.size(); ++k) {
      const Cube::Side side = cube.sides[k];
      if (side == Cube::Side::Free) continue;
      cube.sides[k] = Cube::Side::Free;
      const Column rows = rows_of(cube, problem);
      cube.sides[k] = side;
      if (intersects(rows, problem.off)) continue;
      const int gain = count(rows, wanted);
      if (gain <= most) continue;
      most = gain;
      best = static_cast<int>(k);
    }
    if (best < 0) return cube;
    cube.sides[static_cast<std::size_t>(best)] = Cube::Side::Free;
  }
}

SetCoverProblem covering_problem(const std::vector<Cube>& cubes, const TwoLevelProblem& problem) {
  SetCoverProblem cover;
  std::vector<std::size_t> rows;
  for_each_bit(problem.on, [&](std::size_t r) { rows.push_back(r); });
  cover.elements = rows.size();
  for (const Cube& cube : cubes) {
    const Column held = rows_of(cube, problem);
    Column set(padded_words(rows.size()), 0);
    for (std::size_t e = 0; e < rows.size(); ++e) {
      if (test_bit(held.data(), rows[e])) set_bit(set.data(), e);
    }
    cover.sets.push_back(std::move(set));
    cover.costs.push_back(std::max(1, cube.literals()));
  }
  return cover;
}

Formula formula_of(const std::vector<Cube>& cubes, const TwoLevelProblem& problem) {
  std::vector<Formula> terms;
  for (const Cube& cube : cubes) {
    std::vector<Formula> sides;
    for (std::size_t k = 0; k < cube.sides.size(); ++k) {
      if (cube.sides[k] == Cube::Side::Free) continue;
      sides.push_back(Formula::leaf(problem.literals[k], cube.sides[k] == Cube::Side::Outside));
    }
    terms.push_back(sides.empty() ? Formula::constant(true)
                                  : Formula::join(Formula::Kind::And, std::move(sides)));
  }
  if (terms.empty()) return Formula::constant(false);
  return normalised(Formula::join(Formula::Kind::Or, std::move(terms)));
}

}  // namespace hewn
