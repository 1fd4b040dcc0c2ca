#pragma once
/// Gauss-Newton fits of many surfaces at once, in rounds: the sums over the data, part by part, and
/// then the steps.
#include "core/compute/kernels/fit_sums.h"

namespace hewn {

/// Some data of a fit. The sums over parts are added in their order, so that every device and a
/// loop on the host round alike.
struct FitPart {
  static constexpr int kLongest = 128;
  std::int32_t fit = 0;
  std::int32_t first = 0;  ///< point
  std::int32_t count = 0;
  std::int32_t first_normal = -1;  ///< -1: distances count, else deviations from these normals
};

/// Where the data of a fit lie in the list of parts.
struct FitParts {
  std::int32_t first = 0, count = 0;
};

/// The sums over a part's data, those of some lanes from `lane` on.
template <SurfaceKind K, int kLanes>
HEWN_HD FitEquations equations_of(const FitTarget& target, const FitState& state,
                                  const FitPart& part, int lane, const PlainVec* points,
                                  const PlainVec* normals) {
  LaneSums<K, kLanes> sums;
  if (part.first_normal < 0) {
    add_points<K>(target, state, points + part.first, part.count, lane, sums);
  } else {
    add_normals<K>(target, state, points + part.first, normals + part.first_normal, part.count,
                   lane, sums);
  }
  return sums.total();
}

/// How many sums there are of each part.
template <class Grain>
inline constexpr int kSumsOfPart = kFitLanes / Grain::kFitLanes;

/// What both kernels read.
struct FitTable {
  const FitTarget* targets = nullptr;
  FitState* states = nullptr;
  const FitPart* parts = nullptr;
  FitEquations* sums = nullptr;  ///< `kSumsOfPart` of each part
};

/// Sums over the parts of all fits that are not done. One item is one or all lanes of a part.
/// Cost: some 7 ns a point on a core; 3 numbers read for a point, 37 written for an item.
struct FitSumKernel {
  FitTable table;
  std::int64_t part_count = 0;
  const PlainVec* points = nullptr;
  const PlainVec* normals = nullptr;

  template <class Grain>
  HEWN_HD std::int64_t items() const {
    return part_count * kSumsOfPart<Grain>;
  }
  template <class Grain>
  HEWN_HD void run(std::int64_t item) const {
    const int fit = table.parts[item / kSumsOfPart<Grain>].fit;
    if (table.states[fit].is_done) return;
    switch (table.targets[fit].kind) {
      case SurfaceKind::Plane:
        return sum<SurfaceKind::Plane, Grain>(item);
      case SurfaceKind::Sphere:
        return sum<SurfaceKind::Sphere, Grain>(item);
      case SurfaceKind::Cylinder:
        return sum<SurfaceKind::Cylinder, Grain>(item);
      case SurfaceKind::Cone:
        return sum<SurfaceKind::Cone, Grain>(item);
      case SurfaceKind::Torus:
        return sum<SurfaceKind::Torus, Grain>(item);
    }
  }

 private:
  template <SurfaceKind K, class Grain>
  HEWN_HD void sum(std::int64_t item) const {
    const FitPart& part = table.parts[item / kSumsOfPart<Grain>];
    const int lane = static_cast<int>(item % kSumsOfPart<Grain>) * Grain::kFitLanes;
    table.sums[item] = equations_of<K, Grain::kFitLanes>(
        table.targets[part.fit], table.states[part.fit], part, lane, points, normals);
  }
};

/// The next trial of all fits that are not done. One item is one fit.
struct FitStepKernel {
  FitTable table;
  const FitParts* parts_of = nullptr;  ///< by fit
  std::int64_t fit_count = 0;
  int* unfinished = nullptr;  ///< out: counts the fits that want another round

  template <class Grain>
  HEWN_HD std::int64_t items() const {
    return fit_count;
  }
  template <class Grain>
  HEWN_HD void run(std::int64_t item) const {
    if (table.states[item].is_done) return;
    switch (table.targets[item].kind) {
      case SurfaceKind::Plane:
        return step<SurfaceKind::Plane, Grain>(item);
      case SurfaceKind::Sphere:
        return step<SurfaceKind::Sphere, Grain>(item);
      case SurfaceKind::Cylinder:
        return step<SurfaceKind::Cylinder, Grain>(item);
      case SurfaceKind::Cone:
        return step<SurfaceKind::Cone, Grain>(item);
      case SurfaceKind::Torus:
        return step<SurfaceKind::Torus, Grain>(item);
    }
  }

 private:
  template <SurfaceKind K, class Grain>
  HEWN_HD void step(std::int64_t item) const {
    FitEquations total;
    const FitParts parts = parts_of[item];
    for (int i = parts.first; i < parts.first + parts.count; ++i) {
      FitEquations of_part;
      for (int k = 0; k < kSumsOfPart<Grain>; ++k) {
        of_part.add<kParameters<K>>(table.sums[i * kSumsOfPart<Grain> + k]);
      }
      total.add<kParameters<K>>(of_part);
    }
    advance<K>(table.targets[item], total, table.states[item]);
    if (!table.states[item].is_done) add_to(unfinished, 1);
  }
};

}  // namespace hewn
