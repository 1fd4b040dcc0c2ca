#pragma once
/// The normal equations of a fit, summed over its data. Data take turns on eight lanes, which a
/// processor's vector units work on side by side and a GPU's threads one each.
#include "core/compute/kernels/fit_state.h"

namespace hewn {

inline constexpr int kFitLanes = 8;

/// The sums of some lanes in a row.
template <SurfaceKind K, int kLanes>
struct LaneSums {
  static constexpr int kSize = kParameters<K>;
  static constexpr int kPairs = kSize * (kSize + 1) / 2;
  using Row = double[kSize][kLanes];

  double hessian[kPairs][kLanes] = {};
  double slope[kSize][kLanes] = {};
  double cost[kLanes] = {};
  double trial_cost[kLanes] = {};

  /// Adds weight * row^T row and weight * residual * row.
  HEWN_HD void add(const Row& row, const double (&residual)[kLanes],
                   const double (&weight)[kLanes]) {
    int pair = 0;
    for (int i = 0; i < kSize; ++i) {
      double factor[kLanes];
      for (int l = 0; l < kLanes; ++l) factor[l] = weight[l] * row[i][l];
      for (int j = 0; j <= i; ++j, ++pair) {
        for (int l = 0; l < kLanes; ++l) hessian[pair][l] += factor[l] * row[j][l];
      }
      for (int l = 0; l < kLanes; ++l) slope[i][l] += factor[l] * residual[l];
    }
  }

  /// One lane after the other.
  HEWN_HD FitEquations total() const {
    FitEquations sum;
    for (int l = 0; l < kLanes; ++l) {
      for (int pair = 0; pair < kPairs; ++pair) sum.hessian[pair] += hessian[pair][l];
      for (int i = 0; i < kSize; ++i) sum.slope[i] += slope[i][l];
      sum.cost += cost[l];
      sum.trial_cost += trial_cost[l];
    }
    return sum;
  }
};

/// A vector for each lane, component by component, as vector units take them.
template <int kLanes>
struct LaneVectors {
  double x[kLanes], y[kLanes], z[kLanes];

  HEWN_HD PlainVec operator[](int l) const { return {x[l], y[l], z[l]}; }
  HEWN_HD void set(int l, const PlainVec& v) {
    x[l] = v.x;
    y[l] = v.y;
    z[l] = v.z;
  }
};

/// Those from `from` on; lanes beyond the `count` that there are get the first one.
template <int kLanes>
HEWN_HD LaneVectors<kLanes> load_lanes(const PlainVec* from, int count) {
  LaneVectors<kLanes> lanes;
  for (int l = 0; l < kLanes; ++l) lanes.set(l, from[l < count ? l : 0]);
  return lanes;
}

/// Of a squared distance where distances count by their absolute value beyond `scale`.
HEWN_HD double robust_weight(double distance, double scale) {
  return scale / larger_of(fabs(distance), scale);
}

/// Adds what points contribute to the equations at the trial, from lane `lane` on. Lanes that run
/// out of points take part with weight 0.
template <SurfaceKind K, int kLanes>
HEWN_HD void add_points(const FitTarget& target, const FitState& state, const PlainVec* points,
                        int count, int lane, LaneSums<K, kLanes>& sums) {
  const RowFrame frame = row_frame(state.trial);
  const SurfaceForm best = state.best;
  const double scale = target.robust_scale;
  for (int i = lane; i < count; i += kFitLanes) {
    const LaneVectors<kLanes> p = load_lanes<kLanes>(points + i, count - i);
    typename LaneSums<K, kLanes>::Row row;
    double residual[kLanes], weight[kLanes], trial_weight[kLanes];
    for (int l = 0; l < kLanes; ++l) {
      double own[kParameters<K>];
      residual[l] = distance_row<K>(frame, p[l], own);
      for (int j = 0; j < kParameters<K>; ++j) row[j][l] = own[j];
    }
    for (int l = 0; l < kLanes; ++l) weight[l] = trial_weight[l] = i + l < count ? 1.0 : 0.0;
    if (scale > 0) {
      for (int l = 0; l < kLanes; ++l) {
        weight[l] *= robust_weight(residual[l], scale);
        trial_weight[l] *= robust_weight(signed_distance<K>(best, p.x[l], p.y[l], p.z[l]), scale);
      }
    }
    sums.add(row, residual, weight);
    for (int l = 0; l < kLanes; ++l) {
      const double square = residual[l] * residual[l];
      sums.cost[l] += weight[l] * square;
      sums.trial_cost[l] += trial_weight[l] * square;
    }
  }
}

/// The same for unit normals of either sign at `points`.
template <SurfaceKind K, int kLanes>
HEWN_HD void add_normals(const FitTarget& target, const FitState& state, const PlainVec* points,
                         const PlainVec* normals, int count, int lane, LaneSums<K, kLanes>& sums) {
  constexpr int kSize = kParameters<K>;
  const RowFrame frame = row_frame(state.trial);
  for (int i = lane; i < count; i += kFitLanes) {
    const LaneVectors<kLanes> places = load_lanes<kLanes>(points + i, count - i);
    const LaneVectors<kLanes> measured = load_lanes<kLanes>(normals + i, count - i);
    LaneVectors<kLanes> normal, residual, d, outward;
    double height[kLanes], radial[kLanes], weight[kLanes];
    for (int l = 0; l < kLanes; ++l) {
      const LocalPoint p = localise(frame, places[l]);
      const PlainVec n = normal_at<K>(frame, p);
      normal.set(l, n);
      residual.set(l, n - measured[l] * (dot(n, measured[l]) < 0 ? -1.0 : 1.0));
      d.set(l, p.d);
      outward.set(l, p.outward);
      height[l] = p.height;
      radial[l] = p.radial;
    }
    typename LaneSums<K, kLanes>::Row x, y, z;
    for (int j = 0; j < kSize; ++j) {
      const Variation v = variation<K>(frame, j);
      for (int l = 0; l < kLanes; ++l) {
        const LocalPoint p{d[l], height[l], radial[l], outward[l]};
        const PlainVec change = normal_change<K>(frame, p, normal[l], v);
        x[j][l] = change.x;
        y[j][l] = change.y;
        z[j][l] = change.z;
      }
    }
    for (int l = 0; l < kLanes; ++l) weight[l] = i + l < count ? target.normal_weight2 : 0.0;
    sums.add(x, residual.x, weight);
    sums.add(y, residual.y, weight);
    sums.add(z, residual.z, weight);
    for (int l = 0; l < kLanes; ++l) {
      const double cost = weight[l] * dot(residual[l], residual[l]);
      sums.cost[l] += cost;
      sums.trial_cost[l] += cost;
    }
  }
}

}  // namespace hewn
