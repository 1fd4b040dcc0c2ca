#include <algorithm>
#include <map>
#include <utility>

#include "core/fit/axis_lines.h"
#include "core/fit/cone_sizes.h"
#include "core/fit/directions.h"
#include "core/fit/fit_items.h"
#include "core/fit/regular_prisms.h"
#include "core/fit/surface_set.h"
#include "core/fit/tessellation.h"

namespace hewn {
namespace {

constexpr double kMinConeAngle = kPi / 180;  // flatter flanks are cylinders
constexpr double kMaxTolerance = 6e-3;       // shares of the diagonal
constexpr double kDeep = 1e-3;
constexpr double kMinTolerance = 1e-5;
constexpr double kSameAngle = 0.003;  // radians, of merged cones
constexpr double kMaxWedge = 0.05;    // radians between surfaces that one may take for another

/// A cone so steep that it is a cylinder of its mean radius.
void replace_steep_cone(FitItem& item) {
  Surface& s = item.surface;
  if (s.kind != SurfaceKind::Cone || s.half_angle_rad >= kMinConeAngle) return;
  double sum = 0;
  for (const Vec3& p : item.points) {
    const Vec3 d = p - s.point;
    sum += (d - s.axis * s.axis.dot(d)).norm();
  }
  s.kind = SurfaceKind::Cylinder;
  s.radius = sum / static_cast<double>(item.points.size());
  s.point += s.axis * s.axis.dot(item.center - s.point);
}

/// Whether two surfaces of one kind and direction are the same within `reach`.
bool is_same(const Surface& a, const Surface& b, double reach) {
  const double apart = (a.point - b.point).norm();
  switch (a.kind) {
    case SurfaceKind::Plane:
      return std::abs(a.offset - b.offset) < reach;
    case SurfaceKind::Sphere:
    case SurfaceKind::Cylinder:
      return apart < 2 * reach && std::abs(a.radius - b.radius) < 2 * reach;
    case SurfaceKind::Cone:
      return apart < 6 * reach && a.axis.dot(b.axis) > 0 &&
             std::abs(a.half_angle_rad - b.half_angle_rad) < kSameAngle;
    case SurfaceKind::Torus:
      return apart < 3 * reach && std::abs(a.radius - b.radius) < 2 * reach &&
             std::abs(a.major_radius - b.major_radius) < 2 * reach;
  }
  return false;
}

/// Mean signed distance over a triangle: exact for quadratic functions.
double mean_distance(const Surface& s, const Mesh& mesh, int t) {
  double sum = 0;
  for (int k = 0; k < 3; ++k) {
    sum += s.signed_distance((mesh.corner(t, k) + mesh.corner(t, (k + 1) % 3)) / 2);
  }
  return sum / 3;
}

class SetBuilder {
 public:
  SetBuilder(const Mesh& mesh, const Segmentation& segmentation, double reach)
      : mesh_(mesh), segmentation_(segmentation), reach_(reach) {
    set_.halfspace_of_group.assign(segmentation.groups.size(), -1);
  }

  void add(const FitItem& item) {
    std::vector<int>& alike = alike_[{item.surface.kind, item.direction}];
    const auto same = std::find_if(alike.begin(), alike.end(), [&](int k) {
      return is_same(set_.halfspaces[k].surface, item.surface, reach_);
    });
    int found = same == alike.end() ? -1 : *same;
    const bool is_new = found < 0;
    if (is_new) found = find_close(item);
    if (found < 0) {
      found = static_cast<int>(set_.halfspaces.size());
      Halfspace h;
      h.surface = item.surface;
      h.direction = item.direction;
      set_.halfspaces.push_back(h);
      groups_.emplace_back();
      sigma_.push_back(item.sigma);
      alike.push_back(found);
      if (item.surface.kind == SurfaceKind::Plane) {
        planes_.push_back({item.surface.axis, item.surface.offset, found});
      } else {
        curved_.push_back(found);
      }
    } else if (!is_new && item.sigma < 0.1 * sigma_[found]) {
      replace_surface(found, item);
    }
    set_.halfspaces[found].area += item.area;
    set_.halfspace_of_group[item.group] = found;
    groups_[found].push_back(item.group);
  }

