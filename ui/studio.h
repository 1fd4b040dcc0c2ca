#pragma once
/// The whole window's content: lays the panels out and hands keys to actions. Knows neither the
/// window system nor OpenGL, so that tests run it with an engine that draws nothing.
#include <filesystem>
#include <initializer_list>
#include <memory>
#include <string>

#include "ui/actions.h"
#include "ui/panels/panels.h"
#include "ui/view/viewport.h"

namespace hewn {

class Studio {
 public:
  /// Requires: a Dear ImGui context, with `fonts` loaded. All outlive the studio.
  Studio(Session& session, RenderEngine& engine, const Fonts& fonts, float scale);

  /// Everything between ImGui::NewFrame and ImGui::Render.
  void frame(float width, float height);
  /// A key went down or up; GLFW's codes. True when it did something.
  bool key(int key, int mods, bool is_down);
  /// A file was dropped on the window or named on the command line.
  void open(const std::filesystem::path& path);
  bool is_moving() const { return viewport_.is_moving(); }
  /// The picture is rough because it has just changed: draw again soon.
  bool wants_detail() const { return viewport_.wants_detail(); }
  /// What belongs under what Dear ImGui draws; of the last frame.
  const Backing& backing() const { return backing_; }

  /// One line of JSON for scripts that drive the window: what is open, selected, running, found.
  std::string status_line() const;

  StudioState& state() { return state_; }
  Ui& ui() { return ui_; }

  /// View settings that outlive the process: theme, panels, recent files.
  void load_settings(const std::filesystem::path& file);
  Result<void> save_settings(const std::filesystem::path& file) const;

 private:
  void draw_view(const PanelArea& area);
  void draw_cards(const PanelArea& view, const PanelArea& window);
  void set_backing(const PanelArea& view, std::initializer_list<PanelArea> panels,
                   std::initializer_list<PanelArea> splitters);
  void draw_splitter(const char* name, float x, const PanelArea& middle, float& width, float sign);
  void remember_recent();

  StudioState state_;
  std::vector<Action> actions_ = make_actions();
  Ui ui_;
  Viewport viewport_;
  Backing backing_;
  bool was_light_ = false;
};

}  // namespace hewn
