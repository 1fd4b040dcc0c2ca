#pragma once
/// A tree's program in the graphics memory, and the shaders that draw it ray by ray.
#include <string>

#include "core/csg/tree_program.h"
#include "ui/gl/program.h"
#include "ui/view/scene.h"

namespace hewn {

/// All functions need a current OpenGL context.
class GpuTree {
 public:
  /// Null: nothing is there. Returns why it cannot be drawn; empty: it can.
  std::string upload(const TreeProgram* program);
  bool is_empty() const { return program_.literals.empty(); }

  /// What is the same for pictures and ids.
  struct View {
    const Scene& scene;
    int width = 1, height = 1;  ///< of the target, pixels
    GLuint states = 0;          ///< texture of the literals' looks
  };
  /// Draws over the depth that is there. `opacity` < 1: the caller blends.
  void draw(const View& view, float opacity) const;
  /// Label + 1 into an integer target.
  void draw_ids(const View& view) const;

 private:
  void draw_with(const GlProgram& shader, const View& view) const;

  TreeProgram program_;
  GlProgram picture_, ids_;
  int capacity_ = 0;  ///< stretches that the shaders hold
  GlVertexArray array_;
  GlBuffer literal_buffer_, step_buffer_, shown_buffer_;
  GlTexture literal_texture_, step_texture_, shown_texture_;
};

}  // namespace hewn
