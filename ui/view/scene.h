#pragma once
/// What is to be seen, without a word of how it is drawn.
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include <glm/glm.hpp>

#include "core/csg/tree_program.h"
#include "core/session/display_mesh.h"

namespace hewn {

/// How the faces of one label look; bits as in shaders/mesh.frag.
struct LabelState {
  std::uint8_t red = 0, green = 0, blue = 0;  ///< sRGB
  std::uint8_t flags = 0;
  bool operator==(const LabelState&) const = default;
};
inline constexpr std::uint8_t kHiddenFlag = 1;
inline constexpr std::uint8_t kSelectedFlag = 2;
inline constexpr std::uint8_t kHoveredFlag = 4;
inline constexpr std::uint8_t kUnderKnifeFlag = 8;
inline constexpr std::uint8_t kFadedFlag = 16;

/// The meshes that an engine keeps: the input by groups, the result's surface by literals, and the
/// input by literals with deviations.
enum class MeshSlot { Input, Surface, Measured };
inline constexpr int kMeshSlots = 3;

struct SceneItem {
  MeshSlot slot = MeshSlot::Input;
  float opacity = 1;
  bool has_lines = true;
  bool is_exact = false;  ///< by the rays of the tree that was shown instead of by triangles
  bool shows_deviation = false;
  bool fades_exact = false;         ///< glassy where the deviation is within the tolerance
  glm::vec2 deviation_scale{0, 1};  ///< tolerance and largest, model units
  bool operator==(const SceneItem&) const = default;
};

/// A translucent quadrilateral in scene coordinates.
struct SceneSheet {
  glm::vec3 corners[4];
  glm::vec4 tint{1, 1, 1, 0.2F};  ///< sRGB
  bool operator==(const SceneSheet&) const = default;
};

/// Scene coordinates are model coordinates less `origin`.
struct Scene {
  std::vector<SceneItem> items;
  std::vector<SceneSheet> sheets;
  Vec3 origin = Vec3::Zero();
  glm::mat4 view{1}, projection{1};
  glm::vec4 section{0}, knife{0};
  bool has_knife = false;
  bool is_wireframe = false;
  bool hides_faces = false;             ///< some labels are hidden: backs can be seen
  bool is_coarse = false;               ///< the rougher triangles will do
  glm::vec3 top{0}, bottom{0};          ///< backdrop, sRGB
  glm::vec3 accent{0}, cut_face{0};     ///< linear
  glm::vec4 line{0}, selected_line{1};  ///< sRGB
  float line_width = 1;                 ///< framebuffer pixels
  bool operator==(const Scene&) const = default;
};

/// A rectangle of one colour in framebuffer pixels from the top left.
struct BackingFill {
  int x = 0, y = 0, width = 0, height = 0;
  glm::vec4 colour{0};
};

/// What lies under the window's content. Drawn plainly, because blending every pixel of the window
/// is slow without a graphics card.
struct Backing {
  glm::vec4 lines{0};  ///< shows between the rectangles
  std::vector<BackingFill> fills;
  int picture_x = 0, picture_y = 0;  ///< where the scene's picture begins, at the top left
};

/// Label + 1 of every pixel, rows from the bottom; 0 where nothing is.
struct IdImage {
  int width = 0, height = 0;
  std::vector<std::uint32_t> ids;
  /// The label at a pixel counted from the top left; -1: none.
  int at(int x, int y) const;
};

/// Draws scenes. Tests use one that draws nothing.
class RenderEngine {
 public:
  virtual ~RenderEngine() = default;
  /// Null: the slot becomes empty.
  virtual void show_mesh(MeshSlot slot, const DisplayMesh* mesh) = 0;
  /// The tree behind `MeshSlot::Surface`, for exact pictures; null: none. Returns why it cannot be
  /// drawn so; empty: it can.
  virtual std::string show_tree(const TreeProgram* tree) = 0;
  /// One for each label of the slot's mesh.
  virtual void set_states(MeshSlot slot, std::span<const LabelState> states) = 0;
  /// Draws into a picture that the window puts in place. `samples`: 1 or 4 per pixel.
  virtual void draw(const Scene& scene, int width, int height, int samples) = 0;
  /// The labels of the first item.
  virtual void read_ids(const Scene& scene, int width, int height, IdImage& out) = 0;
  /// Whether the processor draws, so that every sample counts.
  virtual bool is_software() const = 0;
};

/// An engine without a screen.
class NullEngine : public RenderEngine {
 public:
  void show_mesh(MeshSlot, const DisplayMesh*) override {}
  std::string show_tree(const TreeProgram*) override { return {}; }
  void set_states(MeshSlot, std::span<const LabelState>) override {}
  void draw(const Scene&, int, int, int) override {}
  void read_ids(const Scene&, int width, int height, IdImage& out) override;
  bool is_software() const override { return false; }
};

}  // namespace hewn
