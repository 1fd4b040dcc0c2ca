#pragma once
/// The picture of the part and what the mouse does in it.
#include <chrono>
#include <memory>
#include <set>

#include "ui/studio_state.h"
#include "ui/tools/corner_finder.h"
#include "ui/tools/plane_handles.h"
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
  /// Whether the picture is rough for now, or does not tell yet what is under the mouse: drawn
  /// again a moment later, it gets its details.
  bool wants_detail() const { return is_rough_ || waits_for_exact_ || waits_for_hover_; }

 private:
  enum class Drag { None, Pick, Box, Lasso, Orbit, Pan, Knife, Handle, Measure };

  void sync_meshes(Ui& ui);
  void sync_states(Ui& ui);
  void follow_mouse(Ui& ui, const ViewArea& area, bool is_hovered);
  static Drag drag_of(Tool tool);
  void begin_drag(Ui& ui, const ViewArea& area);
  void continue_drag(Ui& ui, const ViewArea& area);
  void end_drag(Ui& ui, const ViewArea& area);
  void hover(Ui& ui, const ViewArea& area, bool is_hovered);
  void point_at(Ui& ui, const ViewArea& area, const std::array<float, 2>& mouse);
  void click(Ui& ui, const ViewArea& area);
  void select_box(Ui& ui, const ViewArea& area);
  void select_lasso(Ui& ui, const ViewArea& area);
  void place_knife(Ui& ui, const ViewArea& area);
  std::optional<Vec3> corner_at(Ui& ui, const ViewArea& area, const std::array<float, 2>& pixel);
  void draw_rubber_band(const Ui& ui, const ViewArea& area) const;
  void draw_picture(Ui& ui, const ViewArea& area);
  ExactSituation exact_situation(const Ui& ui, const Scene& scene, bool has_settled) const;
  void try_exact(Ui& ui, const Scene& scene, int width, int height);
  void learn_cost(Ui& ui, double took_ms);
  bool is_slow() const;
  bool has_ids(const Scene& scene) const;
  const IdImage& ids(const Scene& scene, const ViewArea& area);

  RenderEngine& engine_;
  bool is_cold_ = true;  ///< no frame yet
  std::shared_ptr<const DisplayMesh> input_;
  std::shared_ptr<const ResultView> result_;
  std::vector<LabelState> states_, literal_states_;
  using Clock = std::chrono::steady_clock;
  std::string tree_problem_;  ///< why the engine cannot draw the tree exactly
  bool draws_exactly_ = false;
  bool waits_for_exact_ = false;  ///< triangles for now
  Scene drawn_;
  bool must_draw_ = true;
  int drawn_samples_ = 0;
  float drawn_width_ = 0, drawn_height_ = 0;
  Clock::time_point changed_{};  ///< when the picture last changed
  bool is_rough_ = false;
  bool waits_for_hover_ = false;
  double detail_cost_ms_ = 0;  ///< of a picture with all samples and triangles
  IdImage ids_;
  Scene ids_scene_;  ///< what `ids_` shows, without colours
  bool has_ids_ = false;
  std::set<int> hidden_;  ///< groups, when `ids_` was made
  Drag drag_ = Drag::None;
  PlaneHandle handle_ = PlaneHandle::None;
  CornerFinder corners_;
  std::vector<std::array<float, 2>> lasso_;  ///< window pixels
  int drag_button_ = 0;
  std::array<float, 2> drag_start_{}, last_mouse_{};
};

}  // namespace hewn
