#include "core/segment/facet_vertices.h"

#include <algorithm>

namespace hewn {
namespace {

/// Of the mesh's vertices: to look at each takes no longer than to sort so many.
constexpr std::size_t kScannedShare = 16;

}  // namespace

FacetVertices::FacetVertices(const Mesh& mesh, std::span<const Facet> facets) {
  std::vector<int> last_facet(mesh.vertices.size(), -1);
  begin_.reserve(facets.size() + 1);
  for (int f = 0; f < static_cast<int>(facets.size()); ++f) {
    const auto begin = static_cast<std::ptrdiff_t>(all_.size());
    for (const int t : facets[f].triangles) {
      for (const int v : mesh.triangles[t]) {
        if (last_facet[v] != f) all_.push_back(v);
        last_facet[v] = f;
      }
    }
    if (all_.size() - begin_.back() < last_facet.size() / kScannedShare) {
      std::sort(all_.begin() + begin, all_.end());
    } else {
      all_.resize(begin_.back());
      for (int v = 0; v < static_cast<int>(last_facet.size()); ++v) {
        if (last_facet[v] == f) all_.push_back(v);
      }
    }
    begin_.push_back(all_.size());
  }
}

}  // namespace hewn
