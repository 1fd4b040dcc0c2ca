#pragma once
/// Gauss-Newton fits of surfaces, one or many at once.
#include <cstddef>
#include <span>
#include <vector>

#include "core/base/run_context.h"
#include "core/compute/device.h"
#include "core/compute/kernels/fit_kernels.h"

namespace hewn {

/// What one surface is fitted to, centred and of size one (see core/fit/gauss_newton.h).
struct FitRows {
  /// Those that are to be on the surface, then those where the normals were measured.
  std::span<const PlainVec> points;
  /// Unit normals of either sign.
  std::span<const PlainVec> normals = {};

  /// How many points are to be on the surface.
  std::size_t on_surface() const { return points.size() - normals.size(); }
};

/// The best surface that is found from `guess`. Cost: O(points x rounds), some 7 ns each; at most
/// `max_iterations` rounds, and 6 for each that finds a better surface only after some attempts.
SurfaceForm fit_alone(const FitTarget& target, const SurfaceForm& guess, const FitRows& rows);

/// Fits that a device does side by side. Each has the outcome, to the bit, that it has alone.
class FitBatch {
 public:
  /// Copies the data. Requires: at least one point; fewer than 2^30 in all fits, with the normals.
  void add(const FitTarget& target, const SurfaceForm& guess, const FitRows& rows);
  std::size_t size() const { return fits_.size(); }

  /// From the guesses on until all fits are done, at a time as many as fit into the device's
  /// memory. Fails with: the device's errors, Cancelled. Cost: as `fit_alone`; two launches a
  /// round.
  Result<void> solve(Device& device, const RunContext& run);

  /// The best surface that was found, after `solve`.
  const SurfaceForm& surface(std::size_t fit) const { return solved_[fit].best; }

  /// Estimate for `Compute::run`: measured on one core (docs/performance.md).
  double seconds() const { return 5e-8 * static_cast<double>(points_.size()); }

 private:
  struct Fit {
    std::size_t first_point, points;  ///< with those of the normals
    std::size_t first_normal, normals;
    std::size_t end_point() const { return first_point + points; }
    std::size_t end_normal() const { return first_normal + normals; }
  };
  Result<void> solve_some(Device& device, std::size_t begin, std::size_t end,
                          const RunContext& run);

  std::vector<Fit> fits_;
  std::vector<FitTarget> targets_;
  std::vector<FitState> starts_, solved_;
  std::vector<PlainVec> points_, normals_;
};

}  // namespace hewn