  SurfaceSet finish(const std::vector<Vec3>& directions, bool round_values) {
    keep_used(directions);
    for (std::size_t k = 0; k < set_.halfspaces.size(); ++k) {
      measure(set_.halfspaces[k], groups_[k]);
    }
    for (const int k : settle_regular_prisms(set_, mesh_.diagonal(), round_values)) {
      measure(set_.halfspaces[k], groups_[k]);
    }
    for (std::size_t k = 0; k < set_.halfspaces.size(); ++k) {
      Halfspace& h = set_.halfspaces[k];
      if (h.surface.kind == SurfaceKind::Sphere) {
        const SphereTessellation found =
            detect_sphere_tessellation(h.surface, groups_[k], mesh_, segmentation_);
        h.surface.axis = found.axis;
        h.facets = found.facets;
      } else {
        h.facets = detect_tessellation(h.surface, groups_[k], mesh_, segmentation_);
      }
    }
    set_.unexplained_area = std::clamp(1 - explained_area() / mesh_.total_area, 0.0, 1.0);
    return std::move(set_);
  }

 private:
  struct PlaneEntry {
    Vec3 normal;
    double offset;
    int halfspace;
  };

  /// Takes the surface of an item that is far more exact.
  void replace_surface(int k, const FitItem& item) {
    set_.halfspaces[k].surface = item.surface;
    sigma_[k] = item.sigma;
    for (PlaneEntry& e : planes_) {
      if (e.halfspace == k) e = {item.surface.axis, item.surface.offset, k};
    }
  }

  /// A larger surface of the same kind that the whole group lies on within reach: what lay between
  /// both would be thinner than any wall.
  int find_close(const FitItem& item) const {
    const FaceGroup& group = segmentation_.groups[item.group];
    const Vec3 corner = mesh_.corner(group.triangles.front(), 0);
    const bool is_plane = item.surface.kind == SurfaceKind::Plane;
    for (const int k : is_plane ? planes_near(corner) : curved_) {
      const Surface& s = set_.halfspaces[k].surface;
      if (s.kind != item.surface.kind || set_.halfspaces[k].area < group.area) continue;
      const double cosine = s.gradient(item.center).dot(item.surface.gradient(item.center));
      if (std::abs(cosine) < std::cos(kMaxWedge)) continue;
      const bool is_close = std::all_of(group.triangles.begin(), group.triangles.end(),
                                        [&](int t) { return is_within(s, t, reach_); });
      if (is_close) return k;
    }
    return -1;
  }

  /// Free-form meshes have tens of thousands of planes: one compact pass tells most apart.
  std::vector<int> planes_near(const Vec3& p) const {
    std::vector<int> near;
    for (const PlaneEntry& e : planes_) {
      if (std::abs(e.normal.dot(p) - e.offset) <= reach_) near.push_back(e.halfspace);
    }
    return near;
  }

  bool is_within(const Surface& s, int t, double limit) const {
    return std::all_of(mesh_.triangles[t].begin(), mesh_.triangles[t].end(), [&](int v) {
      return std::abs(s.signed_distance(mesh_.vertices[v])) <= limit;
    });
  }

  /// Drops directions that only merged surfaces had.
  void keep_used(const std::vector<Vec3>& directions) {
    std::vector<int> index(directions.size(), -1);
    for (const Halfspace& h : set_.halfspaces) {
      if (h.direction >= 0) index[h.direction] = 0;
    }
    for (std::size_t k = 0; k < directions.size(); ++k) {
      if (index[k] < 0) continue;
      index[k] = static_cast<int>(set_.directions.size());
      set_.directions.push_back(directions[k]);
    }
    for (Halfspace& h : set_.halfspaces) {
      if (h.direction >= 0) h.direction = index[h.direction];
    }
  }

  /// Of the triangles that lie on a surface that was fitted to them.
  double explained_area() const {
    const double limit = kMaxTolerance * mesh_.diagonal();
    double explained = 0;
    for (std::size_t k = 0; k < set_.halfspaces.size(); ++k) {
      for (const int g : groups_[k]) {
        const FaceGroup& group = segmentation_.groups[g];
        if (!group.is_fitted) continue;
        for (const int t : group.triangles) {
          if (is_within(set_.halfspaces[k].surface, t, limit)) explained += mesh_.areas[t];
        }
      }
    }
    return explained;
  }

