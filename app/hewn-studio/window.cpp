#include "app/hewn-studio/window.h"

#include <epoxy/gl.h>

#define GLFW_INCLUDE_NONE
#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <GLFW/glfw3.h>
#include <backends/imgui_impl_glfw.h>
#include <backends/imgui_impl_opengl3.h>
#include <fmt/format.h>
#include <imgui.h>
#include <unistd.h>

#include "app/hewn-studio/launch.h"
#include "core/base/file.h"
#include "core/io/picture.h"
#include "core/session/recovery.h"
#include "gpu/cuda_device.h"
#include "ui/gl/gl_engine.h"
#include "ui/studio.h"

namespace hewn {
namespace {

/// Dear ImGui settles within this many frames after an event.
constexpr int kFramesPerEvent = 3;
constexpr double kWaitIdle_s = 1.0;
constexpr int kFirstWidth = 1280, kFirstHeight = 800;
constexpr double kWaitBusy_s = 0.1;

/// GLFW, started and ended with the object.
struct GlfwSession {
  bool is_on = glfwInit() == GLFW_TRUE;
  GlfwSession() = default;
  GlfwSession(const GlfwSession&) = delete;
  GlfwSession& operator=(const GlfwSession&) = delete;
  ~GlfwSession() {
    if (is_on) glfwTerminate();
  }
};

struct ImGuiSession {
  ImGuiSession() {
    IMGUI_CHECKVERSION();
    ImGui::CreateContext();
    ImGui::GetIO().IniFilename = nullptr;
  }
  ImGuiSession(const ImGuiSession&) = delete;
  ImGuiSession& operator=(const ImGuiSession&) = delete;
  ~ImGuiSession() {
    ImGui_ImplOpenGL3_Shutdown();
    ImGui_ImplGlfw_Shutdown();
    ImGui::DestroyContext();
  }
};

std::string glfw_reason() {
  const char* text = nullptr;
  glfwGetError(&text);
  return text ? text : "unknown reason";
}

Result<GLFWwindow*> make_window(const WindowOptions& options) {
  glfwWindowHint(GLFW_CONTEXT_VERSION_MAJOR, 4);
  glfwWindowHint(GLFW_CONTEXT_VERSION_MINOR, 3);
  glfwWindowHint(GLFW_OPENGL_PROFILE, GLFW_OPENGL_CORE_PROFILE);
  glfwWindowHint(GLFW_SCALE_TO_MONITOR, GLFW_TRUE);
  GLFWwindow* window = glfwCreateWindow(options.width > 0 ? options.width : kFirstWidth,
                                        options.height > 0 ? options.height : kFirstHeight,
                                        "Hewn Studio", nullptr, nullptr);
  if (window) return window;
  return Error{ErrorCode::Internal,
               fmt::format("OpenGL 4.3 is needed and not there: {}; update the graphics driver, or "
                           "set LIBGL_ALWAYS_SOFTWARE=1, or use the command `hewn`",
                           glfw_reason())};
}

/// While it lives, an exit() from below carries out a last action. The library that talks to the
/// display makes one when the display goes; nothing of ours is told otherwise.
class Rescue {
 public:
  explicit Rescue(std::function<void()> action) {
    last_action() = std::move(action);  // before the registration, so that it goes after it
    static const int registered = std::atexit([] {
      if (last_action()) last_action()();
    });
    static_cast<void>(registered);
  }
  ~Rescue() { last_action() = nullptr; }
  Rescue(const Rescue&) = delete;
  Rescue& operator=(const Rescue&) = delete;

