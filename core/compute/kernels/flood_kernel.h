#pragma once
/// Simple region growing by parallel flooding.
#include "core/compute/kernels/curvature_kernels.h"

namespace hewn {

/// One round: every triangle takes the lowest label around it, of its own class and not across a
/// marked side, and then its label's label, so that long regions take a logarithmic number of
/// rounds. One item is one triangle.
struct FloodKernel : MeshKernel {
  const bool* is_marked = nullptr;  ///< by corner number
  const CurvatureClass* classes = nullptr;
  const int* labels = nullptr;  ///< a triangle each, or -1
  int* next = nullptr;          ///< out
  int* has_changed = nullptr;   ///< out: 1 if any label has

  template <class Grain>
  HEWN_HD void run(std::int64_t item) const {
    const int t = number_of(item);
    next[t] = labels[t] < 0 ? -1 : lowest_around(t);
    if (next[t] != labels[t]) set_flag(has_changed);
  }

 private:
  HEWN_HD int lowest_around(int t) const {
    int label = labels[t];
    for (int corner = 3 * t; corner < 3 * t + 3; ++corner) {
      const int other = mesh.neighbors[corner];
      if (is_marked[corner] || other < 0 || classes[other] != classes[t]) continue;
      label = label < labels[other] ? label : labels[other];
    }
    return label < labels[label] ? label : labels[label];
  }
};

}  // namespace hewn
