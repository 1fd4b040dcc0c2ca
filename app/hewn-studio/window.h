#pragma once
/// The window: GLFW, OpenGL and Dear ImGui wired together. Redraws only when something has changed.
#include <filesystem>
#include <memory>

#include "app/hewn-studio/frame_stats.h"
#include "core/base/result.h"
#include "core/compute/compute.h"
#include "core/session/session.h"

namespace hewn {

struct WindowOptions {
  std::filesystem::path file;      ///< opened at the start; empty: none
  std::filesystem::path record;    ///< the command log goes here as it grows; empty: nowhere
  std::filesystem::path pictures;  ///< folder of the pictures that F12 takes
  std::filesystem::path status;    ///< the window's state goes here as it changes; empty: nowhere
  int width = 0, height = 0;       ///< of the window, pixels; 0: as it was left
  int threads = 0;
  DeviceChoice device;  ///< where the plan leaves it open
  bool has_frame_stats = false;
  bool is_live = true;
};

/// Opens the window and returns when it is closed.
/// Fails with Internal: no display, no OpenGL 4.3.
Result<void> run_window(const WindowOptions& options);

}  // namespace hewn
