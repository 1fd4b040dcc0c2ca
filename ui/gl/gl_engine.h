#pragma once
/// Draws scenes with OpenGL 4.3.
#include <array>
#include <string>

#include "core/base/result.h"
#include "ui/gl/gpu_mesh.h"
#include "ui/gl/gpu_tree.h"
#include "ui/view/scene.h"

namespace hewn {

class GlEngine : public RenderEngine {
 public:
  /// Requires: a current context of at least 4.3. Fails with Internal: a shader that the driver
  /// refuses.
  static Result<GlEngine> create();

  void show_mesh(MeshSlot slot, const DisplayMesh* mesh) override;
  std::string show_tree(const TreeProgram* tree) override { return tree_.upload(tree); }
  void set_states(MeshSlot slot, std::span<const LabelState> states) override;
  void draw(const Scene& scene, int width, int height, int samples) override;
  void read_ids(const Scene& scene, int width, int height, IdImage& out) override;
  bool is_software() const override { return is_software_; }

  /// Puts plain rectangles and the picture that was drawn last where the window is to show them.
  void compose(const Backing& backing, int width, int height) const;

 private:
  GlEngine() = default;
  const GpuMesh& mesh(MeshSlot slot) const { return meshes_[static_cast<std::size_t>(slot)]; }
  void resize(int width, int height);
  void make_multi_target(int samples);
  void resize_ids(int width, int height);
  void draw_backdrop(const Scene& scene) const;
  void draw_item(const Scene& scene, const SceneItem& item) const;
  /// `exact_pass`: as in shaders/mesh.frag.
  void draw_faces(const Scene& scene, const SceneItem& item, int exact_pass) const;
  void draw_lines(const Scene& scene, const SceneItem& item, bool is_exact) const;
  void draw_wires(const Scene& scene, const SceneItem& item) const;
  void draw_sheets(const Scene& scene) const;

  std::array<GpuMesh, kMeshSlots> meshes_;
  GpuTree tree_;
  GlProgram faces_, fields_, lines_, ids_, sheets_, backdrop_;
  GlVertexArray empty_array_, sheet_array_;
  GlBuffer sheet_buffer_;
  GlFramebuffer target_, multi_target_, id_target_;
  GlTexture texture_, id_texture_;
  GlRenderbuffer depth_, multi_colour_, multi_depth_, id_depth_;
  int width_ = 0, height_ = 0;
  int samples_ = 0;  ///< of `multi_target_`, when it is there
  int id_width_ = 0, id_height_ = 0;
  bool is_software_ = false;
  float widest_line_ = 1;  ///< that the driver draws, pixels
};

}  // namespace hewn
