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
    index_buffer_ = make_buffer();
    line_buffer_ = make_buffer();
    state_buffer_ = make_buffer();
    state_texture_ = make_texture();
  }
  origin_ = mesh.origin;
  diagonal_ = static_cast<float>(mesh.bounds.diagonal());
  is_closed_ = mesh.is_closed;
  indices_ = static_cast<GLsizei>(mesh.indices.size());
  coarse_ = static_cast<GLsizei>(mesh.coarse.size());
  lines_ = static_cast<GLsizei>(mesh.lines.size());

  glBindVertexArray(face_array_.get());
  glBindBuffer(GL_ARRAY_BUFFER, face_buffer_.get());
  glBufferData(GL_ARRAY_BUFFER,
               static_cast<GLsizeiptr>(mesh.corners.size() * sizeof(DisplayCorner)),
               mesh.corners.data(), GL_STATIC_DRAW);
  constexpr std::size_t kIndex = sizeof(std::uint32_t);
  glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, index_buffer_.get());
  glBufferData(GL_ELEMENT_ARRAY_BUFFER,
               static_cast<GLsizeiptr>((mesh.indices.size() + mesh.coarse.size()) * kIndex),
               nullptr, GL_STATIC_DRAW);
  glBufferSubData(GL_ELEMENT_ARRAY_BUFFER, 0, static_cast<GLsizeiptr>(mesh.indices.size() * kIndex),
                  mesh.indices.data());
  glBufferSubData(GL_ELEMENT_ARRAY_BUFFER, static_cast<GLintptr>(mesh.indices.size() * kIndex),
                  static_cast<GLsizeiptr>(mesh.coarse.size() * kIndex), mesh.coarse.data());
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

void GpuMesh::draw_faces(bool is_coarse) const {
  glBindVertexArray(face_array_.get());
  const bool has_coarse = is_coarse && coarse_ > 0;
  const std::size_t begin =
      has_coarse ? sizeof(std::uint32_t) * static_cast<std::size_t>(indices_) : 0;
  glDrawElements(GL_TRIANGLES, has_coarse ? coarse_ : indices_, GL_UNSIGNED_INT, at(begin));
}

void GpuMesh::draw_lines() const {
  glBindVertexArray(line_array_.get());
  glDrawArrays(GL_LINES, 0, lines_);
}

}  // namespace hewn
