#pragma once
/// Measuring: two places of the part, and what lies between them.
#include <array>
#include <string>
#include <vector>

#include "ui/studio_state.h"
#include "ui/view/pixels.h"

namespace hewn {

/// Takes note of the place under a window pixel: a corner if there is one (else null), or a place
/// of the group that is seen there (-1: none).
void hover_spot(Ui& ui, const ViewArea& area, const std::array<float, 2>& pixel, int group,
                const Corner* corner);

/// Adds the place under the mouse; a third begins anew, a click beside the part forgets all.
void take_spot(MeasureState& measure);

/// Of one spot, or between the two, the one under the mouse for the second; empty: nothing yet.
std::vector<Dimension> measured(const Ui& ui);

/// Four significant digits, with a degree sign for angles.
std::string dimension_text(const Dimension& dimension);

/// The spots and the first dimension, in the current Dear ImGui window.
void draw_measure(const Ui& ui, const ViewArea& area);

}  // namespace hewn
