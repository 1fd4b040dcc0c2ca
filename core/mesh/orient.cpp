// Consistent, outward orientation.
#include <algorithm>
#include <memory>
#include <numeric>

#include <fmt/format.h>

#include "core/base/counted.h"
#include "core/mesh/edge_use.h"
#include "core/mesh/query.h"
#include "core/mesh/repair.h"

namespace hewn {
namespace {

/// Triangles joined over edges with exactly two sides.
struct Patches {
  std::vector<int> patch_of;        ///< per triangle
  std::vector<char> is_flipped;     ///< per triangle, to agree with the patch's first triangle
  std::vector<int> first;           ///< per patch: its lowest triangle
  std::vector<int> size;            ///< per patch: triangles
  std::vector<char> is_orientable;  ///< per patch
  int count() const { return static_cast<int>(first.size()); }
};

struct Neighbour {
  int triangle = -1;
  bool agrees = true;
};

/// Per triangle side the one neighbour, where there is exactly one.
std::vector<Neighbour> find_neighbours(std::span<const EdgeSide> sides) {
  std::vector<Neighbour> neighbours(sides.size());
  for_each_edge(sides, [&](std::span<const EdgeSide> edge) {
    if (edge.size() != 2) return;
    const bool agrees = edge[0].is_reversed() != edge[1].is_reversed();
    neighbours[edge[0].side >> 1] = {edge[1].triangle(), agrees};
    neighbours[edge[1].side >> 1] = {edge[0].triangle(), agrees};
  });
  return neighbours;
}

/// Floods one patch from triangle `seed`.
void flood(const std::vector<Neighbour>& neighbours, int seed, Patches& patches) {
  const int patch = patches.count();
  patches.first.push_back(seed);
  patches.is_orientable.push_back(1);
  std::vector<int> stack = {seed};
  patches.patch_of[seed] = patch;
  int size = 0;
  while (!stack.empty()) {
    const int t = stack.back();
    stack.pop_back();
    ++size;
    for (int k = 0; k < 3; ++k) {
      const Neighbour& n = neighbours[3 * t + k];
      if (n.triangle < 0) continue;
      const char wanted = static_cast<char>(patches.is_flipped[t] ^ (n.agrees ? 0 : 1));
      if (patches.patch_of[n.triangle] < 0) {
        patches.patch_of[n.triangle] = patch;
        patches.is_flipped[n.triangle] = wanted;
        stack.push_back(n.triangle);
      } else if (patches.is_flipped[n.triangle] != wanted) {
        patches.is_orientable[patch] = 0;
      }
    }
  }
  patches.size.push_back(size);
}

Patches find_patches(std::span<const EdgeSide> sides) {
  const std::size_t triangles = sides.size() / 3;
  Patches patches;
  patches.patch_of.assign(triangles, -1);
  patches.is_flipped.assign(triangles, 0);
  const std::vector<Neighbour> neighbours = find_neighbours(sides);
  for (std::size_t t = 0; t < triangles; ++t) {
    if (patches.patch_of[t] < 0) flood(neighbours, static_cast<int>(t), patches);
  }
  return patches;
}

/// Turns the fewer triangles of each patch; returns how many were turned.
int agree_within_patches(Soup& soup, const Patches& patches) {
  std::vector<int> turned(patches.count(), 0);
  for (std::size_t t = 0; t < soup.triangles.size(); ++t) {
    turned[patches.patch_of[t]] += patches.is_flipped[t];
  }
  int flipped = 0;
  for (std::size_t t = 0; t < soup.triangles.size(); ++t) {
    const int patch = patches.patch_of[t];
    const bool turns_rest = 2 * turned[patch] > patches.size[patch];
    if ((patches.is_flipped[t] != 0) == turns_rest) continue;
    std::swap(soup.triangles[t][1], soup.triangles[t][2]);
    ++flipped;
  }
  return flipped;
}

std::vector<double> patch_volumes(const Soup& soup, const Patches& patches) {
  // About each patch's own first corner: for an open patch the sign would else depend on the
  // origin.
  std::vector<double> volumes(patches.count(), 0);
  std::vector<Vec3> centers(patches.count(), Vec3::Zero());
  for (std::size_t t = 0; t < soup.triangles.size(); ++t) {
    for (const int i : soup.triangles[t]) {
      centers[patches.patch_of[t]] += soup.vertices[i] / (3.0 * patches.size[patches.patch_of[t]]);
    }
  }
  for (std::size_t t = 0; t < soup.triangles.size(); ++t) {
    const auto& [a, b, c] = soup.triangles[t];
    const Vec3& o = centers[patches.patch_of[t]];
    volumes[patches.patch_of[t]] +=
        (soup.vertices[a] - o).dot((soup.vertices[b] - o).cross(soup.vertices[c] - o)) / 6;
  }
  return volumes;
}

/// In one pass: debris can have as many patches as triangles.
void flip_patches(Soup& soup, const Patches& patches, const std::vector<char>& is_turned) {
  for (std::size_t t = 0; t < soup.triangles.size(); ++t) {
    if (is_turned[patches.patch_of[t]] != 0) std::swap(soup.triangles[t][1], soup.triangles[t][2]);
  }
}

/// A closed patch with the means to ask what lies in it.
struct Shell {
  int patch = -1;
  Box3 box;
  std::vector<Vec3> probes;  ///< points of its surface
  std::unique_ptr<MeshQuery> query;
};

/// Closed patches, the nesting of which matters. More than this many (debris, text) are taken as
/// lying side by side.
constexpr int kMaxShells = 300;
constexpr int kProbes = 7;

Shell make_shell(const Soup& soup, const Patches& patches, int patch) {
  Shell shell;
  shell.patch = patch;
  std::vector<Triangle> own;
  for (std::size_t t = 0; t < soup.triangles.size(); ++t) {
    if (patches.patch_of[t] == patch) own.push_back(soup.triangles[t]);
  }
  std::vector<Vec3> vertices;
  std::vector<int> used;
  for (const Triangle& t : own) used.insert(used.end(), t.begin(), t.end());
  std::sort(used.begin(), used.end());
  used.erase(std::unique(used.begin(), used.end()), used.end());
  for (const int i : used) {
    vertices.push_back(soup.vertices[i]);
    shell.box.extend(soup.vertices[i]);
  }
  for (Triangle& t : own) {
    for (int& i : t) {
      i = static_cast<int>(std::lower_bound(used.begin(), used.end(), i) - used.begin());
    }
  }
  const std::size_t step = std::max<std::size_t>(1, own.size() / kProbes);
  for (std::size_t t = 0; t < own.size(); t += step) {
    shell.probes.emplace_back((vertices[own[t][0]] + vertices[own[t][1]] + vertices[own[t][2]]) /
                              3);
  }
  Mesh mesh = make_mesh(std::move(vertices), std::move(own));
  if (mesh.volume < 0) {  // inside tests count windings: the shell must look outward
    for (Triangle& t : mesh.triangles) std::swap(t[1], t[2]);
    mesh = make_mesh(std::move(mesh.vertices), std::move(mesh.triangles));
  }
  shell.query = std::make_unique<MeshQuery>(std::make_shared<const Mesh>(std::move(mesh)));
  return shell;
}

bool encloses(const Shell& outer, const Shell& inner) {
  if (!outer.box.contains(inner.box.lo) || !outer.box.contains(inner.box.hi)) return false;
  return std::all_of(inner.probes.begin(), inner.probes.end(),
                     [&](const Vec3& p) { return outer.query->contains(p); });
}

std::vector<char> find_closed_patches(std::span<const EdgeSide> sides, const Patches& patches) {
  std::vector<char> is_closed(patches.count(), 1);
  for_each_edge(sides, [&](std::span<const EdgeSide> edge) {
    // Where several patches meet in one edge, each is closed when it passes through it in pairs.
    for (const EdgeSide& side : edge) {
      const int patch = patches.patch_of[side.triangle()];
      const auto own = std::count_if(edge.begin(), edge.end(), [&](const EdgeSide& other) {
        return patches.patch_of[other.triangle()] == patch;
      });
      if (own % 2 != 0) is_closed[patch] = 0;
    }
  });
  return is_closed;
}

/// How many other shells each shell lies in.
std::vector<int> nesting_depths(const Soup& soup, const Patches& patches,
                                const std::vector<int>& closed) {
  std::vector<int> depths(closed.size(), 0);
  if (closed.size() < 2 || static_cast<int>(closed.size()) > kMaxShells) return depths;
  std::vector<Shell> shells;
  shells.reserve(closed.size());
  for (const int patch : closed) shells.push_back(make_shell(soup, patches, patch));
  for (std::size_t i = 0; i < shells.size(); ++i) {
    for (std::size_t j = 0; j < shells.size(); ++j) {
      if (i != j && encloses(shells[j], shells[i])) ++depths[i];
    }
  }
  return depths;
}

}  // namespace

Result<bool> orient_triangles(Soup& soup, std::span<const EdgeSide> sides, MeshReport& report,
                              const RunContext& run) {
  const Patches patches = find_patches(sides);
  if (run.is_cancelled()) return RunContext::cancelled();
  report.triangles_flipped = agree_within_patches(soup, patches);
  if (report.triangles_flipped > 0) {
    report.warnings.push_back(counted(report.triangles_flipped,
                                      "triangle was turned to agree with its neighbours.",
                                      "triangles were turned to agree with their neighbours."));
  }
  const auto one_sided =
      std::count(patches.is_orientable.begin(), patches.is_orientable.end(), char{0});
  if (one_sided > 0) {
    report.warnings.push_back(counted(
        one_sided, "part of the surface is one-sided (like a Moebius strip) and has no inside.",
        "parts of the surface are one-sided (like a Moebius strip) and have no inside."));
  }
  const std::vector<double> volumes = patch_volumes(soup, patches);
  const std::vector<char> is_closed = find_closed_patches(sides, patches);
  std::vector<int> closed;
  for (int p = 0; p < patches.count(); ++p) {
    if (is_closed[p] != 0) closed.push_back(p);
  }
  if (run.is_cancelled()) return RunContext::cancelled();
  const std::vector<int> depths = nesting_depths(soup, patches, closed);
  std::vector<int> depth_of(patches.count(), 0);
  for (std::size_t i = 0; i < closed.size(); ++i) depth_of[closed[i]] = depths[i];
  std::vector<char> is_turned(patches.count(), 0);
  int outer_flips = 0;
  int cavity_flips = 0;
  for (int p = 0; p < patches.count(); ++p) {
    const bool is_cavity = depth_of[p] % 2 != 0;
    if ((volumes[p] < 0) == is_cavity || volumes[p] == 0) continue;
    is_turned[p] = 1;
    ++(is_cavity ? cavity_flips : outer_flips);
  }
  flip_patches(soup, patches, is_turned);
  report.was_inside_out = outer_flips > 0;
  if (outer_flips > 0) {
    report.warnings.push_back(fmt::format("{} of {} inside out and turned.", outer_flips,
                                          counted(patches.count(), "shell was", "shells were")));
  }
  if (cavity_flips > 0) {
    report.warnings.push_back(
        counted(cavity_flips, "shell inside another was turned inward: it is taken as a cavity.",
                "shells inside others were turned inward: they are taken as cavities."));
  }
  return report.triangles_flipped + outer_flips + cavity_flips > 0;
}

}  // namespace hewn
