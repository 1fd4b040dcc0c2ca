#pragma once
/// Gauss-Newton with Levenberg damping, as steps that a loop on the host or a device goes through.
#include "core/compute/kernels/fit_rows.h"

namespace hewn {

/// What a fit is to reach, the same in all its rounds. Its data are centred and of size one.
struct FitTarget {
  SurfaceKind kind = SurfaceKind::Plane;
  int max_iterations = 8;
  double least_decrease = 1e-4;  ///< a step that lowers the cost by a smaller share is the last
  double robust_scale = 0;       ///< > 0: absolute instead of squared distances beyond it
  double normal_weight2 = 0;     ///< of a squared deviation of normals against a squared distance
  bool keeps_axis = false;
};

/// The normal equations at a surface; only those of its kind's parameters are in use.
struct FitEquations {
  double hessian[kMostParameters * (kMostParameters + 1) / 2] = {};  ///< lower half, row by row
  double slope[kMostParameters] = {};
  double cost = 0;
  /// The same deviations with the weights of the surface that the trial is compared with.
  double trial_cost = 0;

  template <int kSize>
  HEWN_HD void add(const FitEquations& other) {
    for (int i = 0; i < kSize * (kSize + 1) / 2; ++i) hessian[i] += other.hessian[i];
    for (int i = 0; i < kSize; ++i) slope[i] += other.slope[i];
    cost += other.cost;
    trial_cost += other.trial_cost;
  }
};

/// How far a fit has come.
struct FitState {
  SurfaceForm best, trial;
  FitEquations at_best;
  double damping = 1e-6;
  int iterations = -1;  ///< -1: the first trial is the guess itself
  int attempts = 0;     ///< in vain, since the last better surface
  bool is_done = false;
};

HEWN_HD FitState state_at(const SurfaceForm& guess) {
  FitState state;
  state.best = state.trial = guess;
  return state;
}

/// Takes the axis' tilt out of the equations.
template <SurfaceKind K>
HEWN_HD void lock_tilt(FitEquations& e) {
  if constexpr (kFirstTilt<K> >= 0) {
    constexpr int kTilt = kFirstTilt<K>;
    for (int i = 0; i < kParameters<K>; ++i) {
      for (int j = 0; j <= i; ++j) {
        const bool is_tilt = i == kTilt || i == kTilt + 1 || j == kTilt || j == kTilt + 1;
        if (is_tilt) e.hessian[i * (i + 1) / 2 + j] = i == j ? 1 : 0;
      }
    }
    e.slope[kTilt] = e.slope[kTilt + 1] = 0;
  }
}

/// The damped step: solves (H + damping diag H) x = -slope. False where the matrix is not positive
/// definite, as with data that do not determine the surface.
template <int kSize>
HEWN_HD bool solve_damped(const FitEquations& e, double damping, double* x) {
  double lower[kSize][kSize];
  double pivots[kSize];
  double highest = 0;
  for (int i = 0; i < kSize; ++i) highest = larger_of(highest, e.hessian[i * (i + 1) / 2 + i]);
  for (int i = 0; i < kSize; ++i) {
    for (int j = 0; j <= i; ++j) {
      double value = e.hessian[i * (i + 1) / 2 + j];
      if (i == j) value = value * (1 + damping) + 1e-14 * highest;
      for (int k = 0; k < j; ++k) value -= lower[i][k] * lower[j][k] * pivots[k];
      if (i == j) {
        pivots[i] = value;
      } else {
        lower[i][j] = value / pivots[j];
      }
    }
    if (!(pivots[i] > 0)) return false;
  }
  for (int i = 0; i < kSize; ++i) {
    x[i] = -e.slope[i];
    for (int k = 0; k < i; ++k) x[i] -= lower[i][k] * x[k];
  }
  for (int i = kSize - 1; i >= 0; --i) {
    x[i] /= pivots[i];
    for (int k = i + 1; k < kSize; ++k) x[i] -= lower[k][i] * x[k];
  }
  return true;
}

/// Looks for a step from the best surface, and damps harder for as long as there is none.
template <SurfaceKind K>
HEWN_HD void propose(FitState& state) {
  constexpr int kMostAttempts = 6;
  for (; state.attempts < kMostAttempts; ++state.attempts) {
    double step[kParameters<K>];
    if (solve_damped<kParameters<K>>(state.at_best, state.damping, step)) {
      state.trial = stepped<K>(state.best, step);
      return;
    }
    state.damping = larger_of(state.damping * 10, 1e-4);
  }
  state.is_done = true;
}

/// Judges the trial by its equations, the sums over all data, and proposes the next one.
template <SurfaceKind K>
HEWN_HD void advance(const FitTarget& target, const FitEquations& at_trial, FitState& state) {
  constexpr double kNoCost = 1e-32;
  const double before = state.at_best.cost;
  const bool is_guess = state.iterations < 0;
  if (is_guess || at_trial.trial_cost < before) {
    state.best = state.trial;
    state.at_best = at_trial;
    if (target.keeps_axis) lock_tilt<K>(state.at_best);
    if (!is_guess) state.damping = larger_of(state.damping / 10, 1e-12);
    state.attempts = 0;
    ++state.iterations;
    const bool has_stalled =
        !is_guess && before - at_trial.trial_cost < target.least_decrease * before;
    // A cost that is no number, from data or a guess out of range, is the end as well.
    if (has_stalled || state.iterations >= target.max_iterations ||
        !(state.at_best.cost > kNoCost)) {
      state.is_done = true;
      return;
    }
  } else {
    state.damping = larger_of(state.damping * 10, 1e-4);
    ++state.attempts;
  }
  propose<K>(state);
}

}  // namespace hewn
