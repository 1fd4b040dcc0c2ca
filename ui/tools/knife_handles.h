#pragma once
/// Handles on the plane that is being placed: one moves it along its normal, two turn it.
#include <array>

#include "ui/studio_state.h"
#include "ui/view/look.h"

namespace hewn {

enum class KnifeHandle { None, Move, TurnU, TurnW };

/// The handle under a window pixel; None when there is no plane or nothing is near.
KnifeHandle knife_handle_at(const Ui& ui, const ViewArea& area, const std::array<float, 2>& pixel);

/// Follows a drag of so many pixels. Turning keeps the point of the plane that is nearest to the
/// part's middle.
void drag_knife_handle(Ui& ui, const ViewArea& area, KnifeHandle handle,
                       const std::array<double, 2>& pixels);

/// In the current Dear ImGui window.
void draw_knife_handles(const Ui& ui, const ViewArea& area);

}  // namespace hewn
