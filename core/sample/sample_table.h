#pragma once
/// Labelled points and, for each, on which side of every halfspace it lies.
#include <cstdint>
#include <functional>
#include <vector>

#include "core/base/result.h"
#include "core/base/rng.h"
#include "core/base/run_context.h"
#include "core/compute/bits.h"
#include "core/sample/frame.h"
#include "core/sample/labeller.h"

namespace hewn {

/// A point with a certain label, further from every surface than that surface's tolerance.
struct LabelledPoint {
  Vec3 position = Vec3::Zero();
  bool is_inside = false;
};

/// Two points on either side of a face group (indices into the table).
struct SamplePair {
  int inside = -1, outside = -1, group = -1;
};

/// Struct of arrays; bit k of a point's signature tells that it is inside halfspace k.
struct SampleTable {
  std::vector<Vec3> points;
  std::vector<char> is_inside;
  std::vector<SamplePair> pairs;
  std::vector<Word> signatures;  ///< `stride` words per point
  std::size_t stride = 0;
  std::size_t halfspaces = 0;  ///< columns in use, at most 64 * stride

  std::size_t size() const { return points.size(); }
  const Word* signature(std::size_t point) const { return signatures.data() + point * stride; }
};

/// The problem's geometry, as every sampling function needs it.
struct SampleSpace {
  const Labeller* label = nullptr;
  const Segmentation* segmentation = nullptr;
  const std::vector<Halfspace>* halfspaces = nullptr;
  Frame frame;
  double diagonal = 0;  ///< of the whole mesh: the unit of all tolerances

  const Mesh& mesh() const { return label->query().mesh(); }
};

/// True when `p` is no closer to any halfspace's surface than its tolerance.
bool is_certain(const SampleSpace& space, const Vec3& p);

/// Proposes points for one chunk; `emit(p)` labels and keeps the certain ones.
using Proposal =
    std::function<void(std::size_t chunk, Rng& rng, const std::function<void(const Vec3&)>& emit)>;

/// Runs `chunks` proposals in parallel, each with its own generator, and appends the kept points
/// in chunk order: the result does not depend on the number of threads. When the run is cancelled,
/// points and signatures may be missing.
void append_proposed(SampleTable& table, const SampleSpace& space, std::size_t chunks,
                     std::uint64_t stream, const RunContext& run, const Proposal& proposal);

/// A point just outside one side of the frame's box, or up to a third of the diagonal away.
Vec3 sample_around_box(const SampleSpace& space, Rng& rng);

/// A point of the frame's box enlarged by `margin` (a share of its size) on every side.
Vec3 sample_in_box(const SampleSpace& space, double margin, Rng& rng);

/// The first table: uniform points, points outside the box, pairs and near points per face group.
/// `halfspace_of_group` as in `SurfaceSet`. Fails with: Cancelled.
Result<SampleTable> build_sample_table(const SampleSpace& space, int volume_points,
                                       const std::vector<int>& halfspace_of_group,
                                       const RunContext& run);

/// Appends points and their signatures. Requires: all are certain. When the run is cancelled, some
/// signatures may be missing.
void append_points(SampleTable& table, const std::vector<Halfspace>& halfspaces,
                   const std::vector<LabelledPoint>& points, const RunContext& run);

/// Appends a signature column for each halfspace beyond `table.halfspaces`, as `append_points`
/// does.
void append_halfspaces(SampleTable& table, const std::vector<Halfspace>& halfspaces,
                       const RunContext& run);

}  // namespace hewn
