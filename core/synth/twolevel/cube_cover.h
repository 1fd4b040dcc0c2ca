#pragma once
/// Solids as unions of intersections (disjunctive form) over a few literals.
#include <vector>

#include "core/synth/cover/set_cover.h"
#include "core/synth/simplify/formula.h"

namespace hewn {

/// The rows of a truth table that occur: one per combination of the variables that some cell has.
/// Combinations that no cell has are free (don't-cares).
struct TwoLevelProblem {
  std::vector<int> literals;  ///< variable k is this literal of the cells
  CellColumns rows;           ///< one column per variable
  Column on, off;             ///< rows to hold and to leave out; others are free
};

/// The problem of rebuilding `formula` from its own literals, on the cells of `care`.
TwoLevelProblem two_level_problem(Formula formula, const CellColumns& cells, const Column& care);

/// An intersection of variables and negated variables; `Free` ones do not take part.
struct Cube {
  enum class Side : char { Free, Inside, Outside };
  std::vector<Side> sides;

  int literals() const;
};

/// Rows in the cube.
Column rows_of(const Cube& cube, const TwoLevelProblem& problem);

/// The canonical intersection term of one row: every variable takes part.
Cube cube_of_row(const TwoLevelProblem& problem, std::size_t row);

/// Drops variables while no row of `off` gets in, in the given order of variables: a prime
/// implicant (Friedrich et al. 2020, section 3.1.1).
Cube expanded(Cube cube, const TwoLevelProblem& problem, const std::vector<int>& order);

/// Drops variables greedily, so that as many rows of `wanted` as possible get in.
Cube expanded_towards(Cube cube, const TwoLevelProblem& problem, const Column& wanted);

/// Which rows of `on` each cube holds, as a covering problem; a cube costs its literals.
SetCoverProblem covering_problem(const std::vector<Cube>& cubes, const TwoLevelProblem& problem);

/// The union of the cubes, over the cells' literals. Normalised.
Formula formula_of(const std::vector<Cube>& cubes, const TwoLevelProblem& problem);

}  // namespace hewn
