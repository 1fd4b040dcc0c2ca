#pragma once
/// Small pieces that several panels use.
#include <string>

#include "ui/actions.h"
#include "ui/panels/panels.h"

namespace hewn {

/// A window without a frame at a fixed place; call ImGui::End after it. Its background is part of
/// the studio's backing.
void begin_panel(const char* name, const PanelArea& area, ImGuiWindowFlags extra = 0);

/// A card that floats over the part, sized to its content; call `end_card` after it.
/// `anchor`: the point of the card, 0 to 1, that is put at (x, y).
void begin_card(const Ui& ui, const char* name, float x, float y, ImVec2 anchor);
void end_card();

/// A small heading in capitals with a line of space above it.
void heading(const Ui& ui, const char* text);

/// Text that is less important.
void faint_text(const Ui& ui, const std::string& text);

/// Ends at the right edge of the space that is left.
void right_aligned(const std::string& text);

/// A tooltip with a sentence and the key of the action.
void action_tip(const Action& action);

/// A button that runs an action; grey when it cannot be run now. `label`: the title when null.
bool action_button(Ui& ui, const char* title, const char* label = nullptr, float width = 0);

/// A button of the toolbar that stays pressed while `is_on`.
bool toggle_button(const Ui& ui, const std::string& label, bool is_on, float width = 0);

/// The icon and a space when icons are there; else nothing.
std::string with_icon(const Ui& ui, const char* icon, const std::string& text);

/// A round dot of the colour, as high as the text line, and a space.
void dot(const Ui& ui, const ImVec4& colour);

/// `text` cut to `width` pixels with an ellipsis.
std::string fitted(const std::string& text, float width);

}  // namespace hewn
