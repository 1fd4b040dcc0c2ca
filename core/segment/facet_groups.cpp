#include "core/segment/facet_groups.h"

#include <algorithm>
#include <utility>

namespace hewn {

void FacetGroups::add(GrownGroup group) {
  for (const int f : group.facets) group_of[f] = static_cast<int>(groups.size());
  groups.push_back(std::move(group));
}

void FacetGroups::unite(GrownGroup& whole, GrownGroup& piece) {
  whole.facets.insert(whole.facets.end(), piece.facets.begin(), piece.facets.end());
  std::sort(whole.facets.begin(), whole.facets.end());
  piece.facets.clear();
}

void FacetGroups::drop_empty() {
  std::erase_if(groups, [](const GrownGroup& g) { return g.facets.empty(); });
  std::fill(group_of.begin(), group_of.end(), -1);
  for (std::size_t g = 0; g < groups.size(); ++g) {
    for (const int f : groups[g].facets) group_of[f] = static_cast<int>(g);
  }
}

}  // namespace hewn
