#pragma once
/// The picture of the part and what the mouse does in it.
#include <memory>

#include "ui/studio_state.h"
#include "ui/view/look.h"
#include "ui/view/scene.h"

namespace hewn {

class Viewport {
 public:
  explicit Viewport(RenderEngine& engine) : engine_(engine) {}

  /// Draws the picture into the area, in the current Dear ImGui window, and follows the mouse.
  void draw(Ui& ui, const ViewArea& area);
  /// Whether a drag that moves the camera is going on.
  bool is_moving() const { return drag_ == Drag::Orbit || drag_ == Drag::Pan; }

 private:
  enum class Drag { None, Pick, Box, Orbit, Pan, Knife };

  void sync_meshes(Ui& ui);
  void sync_states(Ui& ui);
  void follow_mouse(Ui& ui, const ViewArea& area, bool is_hovered);
  void begin_drag(Ui& ui, const ViewArea& area);
  void continue_drag(Ui& ui, const ViewArea& area);
  void end_drag(Ui& ui, const ViewArea& area);
  void hover(Ui& ui, const ViewArea& area, bool is_hovered);
  void click(Ui& ui);
  void select_box(Ui& ui, const ViewArea& area);
  void place_knife(Ui& ui, const ViewArea& area);
  void draw_rubber_band(const Ui& ui) const;
  const IdImage& ids(const Ui& ui, const ViewArea& area);

  RenderEngine& engine_;
  std::shared_ptr<const DisplayMesh> input_;
  std::shared_ptr<const ResultView> result_;
  std::vector<LabelState> states_, literal_states_;
  Scene drawn_;
  bool must_draw_ = true;
  int drawn_samples_ = 0;
  float drawn_width_ = 0, drawn_height_ = 0;
  std::uint64_t picture_ = 0;
  double frame_cost_ms_ = 0;  ///< of the last picture with all samples
  IdImage ids_;
  bool has_ids_ = false;
  Drag drag_ = Drag::None;
  int drag_button_ = 0;
  std::array<float, 2> drag_start_{}, last_mouse_{};
};

}  // namespace hewn