  void measure(Halfspace& h, const std::vector<int>& groups) const {
    double worst = 0, deepest = 0, sum = 0, area = 0;
    for (const int g : groups) {
      for (const int t : segmentation_.groups[g].triangles) {
        for (const int v : mesh_.triangles[t]) {
          worst = std::max(worst, std::abs(h.surface.signed_distance(mesh_.vertices[v])));
        }
        for (int k = 0; k < 3; ++k) {
          const Vec3 middle = (mesh_.corner(t, k) + mesh_.corner(t, (k + 1) % 3)) / 2;
          deepest = std::max(deepest, std::abs(h.surface.signed_distance(middle)));
        }
        // A sliver's centre tells nothing, and its normal even less.
        if (mesh_.areas[t] <= 0) continue;
        worst = std::max(worst, std::abs(h.surface.signed_distance(mesh_.centroid(t))));
        sum += mesh_.areas[t] * mean_distance(h.surface, mesh_, t);
        area += mesh_.areas[t];
      }
    }
    const double diagonal = mesh_.diagonal();
    // A side is a little deeper where its diagonal has its middle. That counts where sides are
    // deep: else points so near are better had, though a few are on the other side.
    if (deepest > kDeep * diagonal) worst = std::max(worst, deepest);
    h.tolerance = std::min(worst, kMaxTolerance * diagonal) * 1.05 + kMinTolerance * diagonal;
    h.mean_offset = h.surface.kind == SurfaceKind::Plane || area <= 0 ? 0 : sum / area;
  }

  const Mesh& mesh_;
  const Segmentation& segmentation_;
  double reach_;
  SurfaceSet set_;
  std::vector<std::vector<int>> groups_;
  std::vector<double> sigma_;
  std::map<std::pair<SurfaceKind, int>, std::vector<int>> alike_;  ///< by kind and direction
  std::vector<PlaneEntry> planes_;
  std::vector<int> curved_;  ///< ascending
};

}  // namespace

template <>
std::span<const OptionField<RegulariseOptions>> option_table<RegulariseOptions>() {
  using O = RegulariseOptions;
  static constexpr OptionField<O> kFields[] = {
      {"snap-distance", &O::snap_distance, 0, 1e-2,
       "shift by which surfaces are made parallel or merged, as a share of the diagonal"},
      {"max-turn", &O::max_turn_deg, 0, 5,
       "degrees by which a small surface may be turned to be parallel"},
      {"round-deviations", &O::round_deviations, 0, 20,
       "standard deviations of the fit within which values become round"},
      {"round-values", &O::round_values, 0, 1, "snap radii, positions and angles to round values"},
      {"keep-free-form", &O::keep_free_form, 0, 1,
       "use the small planes of free-form patches like other surfaces"},
  };
  return kFields;
}

Result<SurfaceSet> regularise(const Mesh& mesh, const Segmentation& segmentation,
                              const RegulariseOptions& options, const RunContext& run) {
  run.report("regularise", 0);
  const double diagonal = mesh.diagonal();
  std::vector<FitItem> items = collect_items(mesh, segmentation, options.keep_free_form);
  if (run.is_cancelled()) return RunContext::cancelled();
  for (FitItem& item : items) replace_steep_cone(item);
  const std::vector<Vec3> directions = assign_directions(items, diagonal, options);
  settle_positions(items, directions, diagonal, segmentation.noise, options);
  settle_radii(items, diagonal, segmentation.noise, options);
  settle_cone_sizes(items, diagonal, segmentation.noise, options);
  if (run.is_cancelled()) return RunContext::cancelled();
  SetBuilder builder(mesh, segmentation, options.snap_distance * diagonal);
  for (const FitItem& item : items) {
    if (run.is_cancelled()) return RunContext::cancelled();
    builder.add(item);
  }
  run.report("regularise", 1);
  return builder.finish(directions, options.round_values);
}

}  // namespace hewn
