#pragma once
/// Patches that lie on one surface, wherever on it.
#include "core/csg/boundary/boundary_model.h"

namespace hewn {

/// Whether both patches lie on one plane, one cylinder or one sphere, whichever way they face.
bool on_same_surface(const BoundaryModel& model, const BoundaryPatch& a, const BoundaryPatch& b);

}  // namespace hewn