 private:
  static std::function<void()>& last_action() {
    static std::function<void()> action;
    return action;
  }
};

struct KeyEvent {
  int key = 0, scancode = 0, action = 0, mods = 0;
};

class Window {
 public:
  Window(GLFWwindow* window, GlEngine& engine, const Fonts& fonts, float scale,
         const WindowOptions& options)
      : window_(window),
        engine_(engine),
        options_(options),
        session_(context(options), [this] { wake(); }),
        studio_(session_, engine, fonts, scale),
        autosave_(state_folder() / "recovery") {
    glfwSetWindowUserPointer(window, this);
    glfwSetKeyCallback(window, on_key);
    glfwSetWindowCloseCallback(window, [](GLFWwindow* w) {
      self(w).touch();
      glfwSetWindowShouldClose(w, GLFW_FALSE);
      request_quit(self(w).studio_.ui());
    });
    glfwSetCharCallback(window, [](GLFWwindow* w, unsigned c) {
      self(w).touch();
      ImGui_ImplGlfw_CharCallback(w, c);
    });
    glfwSetMouseButtonCallback(window, [](GLFWwindow* w, int button, int action, int mods) {
      self(w).touch();
      ImGui_ImplGlfw_MouseButtonCallback(w, button, action, mods);
    });
    glfwSetScrollCallback(window, [](GLFWwindow* w, double x, double y) {
      self(w).touch();
      ImGui_ImplGlfw_ScrollCallback(w, x, y);
    });
    glfwSetCursorPosCallback(window, on_cursor);
    glfwSetDropCallback(window, [](GLFWwindow* w, int count, const char** paths) {
      self(w).touch();
      if (count > 0) self(w).studio_.open(paths[0]);
    });
    glfwSetFramebufferSizeCallback(window, [](GLFWwindow* w, int, int) { self(w).touch(); });
    glfwSetWindowRefreshCallback(window, [](GLFWwindow* w) { self(w).touch(); });
    glfwSetWindowFocusCallback(window, [](GLFWwindow* w, int focused) {
      self(w).touch();
      ImGui_ImplGlfw_WindowFocusCallback(w, focused);
    });
    glfwSetCursorEnterCallback(window, [](GLFWwindow* w, int entered) {
      self(w).touch();
      ImGui_ImplGlfw_CursorEnterCallback(w, entered);
    });
  }

  void run() {
    const auto settings = state_folder() / "studio.json";
    std::error_code ignored;
    const bool is_first_run = !std::filesystem::exists(settings, ignored);
    studio_.load_settings(settings);
    session_.set_live(options_.is_live);
    session_.set_background_edits(true);
    const StudioState& state = studio_.state();
    const bool is_asked_for = options_.width > 0 || options_.height > 0;
    if (state.window_width > 0 && state.window_height > 0 && !is_asked_for) {
      glfwSetWindowSize(window_, state.window_width, state.window_height);
    }
    open_first(is_first_run);
    const Rescue rescue([this] { rescue_plan(); });
    while (!glfwWindowShouldClose(window_)) step();
    glfwGetWindowSize(window_, &studio_.state().window_width, &studio_.state().window_height);
    static_cast<void>(studio_.save_settings(settings));
    if (options_.has_frame_stats) std::printf("%s\n", stats_.summary().c_str());
  }

 private:
  static RunContext context(const WindowOptions& options) {
    RunContext run;
    run.threads = options.threads;
    run.compute = std::make_shared<Compute>(options.threads, options.device, open_cuda_device);
    return run;
  }
  static Window& self(GLFWwindow* window) {
    return *static_cast<Window*>(glfwGetWindowUserPointer(window));
  }
  static void on_key(GLFWwindow* w, int key, int scancode, int action, int mods) {
    self(w).touch();
    self(w).tell_imgui({key, scancode, action, mods});
    if (action == GLFW_REPEAT) return;
    self(w).studio_.key(key, mods & (GLFW_MOD_SHIFT | GLFW_MOD_CONTROL | GLFW_MOD_ALT),
                        action == GLFW_PRESS);
  }
  /// Dear ImGui looks at keys once a frame: a release waits until its press has been seen.
  void tell_imgui(const KeyEvent& event) {
    const bool is_fresh = std::find(pressed_.begin(), pressed_.end(), event.key) != pressed_.end();
    if (event.action == GLFW_RELEASE && is_fresh) {
      releases_.push_back(event);
      return;
    }
    if (event.action == GLFW_PRESS) pressed_.push_back(event.key);
    ImGui_ImplGlfw_KeyCallback(window_, event.key, event.scancode, event.action, event.mods);
  }
  void tell_late_releases() {
    pressed_.clear();
    for (const KeyEvent& event : std::exchange(releases_, {})) {
      ImGui_ImplGlfw_KeyCallback(window_, event.key, event.scancode, event.action, event.mods);
      touch();
    }
  }
  static void on_cursor(GLFWwindow* w, double, double) { self(w).touch(); }

