#include "core/segment/facet_vertices.h"

namespace hewn {

FacetVertices::FacetVertices(const Mesh& mesh, std::span<const Facet> facets) {
  std::vector<int> last_facet(mesh.vertices.size(), -1);
  begin_.reserve(facets.size() + 1);
  for (int f = 0; f < static_cast<int>(facets.size()); ++f) {
    for (const int t : facets[f].triangles) {
      for (const int v : mesh.triangles[t]) {
        if (last_facet[v] != f) all_.push_back(v);
        last_facet[v] = f;
      }
    }
    sort_marked(all_, begin_.back(), last_facet, f);
    begin_.push_back(all_.size());
  }
}

}  // namespace hewn
