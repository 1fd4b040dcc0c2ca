#pragma once
/// Everything with a name: one table for menus, shortcuts, the palette and the list of keys.
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "ui/studio_state.h"

namespace hewn {

/// Bits of `Action::mods`; the values are GLFW's.
inline constexpr int kShift = 1;
inline constexpr int kCtrl = 2;
inline constexpr int kAlt = 4;

struct Action {
  const char* menu;   ///< "File", "Edit", "Select", "View", "Help"
  const char* title;  ///< "Export the tree"
  int key = 0;        ///< GLFW key code: letters and digits are their capitals; 0: none
  int mods = 0;
  const char* help;  ///< one sentence
  std::function<bool(const Ui&)> is_enabled;
  std::function<void(Ui&)> run;
};

/// The table in the order of the menus.
std::vector<Action> make_actions();

/// "Ctrl+Shift+P"; empty without a key.
std::string shortcut_text(const Action& action);

/// Runs the action of the key when there is one and it is enabled; false otherwise.
bool run_shortcut(Ui& ui, int key, int mods);

/// The action with this title. Requires: it exists.
const Action& action_named(const Ui& ui, const char* title);

/// Hidden groups and those of locked partitions are left out of selections.
void select_groups(Ui& ui, const std::vector<int>& groups, Combine how);

/// Opens a mesh or project, or asks first when the plan is not saved. False: it cannot be opened;
/// the notices say why.
bool request_open(Ui& ui, const std::filesystem::path& path);

/// Closes the window, or asks first when the plan is not saved; asked for again, it closes.
void request_quit(Ui& ui);

/// Carries out what was asked about, without saving. Requires: `leaving`.
void leave_now(Ui& ui);

/// Forgets what belongs to the part that was open before.
void reset_view(StudioState& state);

}  // namespace hewn
