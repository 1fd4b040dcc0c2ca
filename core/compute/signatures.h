#pragma once
/// On which sides of surfaces points lie, as bit columns or as one signature a point.
#include <span>
#include <vector>

#include "core/base/math.h"
#include "core/base/run_context.h"
#include "core/compute/device.h"
#include "core/compute/kernels/surface_form.h"

namespace hewn {

/// Bit i of column k tells that point i is inside surface k; columns have
/// `padded_words(points.size())` words, zero beyond the last point.
///
/// Requires: `columns.size()` is that times the number of surfaces.
/// Fails with: the device's errors, Cancelled.
/// Cost: O(surfaces x points), in parts that fit into the device's memory.
Result<void> fill_columns(Device& device, std::span<const SurfaceForm> surfaces,
                          std::span<const Vec3> points, std::span<Word> columns,
                          const RunContext& run);

/// A table of signatures, `stride` words a point.
struct SignatureRows {
  std::span<Word> words;
  std::size_t stride = 0;
};

/// Sets bit `first_bit + k` of point i's signature if it is inside surface k.
///
/// Requires: these bits are clear and within the stride; `rows` has `points.size()` rows.
/// Fails, costs: as `fill_columns`.
Result<void> add_signatures(Device& device, std::span<const SurfaceForm> surfaces,
                            std::span<const Vec3> points, std::size_t first_bit,
                            const SignatureRows& rows, const RunContext& run);

/// Numbers the distinct rows in order of their first appearance, and returns each row's number.
///
/// Fails with: the device's errors, TooLarge (2^30 rows or more).
/// Cost: O(words), in one part.
Result<std::vector<int>> number_distinct_rows(Device& device, std::span<const Word> words,
                                              std::size_t stride);

/// Estimates for `Compute::run`: measured on one core (docs/performance.md).
inline double seconds_for_sides(std::size_t surfaces, std::size_t points) {
  return 7e-9 * static_cast<double>(surfaces) * static_cast<double>(points);
}
inline double seconds_for_rows(std::size_t rows, std::size_t stride) {
  return (1e-8 + 8e-9 * static_cast<double>(stride)) * static_cast<double>(rows);
}

}  // namespace hewn
