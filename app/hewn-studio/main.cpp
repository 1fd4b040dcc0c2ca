/// The window's program: parses, wires, runs.
#include <cstdio>
#include <exception>

#include <CLI/CLI.hpp>

#include "app/heap.h"
#include "app/hewn-studio/window.h"

int main(int argc, char** argv) {
  hewn::keep_freed_memory();
  hewn::use_large_pages();
  CLI::App app{"Hewn Studio: cut, select and partition a mesh, and watch its CSG tree appear."};
  app.set_version_flag("--version", "hewn-studio " HEWN_VERSION);
  hewn::WindowOptions options;
  bool is_manual = false;
  app.add_option("file", options.file, "mesh (.off .stl .obj .ply) or project (.json)");
  app.add_option("--record", options.record, "write the log of commands here, for `hewn replay`");
  app.add_option("--pictures", options.pictures, "folder of the pictures that F12 takes");
  app.add_option("--status", options.status,
                 "write the window's state here as JSON whenever it changes, for scripts");
  app.add_option("--width", options.width, "of the window, pixels")->check(CLI::Range(640, 16384));
  app.add_option("--height", options.height, "of the window, pixels")
      ->check(CLI::Range(480, 16384));
  app.add_option("--threads", options.threads, "worker threads; 0: one per core")
      ->check(CLI::Range(0, 1024));
  std::string device = "auto";
  app.add_option("--device", device, "auto, cpu, cuda or cuda:INDEX; never changes a result");
  app.add_flag("--no-live", is_manual, "reconstruct only when asked to");
  app.add_flag("--frame-stats", options.has_frame_stats, "print frame times as JSON at the end");
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& problem) {
    return app.exit(problem) == 0 ? 0 : 2;
  }
  options.is_live = !is_manual;
  const auto choice = hewn::DeviceChoice::parse(device);
  if (!choice) {
    std::fprintf(stderr, "hewn-studio: --device: %s\n", choice.error().message.c_str());
    return 2;
  }
  options.device = *choice;
  try {
    const auto done = hewn::run_window(options);
    if (done) return 0;
    std::fprintf(stderr, "hewn-studio: %s\n", done.error().message.c_str());
  } catch (const std::exception& bug) {
    std::fprintf(stderr, "hewn-studio: something inside broke: %s\n", bug.what());
  }
  return 1;
}
