#pragma once
/// Handles on a plane in the view, the knife's or the section's: one moves it along its normal, two
/// turn it.
#include <array>
#include <optional>

#include "ui/studio_state.h"
#include "ui/view/pixels.h"

namespace hewn {

enum class PlaneHandle { None, Move, TurnU, TurnW };

/// The handle under a window pixel; None when no plane has handles now or nothing is near.
PlaneHandle plane_handle_at(const Ui& ui, const ViewArea& area, const std::array<float, 2>& pixel);

/// Follows a drag of so many pixels. Turning keeps the point of the plane that is nearest to the
/// part's middle.
void drag_plane_handle(Ui& ui, const ViewArea& area, PlaneHandle handle,
                       const std::array<double, 2>& pixels);

/// In the current Dear ImGui window.
void draw_plane_handles(const Ui& ui, const ViewArea& area);

}  // namespace hewn