  void touch() { frames_due_ = kFramesPerEvent; }

  /// From the worker, often. Wakes the window ten times a second at most: the job needs the
  /// processor more than its progress bar does.
  void wake() {
    const auto now = std::chrono::steady_clock::now().time_since_epoch().count();
    constexpr auto kApart = std::chrono::steady_clock::duration(std::chrono::milliseconds(100));
    auto last = last_wake_.load();
    if (now - last < kApart.count() || !last_wake_.compare_exchange_strong(last, now)) return;
    glfwPostEmptyEvent();
  }

  /// Opens what was asked for; on the very first start the sample part, with the hints.
  void open_first(bool is_first_run) {
    StudioState& state = studio_.state();
    state.has_openscad = is_installed("openscad");
    state.sample = sample_part();
    state.recoverable = find_recoverable(state_folder() / "recovery");
    if (!options_.file.empty()) {
      studio_.open(options_.file);
    } else if (is_first_run && !state.sample.empty()) {
      studio_.open(state.sample);
    }
  }

  /// Exports into a temporary file, and starts OpenSCAD when it is there.
  void follow_openscad() {
    if (std::exchange(studio_.state().wants_openscad, false)) {
      const auto& mesh = session_.document().project.mesh;
      std::error_code ignored;
      design_ = std::filesystem::temp_directory_path(ignored) /
                fmt::format("hewn-{}-{}.scad", mesh.stem().string(), ::getpid());
      std::filesystem::remove(design_, ignored);
      if (!session_.execute(ExportTree{design_})) design_.clear();
    }
    if (design_.empty() || session_.is_busy()) return;
    const auto design = std::exchange(design_, {});
    std::error_code ignored;
    if (!std::filesystem::exists(design, ignored)) return;  // the notice tells why
    if (auto done = launch("openscad", design); !done) {
      session_.notify(Severity::Error, done.error().message);
    }
  }

  void step() {
    if (frames_due_ > 0) {
      glfwPollEvents();
    } else {
      const bool is_soon = session_.is_busy() || studio_.wants_detail();
      glfwWaitEventsTimeout(is_soon ? kWaitBusy_s : kWaitIdle_s);
      if (studio_.wants_detail()) frames_due_ = 1;
    }
    if (session_.poll()) touch();
    if (session_.is_busy() && frames_due_ == 0) frames_due_ = 1;  // the job's bar and clock
    follow_openscad();
    keep_records();
    if (frames_due_ <= 0) return;
    --frames_due_;
    stats_.begin();
    draw();
    tell_late_releases();
    // The first frame makes the driver ready; nobody waits for an answer to a click yet.
    if (std::exchange(has_drawn_, true)) stats_.end(studio_.is_moving(), session_.is_busy());
  }

  void draw() {
    const std::uint64_t before = session_.revision();
    int width = 0;
    int height = 0;
    glfwGetFramebufferSize(window_, &width, &height);
    if (width == 0 || height == 0) return;
    ImGui_ImplOpenGL3_NewFrame();
    ImGui_ImplGlfw_NewFrame();
    ImGui::NewFrame();
    studio_.frame(ImGui::GetIO().DisplaySize.x, ImGui::GetIO().DisplaySize.y);
    ImGui::Render();
    engine_.compose(studio_.backing(), width, height);
    ImGui_ImplOpenGL3_RenderDrawData(ImGui::GetDrawData());
    if (std::exchange(studio_.state().wants_picture, false)) save_picture(width, height);
    glfwSwapBuffers(window_);
    if (studio_.state().wants_close) glfwSetWindowShouldClose(window_, GLFW_TRUE);
    if (session_.revision() != before) touch();
  }

