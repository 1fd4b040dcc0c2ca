#include "core/sample/labeller.h"

#include "core/compute/parallel.h"

namespace hewn {
namespace {

/// Points that a thread takes at a time.
constexpr std::size_t kGrain = 128;

}  // namespace

Labeller::Labeller(const MeshQuery& query, const Segmentation& segmentation,
                   const std::vector<int>& groups, bool is_subtracted)
    : query_(&query),
      segmentation_(&segmentation),
      owned_(segmentation.groups.size(), 0),
      owns_all_(groups.empty()),
      is_subtracted_(is_subtracted) {
  for (const int g : groups) owned_[g] = 1;
}

/// Whether the point belongs to the partition and to none of the ignored solids.
bool Labeller::is_of_concern(const Vec3& p) const {
  for (const Literal& solid : ignored_) {
    if (solid.signed_distance(p) < 0) return false;
  }
  if (owns_all_) return true;
  const int triangle = query_->closest(p).triangle;
  const int group = triangle < 0 ? -1 : segmentation_->group_of_triangle[triangle];
  return group >= 0 && owned_[group] != 0;
}

Label Labeller::operator()(const Vec3& p) const {
  return is_of_concern(p) ? label_of(query_->contains(p)) : Label::DontCare;
}

std::vector<Label> Labeller::operator()(std::span<const Vec3> points, const RunContext& run) const {
  std::vector<char> is_asked(points.size(), 0);
  for_each_chunk(run.threads, points.size(), kGrain, [&](std::size_t begin, std::size_t end) {
    if (run.is_cancelled()) return;
    for (std::size_t i = begin; i < end; ++i) is_asked[i] = is_of_concern(points[i]) ? 1 : 0;
  });
  std::vector<Vec3> asked;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (is_asked[i] != 0) asked.push_back(points[i]);
  }
  const std::vector<char> is_in_mesh = query_->contains(asked, run);
  std::vector<Label> labels(points.size(), Label::DontCare);
  if (run.is_cancelled()) return labels;
  std::size_t next = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (is_asked[i] != 0) labels[i] = label_of(is_in_mesh[next++] != 0);
  }
  return labels;
}

}  // namespace hewn
