#pragma once
/// Which vertices facets have.
#include <algorithm>
#include <cstddef>
#include <span>
#include <vector>

#include "core/fit/face_groups.h"

namespace hewn {

/// Puts the vertices from `begin` on in ascending order. Requires: they are just those whose mark
/// in `mark_of`, which has one of each vertex, is `mark`.
template <class Mark>
void sort_marked(std::vector<int>& vertices, std::size_t begin, const std::vector<Mark>& mark_of,
                 Mark mark) {
  // To look at all of them takes no longer than to sort this share.
  constexpr std::size_t kScannedShare = 16;
  if (vertices.size() - begin < mark_of.size() / kScannedShare) {
    std::sort(vertices.begin() + static_cast<std::ptrdiff_t>(begin), vertices.end());
    return;
  }
  vertices.resize(begin);
  for (std::size_t v = 0; v < mark_of.size(); ++v) {
    if (mark_of[v] == mark) vertices.push_back(static_cast<int>(v));
  }
}

/// All vertices of each of some facets, ascending.
class FacetVertices {
 public:
  FacetVertices() = default;
  /// Cost: O(corners), and a sort of each small facet's.
  FacetVertices(const Mesh& mesh, std::span<const Facet> facets);

  std::span<const int> of(std::size_t facet) const {
    return std::span(all_).subspan(begin_[facet], begin_[facet + 1] - begin_[facet]);
  }

 private:
  std::vector<int> all_;
  std::vector<std::size_t> begin_ = {0};
};

}  // namespace hewn
