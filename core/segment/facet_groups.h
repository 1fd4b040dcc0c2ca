#pragma once
/// Which facets form one surface: what the stages of segmentation hand on to each other.
#include <vector>

#include "core/csg/surface.h"

namespace hewn {

/// A surface with the facets found on it.
struct GrownGroup {
  Surface surface;
  std::vector<int> facets;
  /// The surface follows from the facets' planes or from an axis; fits to the group's own vertices
  /// would only spoil it.
  bool is_settled = false;
};

/// The groups found so far and, for each facet, the one that it belongs to (-1: free).
struct FacetGroups {
  std::vector<GrownGroup> groups;
  std::vector<int> group_of;

  /// Appends a group and gives it its facets.
  void add(GrownGroup group);

  /// Gives all facets of a group to another and leaves it empty, for `drop_empty`.
  static void unite(GrownGroup& whole, GrownGroup& piece);

  /// Drops groups without facets and renumbers the rest in their order.
  void drop_empty();
};

}  // namespace hewn
