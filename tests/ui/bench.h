#pragma once
/// The window's content without a window, for tests that press its keys and move its mouse.
#include <array>
#include <functional>
#include <memory>
#include <utility>
#include <vector>

#include "tests/core/session/session_fixture.h"
#include "ui/studio.h"

namespace hewn::testing {

/// Draws nothing; what is seen where is up to the test.
class PaintedEngine : public NullEngine {
 public:
  void draw(const Scene& scene, int, int, int) override { last = scene; }
  void read_ids(const Scene& scene, int width, int height, IdImage& out) override {
    NullEngine::read_ids(scene, width, height, out);
    if (!label_at) return;
    for (int y = 0; y < height; ++y) {
      for (int x = 0; x < width; ++x) {
        out.ids[static_cast<std::size_t>(height - 1 - y) * width + x] =
            static_cast<std::uint32_t>(label_at(x, y) + 1);
      }
    }
  }
  std::function<int(int x, int y)> label_at;  ///< from the top left; -1: nothing is there
  Scene last;                                 ///< as it was drawn
};

/// A studio on the plate with a hole, without a screen.
class Bench {
 public:
  explicit Bench(std::unique_ptr<PaintedEngine> engine = std::make_unique<PaintedEngine>())
      : engine_(std::move(engine)) {
    ImGui::CreateContext();
    ImGui::GetIO().IniFilename = nullptr;
    fonts_ = load_fonts(1);
    session_.set_views(false);
    studio_ = std::make_unique<Studio>(session_, *engine_, fonts_, 1.0F);
    studio_->open(folder_.plate());
    session_.wait();
    frames(2);
  }
  ~Bench() { ImGui::DestroyContext(); }
  Bench(const Bench&) = delete;
  Bench& operator=(const Bench&) = delete;

  void frames(int count) {
    for (int i = 0; i < count; ++i) {
      ImGui::GetIO().DisplaySize = {1280, 720};
      ImGui::GetIO().DeltaTime = 1.0F / 60;
      ImGui::NewFrame();
      studio_->frame(1280, 720);
      ImGui::Render();
    }
  }
  /// Presses at the first point, moves over the others, and lets go at the last.
  void drag(const std::vector<std::array<float, 2>>& path) {
    ImGuiIO& io = ImGui::GetIO();
    io.MousePos = {path.front()[0], path.front()[1]};
    frames(2);
    io.MouseDown[0] = true;
    for (const auto& p : path) {
      io.MousePos = {p[0], p[1]};
      frames(2);
    }
    io.MouseDown[0] = false;
    frames(2);
  }
  void click(float x, float y) {
    ImGuiIO& io = ImGui::GetIO();
    io.MousePos = {x, y};
    frames(2);
    io.MouseDown[0] = true;
    frames(2);
    io.MouseDown[0] = false;
    frames(2);
  }
  bool key(int key, int mods = 0) {
    const bool done = studio_->key(key, mods, true);
    studio_->key(key, mods, false);
    frames(1);
    return done;
  }
  int hole_group() const { return find_groups(*session_.document().prepared, hole(), "")->front(); }

  Session& session() { return session_; }
  PaintedEngine& engine() { return *engine_; }
  StudioState& state() { return studio_->state(); }
  Studio& studio() { return *studio_; }

 private:
  SessionFolder folder_{"ui"};
  Session session_{one_thread()};
  std::unique_ptr<PaintedEngine> engine_;
  Fonts fonts_;
  std::unique_ptr<Studio> studio_;
};

}  // namespace hewn::testing
