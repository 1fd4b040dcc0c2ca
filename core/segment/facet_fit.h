#pragma once
/// Fitting surfaces to sets of facets: gathers their corners and normals, and measures the outcome.
#include <optional>
#include <span>
#include <vector>

#include "core/csg/surface.h"
#include "core/segment/facets.h"

namespace hewn {

/// Lengths that decide what lies on a surface, model units.
struct SurfaceTolerance {
  double diagonal = 0;
  double noise = 0;  ///< standard deviation of vertices about their surface
  double eps = 0;    ///< what two vertices of one exact surface may differ by
  /// Vertices lie anywhere on the flat facets of an earlier tessellation, not only on the surface.
  bool is_resampled = false;
};

/// Times the depth of facets: how deep corners on their chords lie.
inline constexpr double kChordSlack = 1.15;

/// How a surface meets facets.
struct FitQuality {
  double max_distance = 0;   ///< of corners
  double rms_distance = 0;   ///< of corners
  double max_angle_rad = 0;  ///< between the surface's gradient and a facet's normal
  double sagitta = 0;        ///< largest distance of a facet's centre

  /// The largest `max_angle_rad` of a surface that counts as no rougher, radians.
  double angle_as_smooth() const { return 1.2 * max_angle_rad + 0.01; }
};

struct FacetFitSettings {
  int max_iterations = 8;
  bool is_robust = false;
  double normal_weight = 0;
};

/// Not thread-safe: holds scratch memory. Facets are given by index, each at most once.
class FacetFitter {
 public:
  FacetFitter(const Mesh& mesh, const FacetGraph& graph, const SurfaceTolerance& tolerance);

  /// The facets' corners, each once, ascending; at most `limit`, evenly picked.
  std::vector<Vec3> corner_points(std::span<const int> facets, std::size_t limit);
  std::vector<int> corner_indices(std::span<const int> facets);

  /// First guesses for a patch.
  std::vector<Surface> guess(std::span<const int> facets);
  /// Gauss-Newton on the corners. False when the fit degenerates.
  bool refine(Surface& surface, std::span<const int> facets, const FacetFitSettings& settings);
  /// Whether all corners lie on the surface, so that nothing was cut.
  bool has_exact_corners(const FitQuality& quality) const {
    return quality.rms_distance < 0.5 * tolerance_.eps;
  }
  /// Fits to what cutting the facets did not move: a cylinder or cone to their planes (see
  /// tangent_planes.h), a sphere to the corners that none but these facets share. Returns
  /// the root mean square of what then deviates (infinite: too little is known); moves `surface`
  /// only when all corners are off and the others agree.
  double refine_uncut(Surface& surface, std::span<const int> facets, const FitQuality& quality);
  /// The facet's own plane: its normal is area-weighted, so more exact than any fit to corners.
  Surface plane_of(int facet) const;
  FitQuality evaluate(const Surface& surface, std::span<const int> facets) const;
  /// Largest distance of a facet's corners.
  double max_distance(const SurfaceField& surface, int facet) const;
  double max_distance(const Surface& surface, int facet) const {
    return max_distance(SurfaceField(surface), facet);
  }

  /// Largest distance of a facet's corners and its centre: all corners of a chord lie on a
  /// cylinder.
  double max_depth(const SurfaceField& surface, int facet) const;
  double max_depth(const Surface& surface, int facet) const {
    return max_depth(SurfaceField(surface), facet);
  }

  /// Too small for its normal to mean anything.
  bool is_tiny(int facet) const;
  /// Large enough for its normal to be trusted.
  bool is_solid(int facet) const;

 private:
  double refine_on_planes(Surface& surface, std::span<const int> facets, const FitQuality& quality);
  double refine_on_inner_corners(Surface& surface, std::span<const int> facets,
                                 const FitQuality& quality);
  bool is_determined(const Surface& s, std::span<const Vec3> points, double limit) const;
  /// From the facet's middle to its furthest corner.
  double reach(int facet) const;
  std::vector<Vec3> inner_corners(std::span<const int> facets);
  /// The angle between neighbours' normals, when it is the same for nearly all.
  std::optional<double> regular_turn(std::span<const int> facets);

  const Mesh& mesh_;
  const FacetGraph& graph_;
  SurfaceTolerance tolerance_;
  std::vector<int> stamp_of_vertex_, stamp_of_facet_, uses_;
  int stamp_ = 0;
};

/// Angle between two directions regardless of their sign, [0, pi/2].
double unsigned_angle(const Vec3& a, const Vec3& b);

}  // namespace hewn
