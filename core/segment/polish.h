#pragma once
/// The last fit of a curved group, to the vertices that lie on the true surface.
#include <span>
#include <vector>

#include "core/csg/surface.h"
#include "core/segment/facet_fit.h"

namespace hewn {

/// Refits `surface` to its corners. A tessellation is inscribed: corners that were cut by other
/// faces lie inside the true surface, so when the corners do not agree, the fit narrows down to
/// their outer envelope. Kept only when the envelope's corners agree within the noise.
void polish_on_envelope(Surface& surface, std::span<const Vec3> corners,
                        const SurfaceTolerance& tolerance);

}  // namespace hewn
