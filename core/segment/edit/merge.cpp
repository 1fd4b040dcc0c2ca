#include "core/segment/edit/merge.h"

#include <algorithm>
#include <numeric>
#include <utility>

#include "core/segment/curvature/fit_primitive.h"
#include "core/segment/measure_group.h"

namespace hewn {
namespace {

/// The simplest surface that fits; `Other` tries all curved kinds.
std::optional<Surface> fit_any(const Mesh& mesh, const std::vector<int>& triangles,
                               const FitLimits& limits) {
  for (const CurvatureClass kind : {CurvatureClass::Planar, CurvatureClass::Conic,
                                    CurvatureClass::Spherical, CurvatureClass::Other}) {
    auto surface = fit_primitive(mesh, triangles, kind, limits);
    if (surface) return surface;
  }
  return std::nullopt;
}

FaceGroup merged_group(const Mesh& mesh, const Segmentation& segmentation,
                       const std::vector<int>& groups, const FitLimits& limits) {
  FaceGroup merged;
  for (const int g : groups) {
    const std::vector<int>& more = segmentation.groups[g].triangles;
    merged.triangles.insert(merged.triangles.end(), more.begin(), more.end());
  }
  std::sort(merged.triangles.begin(), merged.triangles.end());
  const auto surface = fit_any(mesh, merged.triangles, limits);
  merged.is_fitted = surface.has_value();
  if (surface) {
    merged.surface = *surface;
    refit(mesh, merged.triangles, merged.surface);
  } else {
    double least = kInfinity;
    for (const int g : groups) {
      const double rms = rms_of(mesh, merged.triangles, segmentation.groups[g].surface);
      if (rms < least) merged.surface = segmentation.groups[g].surface;
      least = std::min(least, rms);
    }
  }
  measure_group(mesh, merged);
  return merged;
}

}  // namespace

Result<EditedSegmentation> merge_groups(const Mesh& mesh, const Segmentation& segmentation,
                                        std::span<const int> groups, const MergeOptions& options,
                                        const RunContext& run) {
  if (const auto checked = check_groups(segmentation, groups); !checked) return checked.error();
  std::vector<int> chosen(groups.begin(), groups.end());
  std::sort(chosen.begin(), chosen.end());
  chosen.erase(std::unique(chosen.begin(), chosen.end()), chosen.end());
  if (chosen.size() < 2) {
    return Error{ErrorCode::InvalidArgument, "choose at least two face groups to merge"};
  }
  const double diagonal = mesh.diagonal();
  const FitLimits limits{diagonal, options.fit_distance * diagonal,
                         options.fit_normal_deg * kPi / 180};
  EditedSegmentation out;
  out.mesh = mesh;
  out.source_triangle.resize(mesh.triangles.size());
  std::iota(out.source_triangle.begin(), out.source_triangle.end(), 0);
  out.segmentation = segmentation;
  Segmentation& after = out.segmentation;
  after.groups.clear();
  std::vector<int> new_index(segmentation.groups.size(), -1);
  for (int g = 0; g < static_cast<int>(segmentation.groups.size()); ++g) {
    if (run.is_cancelled()) return RunContext::cancelled();
    const bool is_chosen = std::binary_search(chosen.begin(), chosen.end(), g);
    if (is_chosen && g != chosen.front()) {
      new_index[g] = new_index[chosen.front()];
      continue;
    }
    new_index[g] = static_cast<int>(after.groups.size());
    out.source_group.push_back(g);
    after.groups.push_back(is_chosen ? merged_group(mesh, segmentation, chosen, limits)
                                     : segmentation.groups[g]);
  }
  for (int& g : after.group_of_triangle) {
    if (g >= 0) g = new_index[g];
  }
  return out;
}

}  // namespace hewn
