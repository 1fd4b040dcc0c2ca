#include "ui/gl/gpu_mesh.h"

#include <cstddef>

namespace hewn {
namespace {

const void* at(std::size_t offset) { return reinterpret_cast<const void*>(offset); }  // NOLINT

}  // namespace

void GpuMesh::upload(const DisplayMesh& mesh) {
  if (face_array_.get() == 0) {
    face_array_ = make_vertex_array();
    line_array_ = make_vertex_array();
    face_buffer_ = make_buffer();
    line_buffer_ = make_buffer();
    state_buffer_ = make_buffer();
    state_texture_ = make_texture();
  }
  origin_ = mesh.origin;
  corners_ = static_cast<GLsizei>(mesh.corners.size());
  lines_ = static_cast<GLsizei>(mesh.lines.size());

  glBindVertexArray(face_array_.get());
  glBindBuffer(GL_ARRAY_BUFFER, face_buffer_.get());
  glBufferData(GL_ARRAY_BUFFER,
               static_cast<GLsizeiptr>(mesh.corners.size() * sizeof(DisplayCorner)),
               mesh.corners.data(), GL_STATIC_DRAW);
  constexpr GLsizei kCorner = sizeof(DisplayCorner);
  glVertexAttribPointer(0, 3, GL_FLOAT, GL_FALSE, kCorner, at(offsetof(DisplayCorner, position)));
  glVertexAttribPointer(1, 3, GL_FLOAT, GL_FALSE, kCorner, at(offsetof(DisplayCorner, normal)));
  glVertexAttribIPointer(2, 1, GL_INT, kCorner, at(offsetof(DisplayCorner, label)));
  glVertexAttribPointer(3, 1, GL_FLOAT, GL_FALSE, kCorner, at(offsetof(DisplayCorner, value)));
  for (GLuint i = 0; i < 4; ++i) glEnableVertexAttribArray(i);

  glBindVertexArray(line_array_.get());
  glBindBuffer(GL_ARRAY_BUFFER, line_buffer_.get());
  glBufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(mesh.lines.size() * sizeof(DisplayLineEnd)),
               mesh.lines.data(), GL_STATIC_DRAW);
  constexpr GLsizei kEnd = sizeof(DisplayLineEnd);
  glVertexAttribPointer(0, 3, GL_FLOAT, GL_FALSE, kEnd, at(offsetof(DisplayLineEnd, position)));
  glVertexAttribIPointer(1, 2, GL_INT, kEnd, at(offsetof(DisplayLineEnd, labels)));
  for (GLuint i = 0; i < 2; ++i) glEnableVertexAttribArray(i);
  glBindVertexArray(0);
}

void GpuMesh::set_states(std::span<const LabelState> states) {
  if (state_buffer_.get() == 0) return;
  glBindBuffer(GL_TEXTURE_BUFFER, state_buffer_.get());
  const LabelState none;
  const auto size = states.empty() ? sizeof none : states.size_bytes();
  glBufferData(GL_TEXTURE_BUFFER, static_cast<GLsizeiptr>(size),
               states.empty() ? &none : states.data(), GL_DYNAMIC_DRAW);
  glBindTexture(GL_TEXTURE_BUFFER, state_texture_.get());
  glTexBuffer(GL_TEXTURE_BUFFER, GL_RGBA8UI, state_buffer_.get());
}

void GpuMesh::bind_states() const {
  glActiveTexture(GL_TEXTURE0);
  glBindTexture(GL_TEXTURE_BUFFER, state_texture_.get());
}

void GpuMesh::draw_faces() const {
  glBindVertexArray(face_array_.get());
  glDrawArrays(GL_TRIANGLES, 0, corners_);
}

void GpuMesh::draw_lines() const {
  glBindVertexArray(line_array_.get());
  glDrawArrays(GL_LINES, 0, lines_);
}

}  // namespace hewn