  void save_picture(int width, int height) {
    Image image{width, height, {}};
    image.rgb.resize(static_cast<std::size_t>(3) * width * height);
    std::vector<std::uint8_t> rows(image.rgb.size());
    glPixelStorei(GL_PACK_ALIGNMENT, 1);
    glReadPixels(0, 0, width, height, GL_RGB, GL_UNSIGNED_BYTE, rows.data());
    const std::size_t row = static_cast<std::size_t>(3) * width;
    for (int y = 0; y < height; ++y) {
      std::memcpy(&image.rgb[row * y], &rows[row * (height - 1 - y)], row);
    }
    std::error_code ignored;
    std::filesystem::path path;
    do {
      path = options_.pictures / fmt::format("hewn-{}.png", ++pictures_);
    } while (std::filesystem::exists(path, ignored));
    if (auto done = save_png(image, path); !done) {
      session_.notify(Severity::Error, done.error().message);
    }
    touch();
  }

  /// The command log and the copy of an unsaved plan.
  void keep_records() {
    if (!options_.status.empty()) {
      std::string status = studio_.status_line();
      if (status != status_ && write_file(options_.status, status + "\n")) {
        status_ = std::move(status);
      }
    }
    if (!options_.record.empty() && session_.log().size() != recorded_) {
      recorded_ = session_.log().size();
      if (auto done = write_file(options_.record, session_.log()); !done) {
        session_.notify(Severity::Error,
                        done.error().message + "; nothing more is recorded in this log");
        options_.record.clear();
      }
    }
    if (checked_revision_ == session_.revision() &&
        Autosave::Clock::now() - checked_ < std::chrono::seconds(60)) {
      return;
    }
    checked_revision_ = session_.revision();
    checked_ = Autosave::Clock::now();
    const auto done = autosave_.update(session_.document().project, session_.is_modified(),
                                       Autosave::Clock::now());
    // The plan that was given back is safe again.
    std::filesystem::path& recovered = studio_.state().recovered;
    std::error_code ignored;
    if (!autosave_.file().empty() && !recovered.empty()) {
      std::filesystem::remove(std::exchange(recovered, {}), ignored);
    }
    if (!done) session_.notify(Severity::Warning, "no copy of the plan: " + done.error().message);
  }

  /// The process is ending without being asked to. Workers may still run, so nothing is torn down.
  void rescue_plan() {
    const bool is_modified = session_.is_modified();
    const bool is_kept =
        is_modified && autosave_.keep(session_.document().project, Autosave::Clock::now());
    std::fprintf(stderr, "hewn-studio: the display is gone%s\n",
                 is_kept       ? "; the plan is kept, the next start offers it"
                 : is_modified ? "; the plan could not be kept"
                               : "; nothing was unsaved");
    std::_Exit(1);
  }

  GLFWwindow* window_;
  GlEngine& engine_;
  WindowOptions options_;
  std::atomic<std::chrono::steady_clock::rep> last_wake_{0};
  Session session_;
  Studio studio_;
  Autosave autosave_;
  FrameStats stats_;
  bool has_drawn_ = false;
  std::size_t recorded_ = 0;
  std::string status_;
  std::uint64_t checked_revision_ = 0;
  Autosave::Clock::time_point checked_{};
  std::vector<int> pressed_;  ///< keys that went down since the last frame
  std::vector<KeyEvent> releases_;
  int frames_due_ = kFramesPerEvent;
  int pictures_ = 0;
  std::filesystem::path design_;  ///< being exported for OpenSCAD
};

}  // namespace

Result<void> run_window(const WindowOptions& options) {
  const GlfwSession glfw;
  if (!glfw.is_on) {
    return Error{ErrorCode::Internal,
                 fmt::format("there is no display: {}; use the command `hewn`", glfw_reason())};
  }
  auto made = make_window(options);
  if (!made) return made.error();
  GLFWwindow* window = *made;
  glfwMakeContextCurrent(window);
  glfwSwapInterval(1);
  auto engine = GlEngine::create();
  if (!engine) return engine.error();
  const ImGuiSession imgui;
  ImGui_ImplGlfw_InitForOpenGL(window, false);
  ImGui_ImplOpenGL3_Init("#version 430");
  float scale = 1;
  glfwGetWindowContentScale(window, &scale, nullptr);
  const Fonts fonts = load_fonts(scale);
  Window(window, *engine, fonts, scale, options).run();
  return {};
}

}  // namespace hewn
