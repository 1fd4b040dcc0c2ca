#include "core/sample/labeller.h"

namespace hewn {

Labeller::Labeller(const MeshQuery& query, const Segmentation& segmentation,
                   const std::vector<int>& groups, bool is_subtracted)
    : query_(&query),
      segmentation_(&segmentation),
      owned_(segmentation.groups.size(), 0),
      owns_all_(groups.empty()),
      is_subtracted_(is_subtracted) {
  for (const int g : groups) owned_[g] = 1;
}

Label Labeller::operator()(const Vec3& p) const {
  for (const Literal& solid : ignored_) {
    if (solid.signed_distance(p) < 0) return Label::DontCare;
  }
  if (!owns_all_) {
    const int triangle = query_->closest(p).triangle;
    const int group = triangle < 0 ? -1 : segmentation_->group_of_triangle[triangle];
    if (group < 0 || !owned_[group]) return Label::DontCare;
  }
  return query_->contains(p) != is_subtracted_ ? Label::Inside : Label::Outside;
}

}  // namespace hewn
