#pragma once
/// Separating surfaces: halfspaces on which no face group lies, but without which inside and
/// outside cannot be told apart (a fillet needs the planes where it ends).
#include <vector>

#include "core/sample/cells.h"
#include "core/sample/sample_table.h"

namespace hewn {

/// Planes (and cylinders) that designers' constructions imply for curved face groups: through
/// axes, chords and extents; and the sides of the frame's box. None repeats a known halfspace.
/// New directions are appended to `surfaces.directions`.
std::vector<Halfspace> separating_candidates(const SampleSpace& space, SurfaceSet& surfaces);

/// Adds candidates greedily by the number of conflicting points that they resolve, to
/// `surfaces.halfspaces`, `table` and `cells`, until hardly a conflict is left. Returns how many.
/// Requires: `space.halfspaces == &surfaces.halfspaces`.
int add_separating_halfspaces(const SampleSpace& space, SurfaceSet& surfaces, SampleTable& table,
                              Cells& cells, const RunContext& run);

}  // namespace hewn
