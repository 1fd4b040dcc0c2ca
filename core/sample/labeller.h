#pragma once
/// The wanted solid of one partition as a function of points.
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "core/csg/literal.h"
#include "core/fit/face_groups.h"
#include "core/mesh/query.h"

namespace hewn {

enum class Label : std::uint8_t { Outside, Inside, DontCare };

/// Labels points by the mesh. A point belongs to the partition whose face group is nearest; points
/// of other partitions are don't-cares, and inside and outside swap for a subtracted partition.
/// Thread-safe; the pointees must outlive it.
class Labeller {
 public:
  Labeller(const MeshQuery& query, const Segmentation& segmentation, const std::vector<int>& groups,
           bool is_subtracted);

  /// Points in these solids become don't-cares.
  void ignore(std::vector<Literal> solids) { ignored_ = std::move(solids); }

  Label operator()(const Vec3& p) const;
  /// Of many points at once, on the device that suits. What is left undone when the run is
  /// cancelled is `DontCare`.
  std::vector<Label> operator()(std::span<const Vec3> points, const RunContext& run) const;
  bool owns_group(int group) const { return owns_all_ || owned_[group]; }
  bool owns_all() const { return owns_all_; }
  const MeshQuery& query() const { return *query_; }

 private:
  bool is_of_concern(const Vec3& p) const;
  Label label_of(bool is_in_mesh) const {
    return is_in_mesh != is_subtracted_ ? Label::Inside : Label::Outside;
  }

  const MeshQuery* query_;
  const Segmentation* segmentation_;
  std::vector<char> owned_;
  std::vector<Literal> ignored_;
  bool owns_all_;
  bool is_subtracted_;
};

}  // namespace hewn
