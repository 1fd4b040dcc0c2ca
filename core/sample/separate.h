#pragma once
/// Separating surfaces: halfspaces on which no face group lies, but without which inside and
/// outside cannot be told apart (a fillet needs the planes where it ends).
#include <array>
#include <vector>

#include "core/sample/cells.h"
#include "core/sample/sample_table.h"

namespace hewn {

struct SeparatingCandidates {
  std::vector<Halfspace> halfspaces;
  /// Two planes each, by index, that only together cut off what lies beyond an arc: the corner of
  /// a box that a rounding takes away.
  std::vector<std::array<int, 2>> pairs;
};

/// Planes (and cylinders) that designers' constructions imply for curved face groups: through
/// axes, chords and extents; and the sides of the frame's box. None repeats a known halfspace.
/// New directions are appended to `surfaces.directions`.
SeparatingCandidates separating_candidates(const SampleSpace& space, SurfaceSet& surfaces);

/// What cuts off the corner beyond an arc.
enum class ArcCut {
  Chord,   ///< one plane through the arc's ends, mostly at an odd angle
  Corner,  ///< two planes through the arc's axis, where they lie along or across the part
};

struct Separation {
  int added = 0;    ///< halfspaces
  int corners = 0;  ///< pairs among them
};

/// Adds candidates greedily by the number of conflicting points that they resolve, to
/// `surfaces.halfspaces`, `table` and `cells`, until hardly a conflict is left.
/// Requires: `space.halfspaces == &surfaces.halfspaces`.
Separation add_separating_halfspaces(const SampleSpace& space, SurfaceSet& surfaces,
                                     SampleTable& table, Cells& cells, ArcCut cut,
                                     const RunContext& run);

}  // namespace hewn
