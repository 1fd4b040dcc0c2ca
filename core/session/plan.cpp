#include "core/session/plan.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "core/segment/edit/bisect.h"
#include "core/segment/edit/merge.h"

namespace hewn {
namespace {

/// A point further than this share of the diagonal from the surface names no group.
constexpr double kPointReach = 0.01;
/// Vertices of a cut lie this near its plane, as a share of the diagonal.
constexpr double kOnCut = 2e-6;

/// Resolves references against the groups as they stand; builds the query when a point needs it.
class GroupFinder {
 public:
  GroupFinder(std::shared_ptr<const Mesh> mesh, const Segmentation& segmentation,
              std::shared_ptr<const MeshQuery> query = nullptr)
      : mesh_(std::move(mesh)), segmentation_(&segmentation), query_(std::move(query)) {}

  Result<int> find(const GroupRef& ref, const std::string& where) {
    if (!ref.at) {
      const int count = static_cast<int>(segmentation_->groups.size());
      if (ref.index >= 0 && ref.index < count) return ref.index;
      return Error{ErrorCode::InvalidArgument,
                   fmt::format("there is no group {}, only 0 to {}; `hewn segment` lists them",
                               ref.index, count - 1),
                   where};
    }
    if (!query_) query_ = std::make_shared<const MeshQuery>(mesh_);
    const ClosestPoint nearest = query_->closest(*ref.at);
    const double apart = nearest.distance / std::max(mesh_->diagonal(), 1e-300);
    const int group =
        nearest.triangle < 0 ? -1 : segmentation_->group_of_triangle[nearest.triangle];
    if (group >= 0 && apart <= kPointReach) return group;
    return Error{ErrorCode::InvalidArgument,
                 fmt::format("no group at ({}, {}, {}): the surface is {:.3g} away; give a point "
                             "on the face",
                             ref.at->x(), ref.at->y(), ref.at->z(), nearest.distance),
                 where};
  }

  /// Ascending, each once.
  Result<std::vector<int>> find_all(const std::vector<GroupRef>& refs, const std::string& where) {
    std::vector<int> groups;
    for (const GroupRef& ref : refs) {
      Result<int> group = find(ref, where);
      if (!group) return group.error();
      groups.push_back(*group);
    }
    std::sort(groups.begin(), groups.end());
    groups.erase(std::unique(groups.begin(), groups.end()), groups.end());
    return groups;
  }

 private:
  std::shared_ptr<const Mesh> mesh_;
  const Segmentation* segmentation_;
  std::shared_ptr<const MeshQuery> query_;
};

std::vector<int> all_groups(const Segmentation& segmentation) {
  std::vector<int> groups(segmentation.groups.size());
  for (std::size_t g = 0; g < groups.size(); ++g) groups[g] = static_cast<int>(g);
  return groups;
}

/// Takes over what an edit made.
Result<void> adopt(Result<EditedSegmentation> edited, PreparedMesh& out) {
  if (!edited) return edited.error();
  out.mesh = std::make_shared<const Mesh>(std::move(edited->mesh));
  out.segmentation = std::move(edited->segmentation);
  return {};
}

/// Whether a vertex of the groups lies on the cut's plane.
bool touches(const CutStep& cut, const std::vector<int>& groups, const PreparedMesh& prepared) {
  const Mesh& mesh = *prepared.mesh;
  const double reach = kOnCut * mesh.diagonal();
  for (const int g : groups) {
    for (const int t : prepared.segmentation.groups[g].triangles) {
      for (int k = 0; k < 3; ++k) {
        if (std::abs(cut.normal.dot(mesh.corner(t, k)) - cut.offset) <= reach) return true;
      }
    }
  }
  return false;
}

/// Flattens the expression into a list, parents first.
class Resolver {
 public:
  Resolver(const Project& project, const PreparedMesh& prepared)
      : project_(project),
        prepared_(prepared),
        finder_(prepared.mesh, prepared.segmentation, prepared.query) {}

  Result<void> add(const PartitionPlan& plan, int parent, bool is_subtracted,
                   const std::string& path) {
    const std::string where = path + plan.name;
    auto groups = finder_.find_all(plan.groups, "partition " + where);
    if (!groups) return groups.error();
    for (const int g : *groups) claimed_.push_back(g);
    const int here = static_cast<int>(out_.size());
    out_.push_back({plan.name, plan.op, parent, std::move(*groups), is_subtracted, {}});
    if (plan.takes_rest) rest_ = here;
    for (const PartitionPlan& child : plan.children) {
      const bool flips = child.op == Op::Difference;
      if (auto done = add(child, here, is_subtracted != flips, where + "/"); !done) return done;
    }
    return {};
  }

