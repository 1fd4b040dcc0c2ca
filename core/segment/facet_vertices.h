#pragma once
/// Which vertices facets have.
#include <span>
#include <vector>

#include "core/fit/face_groups.h"

namespace hewn {

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
