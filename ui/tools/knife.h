#pragma once
/// Aiming a cut: from a line on the screen, or from numbers.
#include "ui/studio_state.h"
#include "ui/view/pixels.h"

namespace hewn {

/// The plane through the line from `knife.from` to `knife.to` and the eye, snapped to corners at
/// the line's ends, to directions, and to what lies near; Alt leaves it as drawn. Counts the groups
/// that it would divide.
void aim_knife(Ui& ui, const ViewArea& area);

/// Puts another plane in place, as a number entry does.
void set_knife_plane(Ui& ui, const SnappedPlane& plane);

}  // namespace hewn
