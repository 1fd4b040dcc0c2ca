#pragma once
/// Tensor voting: which vertices lie on faces, ridges and corners?
#include "core/compute/kernels/mesh_form.h"

namespace hewn {

enum class VertexClass : std::uint8_t { Face, Ridge, Corner };

struct VertexLimits {
  double ridge_slope = 0;    ///< tangent of half the ridge angle
  double corner_ratio = 0;   ///< smallest over middle eigenvalue
  double corner_defect = 0;  ///< radians
};

/// The class of a vertex by the eigenvalues of its triangles' normals' tensor, weighted by angles.
/// One item is one vertex. Cost: O(corners).
struct VertexClassKernel : MeshKernel {
  VertexLimits limits;
  VertexClass* classes = nullptr;  ///< out

  template <class Grain>
  HEWN_HD void run(std::int64_t item) const {
    const int vertex = number_of(item);
    classes[vertex] = classify(mesh.first_corner[vertex], mesh.first_corner[vertex + 1]);
  }

 private:
  struct Eigenvalues {
    double low, middle, high;
  };

  HEWN_HD VertexClass classify(int begin, int end) const {
    double tensor[3][3] = {};
    double angle_sum = 0;
    bool is_on_rim = false;  // a hole or a non-manifold edge: the angles do not close
    for (int i = begin; i < end; ++i) {
      const int corner = mesh.corners[i];
      const int triangle = corner / 3;
      const double angle = mesh.corner_angle(corner);
      const double n[3] = {mesh.normals[triangle].x, mesh.normals[triangle].y,
                           mesh.normals[triangle].z};
      for (int r = 0; r < 3; ++r) {
        for (int c = 0; c < 3; ++c) tensor[r][c] += angle * n[r] * n[c];
      }
      angle_sum += angle;
      is_on_rim = is_on_rim || mesh.neighbors[corner] < 0 ||
                  mesh.neighbors[MeshForm::side_before(corner)] < 0;
    }
    if (!(angle_sum > 0)) return VertexClass::Face;
    constexpr double kTurn = 2 * 3.141592653589793238;
    if (!is_on_rim && fabs(kTurn - angle_sum) >= limits.corner_defect) return VertexClass::Corner;
    const Eigenvalues values = eigenvalues(tensor);
    // Two planes that meet at the ridge angle have just this ratio.
    if (values.middle < limits.ridge_slope * limits.ridge_slope * values.high) {
      return VertexClass::Face;
    }
    return values.low < limits.corner_ratio * values.middle ? VertexClass::Ridge
                                                            : VertexClass::Corner;
  }

  /// By Jacobi's rotations, which need square roots only. The matrix becomes diagonal.
  static HEWN_HD Eigenvalues eigenvalues(double (&m)[3][3]) {
    constexpr int kSweeps = 6;  // each squares what is left beside the diagonal
    for (int sweep = 0; sweep < kSweeps; ++sweep) {
      rotate(m, 0, 1, 2);
      rotate(m, 0, 2, 1);
      rotate(m, 1, 2, 0);
    }
    const double least = fmin(m[0][0], fmin(m[1][1], m[2][2]));
    const double most = fmax(m[0][0], fmax(m[1][1], m[2][2]));
    const double lesser = fmin(m[0][0], m[1][1]);
    const double greater = fmax(m[0][0], m[1][1]);
    return {least, fmax(lesser, fmin(greater, m[2][2])), most};
  }

  /// Makes m[p][q] zero; `o` is the third index (Golub and Van Loan, section 8.5).
  static HEWN_HD void rotate(double (&m)[3][3], int p, int q, int o) {
    if (m[p][q] == 0) return;
    const double ratio = (m[q][q] - m[p][p]) / (2 * m[p][q]);
    const double root = sqrt(1 + ratio * ratio);
    const double t = ratio >= 0 ? 1 / (ratio + root) : -1 / (root - ratio);
    const double c = 1 / sqrt(1 + t * t);
    const double s = t * c;
    m[p][p] -= t * m[p][q];
    m[q][q] += t * m[p][q];
    m[p][q] = m[q][p] = 0;
    const double to_p = m[p][o];
    const double to_q = m[q][o];
    m[p][o] = m[o][p] = c * to_p - s * to_q;
    m[q][o] = m[o][q] = s * to_p + c * to_q;
  }
};

}  // namespace hewn
