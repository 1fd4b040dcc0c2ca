#pragma once
/// The section: a plane that cuts the view open. It changes nothing of the part.
#include <utility>

#include "ui/studio_state.h"

namespace hewn {

/// Through the part's middle across x, y and z in turn, then none. Requires: the document is ready.
void next_section(Ui& ui);

/// Shows the other half.
void flip_section(ViewPlane& section);

/// The coordinate axis that a plane with this unit normal lies across, 0 to 2; -1: it is oblique.
int axis_across(const Vec3& normal);

/// The smallest and the largest normal . x of the part's box. Requires: the document is ready.
std::pair<double, double> extent_along(const Ui& ui, const Vec3& normal);

}  // namespace hewn