  Result<std::vector<Partition>> finish(const RunContext& run) {
    std::sort(claimed_.begin(), claimed_.end());
    std::vector<int> unclaimed;
    double unclaimed_area = 0;
    for (const int g : all_groups(prepared_.segmentation)) {
      if (std::binary_search(claimed_.begin(), claimed_.end(), g)) continue;
      unclaimed.push_back(g);
      unclaimed_area += prepared_.segmentation.groups[g].area;
    }
    if (rest_ >= 0) {
      out_[rest_].groups.insert(out_[rest_].groups.end(), unclaimed.begin(), unclaimed.end());
      std::sort(out_[rest_].groups.begin(), out_[rest_].groups.end());
    } else if (!unclaimed.empty()) {
      run.warn(
          fmt::format("{} groups ({:.1f} % of the surface) belong to no partition and are "
                      "left out; give one partition \"groups\": \"rest\"",
                      unclaimed.size(), 100 * unclaimed_area / prepared_.mesh->total_area));
    }
    for (Partition& partition : out_) {
      for (std::size_t c = 0; c < project_.cuts.size(); ++c) {
        if (touches(project_.cuts[c], partition.groups, prepared_)) {
          partition.touching_cuts.push_back(static_cast<int>(c));
        }
      }
    }
    return std::move(out_);
  }

 private:
  const Project& project_;
  const PreparedMesh& prepared_;
  GroupFinder finder_;
  std::vector<Partition> out_;
  std::vector<int> claimed_;
  int rest_ = -1;
};

}  // namespace

Result<PreparedMesh> apply_edits(const Project& project, std::shared_ptr<const Mesh> mesh,
                                 Segmentation segmentation, const RunContext& run) {
  PreparedMesh out{std::move(mesh), nullptr, std::move(segmentation)};
  for (std::size_t c = 0; c < project.cuts.size(); ++c) {
    const CutStep& cut = project.cuts[c];
    GroupFinder finder(out.mesh, out.segmentation);
    auto groups = finder.find_all(cut.groups, fmt::format("cuts[{}]", c));
    if (!groups) return groups.error();
    if (groups->empty()) *groups = all_groups(out.segmentation);
    const CutPlane plane{cut.normal, cut.offset};
    auto edited = bisect_groups(*out.mesh, out.segmentation, *groups, plane, {}, run);
    if (auto done = adopt(std::move(edited), out); !done) return done.error();
  }
  for (std::size_t m = 0; m < project.merges.size(); ++m) {
    GroupFinder finder(out.mesh, out.segmentation);
    auto groups = finder.find_all(project.merges[m], fmt::format("merges[{}]", m));
    if (!groups) return groups.error();
    if (groups->size() < 2) continue;
    auto merged = merge_groups(*out.mesh, out.segmentation, *groups, {}, run);
    if (auto done = adopt(std::move(merged), out); !done) return done.error();
  }
  out.query = std::make_shared<const MeshQuery>(out.mesh);
  return out;
}

Result<std::vector<int>> find_groups(const PreparedMesh& prepared,
                                     const std::vector<GroupRef>& refs, const std::string& where) {
  return GroupFinder(prepared.mesh, prepared.segmentation, prepared.query).find_all(refs, where);
}

Result<std::vector<Partition>> resolve_partitions(const Project& project,
                                                  const PreparedMesh& prepared,
                                                  const RunContext& run) {
  Resolver resolver(project, prepared);
  if (auto done = resolver.add(project.root, -1, false, ""); !done) return done.error();
  return resolver.finish(run);
}

SurfaceSet with_cut_planes(const SurfaceSet& surfaces, const Project& project,
                           const Partition& partition) {
  SurfaceSet out = surfaces;
  for (const int c : partition.touching_cuts) {
    const CutStep& cut = project.cuts[c];
    Halfspace plane;
    plane.surface.kind = SurfaceKind::Plane;
    plane.surface.axis = cut.normal;
    plane.surface.offset = cut.offset;
    plane.surface.point = cut.normal * cut.offset;
    plane.is_separating = true;
    for (std::size_t d = 0; d < out.directions.size() && plane.direction < 0; ++d) {
      const double along = out.directions[d].dot(cut.normal);
      if (std::abs(along) < 1 - 1e-12) continue;
      plane.direction = static_cast<int>(d);
      plane.surface.axis = along > 0 ? out.directions[d] : Vec3(-out.directions[d]);
    }
    if (plane.direction < 0) {
      plane.direction = static_cast<int>(out.directions.size());
      out.directions.push_back(cut.normal);
    }
    out.halfspaces.push_back(plane);
  }
  return out;
}

}  // namespace hewn
