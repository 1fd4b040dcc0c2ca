#pragma once
/// What the window remembers beside the session: views, selection, panels. None of it is undone.
#include <array>
#include <filesystem>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "core/session/measuring.h"
#include "core/session/selecting.h"
#include "core/session/session.h"
#include "ui/theme.h"
#include "ui/view/camera.h"
#include "ui/view/exact_choice.h"

namespace hewn {

enum class Tool { Select, Box, Lasso, Knife, Measure };
enum class ColourMode { Group, Kind, Partition, Deviation };
enum class ShowMode { Input, Result, Overlay, Difference };

/// How the shown result is drawn at the moment; kept by the viewport, for the caption.
struct ExactNow {
  bool is_exact = false;
  ExactCost cost;
  std::string problem;  ///< why it cannot be drawn exactly; empty: it can
};

/// The view of the tree's graph.
struct GraphState {
  float zoom = 1;
  float pan_x = 0, pan_y = 0;  ///< of the graph's corner from the panel's left middle
  bool wants_fit = true;
  bool is_panning = false;
};

/// The points with normal . x = offset, in model coordinates.
struct ViewPlane {
  Vec3 normal = Vec3::UnitZ();  ///< unit
  double offset = 0;
};

/// Places of the part that are being measured.
struct MeasureState {
  std::optional<Spot> hovered;  ///< under the mouse
  std::vector<Spot> spots;      ///< at most two
};

/// The cut that is being placed.
struct KnifeState {
  bool is_dragging = false;
  std::array<float, 2> from{}, to{};  ///< window pixels
  /// Where the line begins and ends on corners of the part.
  std::optional<Vec3> from_corner, to_corner;
  std::optional<SnappedPlane> plane;
  int crossed = 0;  ///< groups that it would divide
  std::array<char, 32> offset_text{};
  int placed_cut = -1;  ///< the cut of the plan that is being moved; -1: a new one
};

/// A file to open, save or export, being chosen.
struct FileRequest {
  enum class Kind { None, Open, SaveProject, Export } kind = Kind::None;
  std::filesystem::path folder;
  std::string name;
  bool has_focus = false;
};

/// Going away from a plan that is not saved, while the user is asked.
struct Leaving {
  std::filesystem::path next;  ///< what is to be opened; empty: the window is to close
  bool is_saving = false;      ///< it is being saved first
};

struct StudioState {
  Camera camera;
  Tool tool = Tool::Select;
  ColourMode colours = ColourMode::Group;
  ShowMode show = ShowMode::Input;
  ExactMode exact = ExactMode::Auto;
  ExactNow exact_now;
  bool is_xray = false;
  bool is_wireframe = false;
  bool is_comparing = false;         ///< the compare key is held: the input alone
  std::optional<ViewPlane> section;  ///< only what lies behind it is shown
  double tolerance_share = 1e-4;     ///< of the diagonal: grey in the deviation map

  std::vector<int> group_colours;  ///< numbers for `golden_state`, of the mesh that is shown
  std::vector<int> selected;       ///< face groups, ascending
  int hovered = -1;                ///< face group
  int hovered_literal = -1;
  std::shared_ptr<const FoundResult> hovered_result;  ///< under the mouse in the Pareto plot
  std::string active_field;  ///< name of the literal's number that is being typed
  int picked_literal = -1;
  int hovered_node = -1, picked_node = -1;  ///< operations of the shown tree
  std::vector<int> hovered_groups;          ///< of a row in a list
  std::set<int> hidden;                     ///< face groups
  PartitionPath active_partition;           ///< where new partitions go
  std::set<std::string> locked;             ///< partitions by name: their groups cannot be picked
  KnifeState knife;
  MeasureState measure;
  GraphState graph;
  bool shows_graph = false;  ///< the graph's tab is open

  bool is_light = false;
  bool shows_palette = false;
  bool shows_keys = false;
  bool shows_settings = false;
  std::string settings_filter;
  bool shows_log = false;
  bool shows_hints = true;
  int hint = 0;  ///< next of the four hints
  FileRequest file;
  std::optional<Leaving> leaving;
  std::string palette_text;
  int palette_at = 0;
  PartitionPath renaming;
  bool is_renaming = false;
  std::string rename_text;
  /// What panels tell of the mouse and the keyboard holds for one frame.
  void begin_frame() {
    hovered_groups.clear();
    hovered_result = nullptr;
    active_field.clear();
  }
  /// Changes the tool; what the one before had begun is forgotten.
  void take_up(Tool next) {
    tool = next;
    knife = {};
    measure = {};
  }

  float left_width = 264, right_width = 312;    ///< at scale 1
  bool shows_plan = true, shows_result = true;  ///< the panels on the left and on the right
  int window_width = 0, window_height = 0;      ///< screen units, as it was left; 0: not known

  bool wants_fit = false;  ///< when the mesh arrives
  bool wants_close = false;
  bool wants_picture = false;  ///< of the whole window
  bool has_openscad = false;   ///< it is installed
  bool wants_openscad = false;
  std::filesystem::path sample;                    ///< the part for first steps; empty: none
  std::vector<std::filesystem::path> recoverable;  ///< copies that a crash left behind
  std::filesystem::path recovered;  ///< the copy that was opened; goes when the plan has a new one
  std::vector<std::filesystem::path> recent;
};

struct Action;

/// What panels are given: they read the session, keep to the state and make commands.
struct Ui {
  Session& session;
  StudioState& state;
  Theme theme;
  Fonts fonts;
  float scale = 1;
  const std::vector<Action>* actions = nullptr;

  float px(float at_scale_1) const { return std::round(at_scale_1 * scale); }
};

}  // namespace hewn
