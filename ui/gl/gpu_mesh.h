#pragma once
/// A display mesh in the graphics memory, with the present look of each of its labels.
#include <span>

#include "core/session/display_mesh.h"
#include "ui/gl/program.h"
#include "ui/view/scene.h"

namespace hewn {

/// All functions need a current OpenGL context.
class GpuMesh {
 public:
  void upload(const DisplayMesh& mesh);
  void clear() { indices_ = coarse_ = lines_ = 0; }
  /// One for each label.
  void set_states(std::span<const LabelState> states);
  bool is_empty() const { return indices_ == 0; }
  /// Its triangles hide each other's backs.
  bool is_closed() const { return is_closed_; }
  const Vec3& origin() const { return origin_; }
  float diagonal() const { return diagonal_; }
  /// Texture of the labels' looks.
  GLuint states() const { return state_texture_.get(); }
  /// Binds the labels' looks to texture unit 0.
  void bind_states() const;
  /// `is_coarse`: the rougher version, if there is one.
  void draw_faces(bool is_coarse) const;
  void draw_lines() const;

 private:
  GlVertexArray face_array_, line_array_;
  GlBuffer face_buffer_, index_buffer_, line_buffer_, state_buffer_;
  GlTexture state_texture_;
  GLsizei indices_ = 0;
  GLsizei coarse_ = 0;  ///< behind the others in the same buffer
  GLsizei lines_ = 0;
  bool is_closed_ = false;
  Vec3 origin_ = Vec3::Zero();
  float diagonal_ = 0;
};

}  // namespace hewn
