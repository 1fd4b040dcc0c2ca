#pragma once
/// Small marks over the part.
#include <string>

#include "ui/studio_state.h"

namespace hewn {

/// Text on a small card to the lower right of a window pixel, in the current Dear ImGui window.
void draw_label(const Ui& ui, const ImVec2& beside, const std::string& text);

}  // namespace hewn
