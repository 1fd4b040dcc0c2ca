#pragma once
/// A torus with its adjacency, for benchmarks without the mesh layer.
#include <cmath>
#include <vector>

#include "core/compute/mesh_on_device.h"

namespace hewn {

/// 2 n^2 triangles in a grid of n by n vertices.
struct RingMesh {
  explicit RingMesh(int n) {
    for (int i = 0; i < n; ++i) {
      for (int k = 0; k < n; ++k) {
        const double u = 2 * kPi * i / n;
        const double w = 2 * kPi * k / n;
        const double r = 3 + std::cos(w);
        vertices.emplace_back(r * std::cos(u), r * std::sin(u), std::sin(w));
      }
    }
    const auto vertex = [n](int i, int k) { return (i + n) % n * n + (k + n) % n; };
    // Of the square at (i, k): below its diagonal, and above.
    const auto lower = [&](int i, int k) { return 2 * vertex(i, k); };
    const auto upper = [&](int i, int k) { return 2 * vertex(i, k) + 1; };
    for (int i = 0; i < n; ++i) {
      for (int k = 0; k < n; ++k) {
        triangles.push_back({vertex(i, k), vertex(i + 1, k), vertex(i + 1, k + 1)});
        neighbors.push_back({upper(i, k - 1), lower(i + 1, k) + 1, upper(i, k)});
        triangles.push_back({vertex(i, k), vertex(i + 1, k + 1), vertex(i, k + 1)});
        neighbors.push_back({lower(i, k), lower(i, k + 1), lower(i - 1, k)});
      }
    }
    derive();
  }

  MeshArrays arrays() const {
    return {vertices, triangles, normals, areas, neighbors, corners, first_corner};
  }

  std::vector<Vec3> vertices, normals;
  std::vector<std::array<int, 3>> triangles, neighbors;
  std::vector<double> areas;
  std::vector<int> corners, first_corner;

 private:
  void derive() {
    first_corner.assign(vertices.size() + 1, 0);
    for (const auto& [a, b, c] : triangles) {
      const Vec3& p = vertices[static_cast<std::size_t>(a)];
      const Vec3 cross = (vertices[static_cast<std::size_t>(b)] - p)
                             .cross(vertices[static_cast<std::size_t>(c)] - p);
      areas.push_back(cross.norm() / 2);
      normals.push_back(cross.normalized());
      for (const int v : {a, b, c}) ++first_corner[static_cast<std::size_t>(v) + 1];
    }
    for (std::size_t i = 1; i < first_corner.size(); ++i) first_corner[i] += first_corner[i - 1];
    corners.resize(triangles.size() * 3);
    std::vector<int> next(first_corner.begin(), first_corner.end() - 1);
    for (std::size_t i = 0; i < corners.size(); ++i) {
      const int v = triangles[i / 3][i % 3];
      corners[static_cast<std::size_t>(next[static_cast<std::size_t>(v)]++)] = static_cast<int>(i);
    }
  }
};

}  // namespace hewn
