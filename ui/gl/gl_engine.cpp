#include "ui/gl/gl_engine.h"

#include <algorithm>
#include <array>
#include <string>

#include <glm/gtc/matrix_transform.hpp>

#include "ui/gl/shaders.h"
#include "ui/gl/uniforms.h"

namespace hewn {
namespace {

/// The plane in the coordinates of a mesh whose origin lies `shift` from the scene's.
glm::vec4 shifted(const glm::vec4& plane, const glm::vec3& shift) {
  return {glm::vec3(plane), plane.w - glm::dot(glm::vec3(plane), shift)};
}

glm::vec3 shift_of(const Scene& scene, const GpuMesh& mesh) {
  const Vec3 d = mesh.origin() - scene.origin;
  return {static_cast<float>(d.x()), static_cast<float>(d.y()), static_cast<float>(d.z())};
}

glm::mat4 matrix_for(const Scene& scene, const GpuMesh& mesh) {
  return scene.projection * glm::translate(scene.view, shift_of(scene, mesh));
}

void attach(const GlFramebuffer& target, const GlRenderbuffer& depth) {
  glBindFramebuffer(GL_FRAMEBUFFER, target.get());
  glFramebufferRenderbuffer(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_RENDERBUFFER, depth.get());
}

void allocate(const GlRenderbuffer& buffer, GLenum format, int width, int height, int samples) {
  glBindRenderbuffer(GL_RENDERBUFFER, buffer.get());
  if (samples > 1) {
    glRenderbufferStorageMultisample(GL_RENDERBUFFER, samples, format, width, height);
  } else {
    glRenderbufferStorage(GL_RENDERBUFFER, format, width, height);
  }
}

void allocate_texture(const GlTexture& texture, GLint internal, GLenum format, GLenum type,
                      int width, int height) {
  glBindTexture(GL_TEXTURE_2D, texture.get());
  glTexImage2D(GL_TEXTURE_2D, 0, internal, width, height, 0, format, type, nullptr);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
}

/// Mesa's renderers for machines without a graphics card.
bool is_software_renderer() {
  const auto* name = reinterpret_cast<const char*>(glGetString(GL_RENDERER));  // NOLINT: its type
  const std::string renderer = name ? name : "";
  for (const char* known : {"llvmpipe", "softpipe", "swrast", "Software"}) {
    if (renderer.find(known) != std::string::npos) return true;
  }
  return false;
}

}  // namespace

Result<GlEngine> GlEngine::create() {
  GlEngine out;
  const struct {
    GlProgram* program;
    const char *vertex, *fragment;
    const char* define = nullptr;
  } programs[] = {{&out.faces_, shaders::mesh_vert, shaders::mesh_frag},
                  {&out.fields_, shaders::mesh_vert, shaders::mesh_frag, "HAS_FIELDS"},
                  {&out.ids_, shaders::ids_vert, shaders::ids_frag},
                  {&out.lines_, shaders::lines_vert, shaders::lines_frag},
                  {&out.sheets_, shaders::sheet_vert, shaders::sheet_frag},
                  {&out.backdrop_, shaders::backdrop_vert, shaders::backdrop_frag}};
  for (const auto& p : programs) {
    auto linked = link_program(p.vertex, p.fragment, p.define);
    if (!linked) return linked.error();
    *p.program = std::move(*linked);
  }
  out.is_software_ = is_software_renderer();
  std::array<GLfloat, 2> widths{1, 1};
  glGetFloatv(GL_ALIASED_LINE_WIDTH_RANGE, widths.data());
  out.widest_line_ = widths[1];
  out.empty_array_ = make_vertex_array();
  out.sheet_array_ = make_vertex_array();
  out.sheet_buffer_ = make_buffer();
  glBindVertexArray(out.sheet_array_.get());
  glBindBuffer(GL_ARRAY_BUFFER, out.sheet_buffer_.get());
  glVertexAttribPointer(0, 3, GL_FLOAT, GL_FALSE, sizeof(glm::vec3), nullptr);
  glEnableVertexAttribArray(0);
  glBindVertexArray(0);
  return out;
}

void GlEngine::resize(int width, int height) {
  if (width == width_ && height == height_) return;
  width_ = width;
  height_ = height;
  target_ = make_framebuffer();
  texture_ = make_texture();
  depth_ = make_renderbuffer();
  allocate_texture(texture_, GL_RGBA8, GL_RGBA, GL_UNSIGNED_BYTE, width, height);
  allocate(depth_, GL_DEPTH_COMPONENT24, width, height, 1);
  attach(target_, depth_);
  glFramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, texture_.get(), 0);
  multi_target_.reset();
}

/// Kept while rough pictures are drawn: they and fine ones follow each other all the time.
void GlEngine::make_multi_target(int samples) {
  if (multi_target_.get() != 0 && samples == samples_) return;
  samples_ = samples;
  multi_target_ = make_framebuffer();
  multi_colour_ = make_renderbuffer();
  multi_depth_ = make_renderbuffer();
  allocate(multi_colour_, GL_RGBA8, width_, height_, samples);
  allocate(multi_depth_, GL_DEPTH_COMPONENT24, width_, height_, samples);
  attach(multi_target_, multi_depth_);
  glFramebufferRenderbuffer(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_RENDERBUFFER,
                            multi_colour_.get());
}

void GlEngine::resize_ids(int width, int height) {
  if (width == id_width_ && height == id_height_) return;
  id_width_ = width;
  id_height_ = height;
  id_target_ = make_framebuffer();
  id_texture_ = make_texture();
  id_depth_ = make_renderbuffer();
  allocate_texture(id_texture_, GL_R32UI, GL_RED_INTEGER, GL_UNSIGNED_INT, width, height);
  allocate(id_depth_, GL_DEPTH_COMPONENT24, width, height, 1);
  attach(id_target_, id_depth_);
  glFramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, id_texture_.get(), 0);
}

void GlEngine::draw_faces(const Scene& scene, const SceneItem& item, int exact_pass) const {
  const GpuMesh& part = mesh(item.slot);
  const glm::vec3 shift = shift_of(scene, part);
  const bool has_fields = item.shows_deviation || scene.has_knife;
  const GlProgram& program = has_fields ? fields_ : faces_;
  glUseProgram(program.get());
  Uniforms(program).set("view_projection", matrix_for(scene, part));
  Uniforms(program).set("section", shifted(scene.section, shift));
  Uniforms(program).set("to_view", glm::mat3(scene.view));
  Uniforms(program).set("opacity", item.opacity);
  Uniforms(program).set("accent", scene.accent);
  Uniforms(program).set("cut_face", scene.cut_face);
  if (has_fields) {
    Uniforms(program).set("knife", shifted(scene.knife, shift));
    Uniforms(program).set("shows_deviation", item.shows_deviation);
    Uniforms(program).set("exact_pass", exact_pass);
    Uniforms(program).set("deviation_scale", item.deviation_scale);
    Uniforms(program).set("has_knife", scene.has_knife);
  }
  part.bind_states();
  // Half of a closed solid is turned away and hidden by the rest.
  const bool has_section = glm::vec3(scene.section) != glm::vec3(0);
  if (part.is_closed() && item.opacity >= 1 && !has_section && !scene.hides_faces &&
      exact_pass == 0) {
    glEnable(GL_CULL_FACE);
  }
  part.draw_faces(scene.is_coarse);
  glDisable(GL_CULL_FACE);
}

void GlEngine::draw_lines(const Scene& scene, const SceneItem& item, bool is_exact) const {
  const GpuMesh& part = mesh(item.slot);
  glUseProgram(lines_.get());
  Uniforms(lines_).set("view_projection", matrix_for(scene, part));
  Uniforms(lines_).set("section", shifted(scene.section, shift_of(scene, part)));
  glm::vec4 plain = scene.line;
  plain.a *= item.opacity;
  Uniforms(lines_).set("plain", plain);
  Uniforms(lines_).set("selected", scene.selected_line);
  // Chords lie inside the round faces that they border on, by up to the tessellation's deflection.
  Uniforms(lines_).set("nearer", is_exact ? 1e-3F * part.diagonal() : 0.0F);
  part.bind_states();
  glLineWidth(std::min(scene.line_width, widest_line_));
  part.draw_lines();
  glLineWidth(1);
}

void GlEngine::draw_wires(const Scene& scene, const SceneItem& item) const {
  const GpuMesh& part = mesh(item.slot);
  glPolygonMode(GL_FRONT_AND_BACK, GL_LINE);
  glEnable(GL_POLYGON_OFFSET_LINE);
  glPolygonOffset(-1, -1);
  glUseProgram(sheets_.get());
  Uniforms(sheets_).set("view_projection", matrix_for(scene, part));
  glm::vec4 tint = scene.line;
  tint.a *= 0.5F;
  Uniforms(sheets_).set("tint", tint);
  part.draw_faces(scene.is_coarse);
  glDisable(GL_POLYGON_OFFSET_LINE);
  glPolygonMode(GL_FRONT_AND_BACK, GL_FILL);
}

void GlEngine::draw_item(const Scene& scene, const SceneItem& item) const {
  if (mesh(item.slot).is_empty()) return;
  glBlendFunc(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA);
  const bool is_exact = item.is_exact && !tree_.is_empty();
  if (item.fades_exact) draw_faces(scene, item, 1);
  if (item.opacity < 1 || item.fades_exact) {
    glEnable(GL_BLEND);
    glDepthMask(GL_FALSE);
    // A glassy mesh lies on the solid that it is compared with: it must win everywhere or nowhere.
    glEnable(GL_POLYGON_OFFSET_FILL);
    glPolygonOffset(-2, -2);
  } else {
    // Steep faces would cover the lines at their rims in places.
    glEnable(GL_POLYGON_OFFSET_FILL);
    glPolygonOffset(1, 1);
  }
  if (is_exact) {
    tree_.draw({scene, width_, height_, mesh(item.slot).states()}, item.opacity);
  } else {
    draw_faces(scene, item, item.fades_exact ? 2 : 0);
  }
  glDisable(GL_POLYGON_OFFSET_FILL);
  glDepthMask(GL_TRUE);
  glEnable(GL_BLEND);
  if (item.has_lines) draw_lines(scene, item, is_exact);
  if (scene.is_wireframe) draw_wires(scene, item);
  glDisable(GL_BLEND);
}

void GlEngine::draw_sheets(const Scene& scene) const {
  glUseProgram(sheets_.get());
  Uniforms(sheets_).set("view_projection", scene.projection * scene.view);
  glBindVertexArray(sheet_array_.get());
  glDepthMask(GL_FALSE);
  for (const SceneSheet& sheet : scene.sheets) {
    const glm::vec3 strip[] = {sheet.corners[0], sheet.corners[1], sheet.corners[3],
                               sheet.corners[2]};
    glBindBuffer(GL_ARRAY_BUFFER, sheet_buffer_.get());
    glBufferData(GL_ARRAY_BUFFER, sizeof strip, strip, GL_STREAM_DRAW);
    Uniforms(sheets_).set("tint", sheet.tint);
    glDrawArrays(GL_TRIANGLE_STRIP, 0, 4);
    const glm::vec4 rim(glm::vec3(sheet.tint), 0.9F);
    glBufferData(GL_ARRAY_BUFFER, sizeof sheet.corners, sheet.corners, GL_STREAM_DRAW);
    Uniforms(sheets_).set("tint", rim);
    glDrawArrays(GL_LINE_LOOP, 0, 4);
  }
  glDepthMask(GL_TRUE);
}

void GlEngine::draw_backdrop(const Scene& scene) const {
  glDisable(GL_DEPTH_TEST);
  glUseProgram(backdrop_.get());
  Uniforms(backdrop_).set("top", scene.top);
  Uniforms(backdrop_).set("bottom", scene.bottom);
  glBindVertexArray(empty_array_.get());
  glDrawArrays(GL_TRIANGLES, 0, 3);
}

void GlEngine::show_mesh(MeshSlot slot, const DisplayMesh* shown) {
  GpuMesh& part = meshes_[static_cast<std::size_t>(slot)];
  if (shown) {
    part.upload(*shown);
  } else {
    part.clear();
  }
}

void GlEngine::set_states(MeshSlot slot, std::span<const LabelState> states) {
  meshes_[static_cast<std::size_t>(slot)].set_states(states);
}

void GlEngine::draw(const Scene& scene, int width, int height, int samples) {
  resize(width, height);
  if (samples > 1) make_multi_target(samples);
  glBindFramebuffer(GL_FRAMEBUFFER, samples > 1 ? multi_target_.get() : target_.get());
  glViewport(0, 0, width, height);
  glDisable(GL_SCISSOR_TEST);
  glDisable(GL_CULL_FACE);
  glDisable(GL_BLEND);
  glDepthMask(GL_TRUE);
  glClear(GL_DEPTH_BUFFER_BIT);
  draw_backdrop(scene);
  glEnable(GL_DEPTH_TEST);
  glEnable(GL_CLIP_DISTANCE0);
  for (const SceneItem& item : scene.items) draw_item(scene, item);
  glDisable(GL_CLIP_DISTANCE0);
  glEnable(GL_BLEND);
  draw_sheets(scene);
  glDisable(GL_BLEND);
  glDisable(GL_DEPTH_TEST);
  if (samples > 1) {
    glBindFramebuffer(GL_READ_FRAMEBUFFER, multi_target_.get());
    glBindFramebuffer(GL_DRAW_FRAMEBUFFER, target_.get());
    glBlitFramebuffer(0, 0, width, height, 0, 0, width, height, GL_COLOR_BUFFER_BIT, GL_NEAREST);
  }
  glBindVertexArray(0);
  glBindFramebuffer(GL_FRAMEBUFFER, 0);
  // The window wants to know what a picture costs.
  const bool has_exact = std::any_of(scene.items.begin(), scene.items.end(),
                                     [](const SceneItem& item) { return item.is_exact; });
  if (is_software_ || has_exact) glFinish();
}

void GlEngine::compose(const Backing& backing, int width, int height) const {
  const auto clear = [](const glm::vec4& c) {
    glClearColor(c.r, c.g, c.b, 1);
    glClear(GL_COLOR_BUFFER_BIT);
  };
  glBindFramebuffer(GL_FRAMEBUFFER, 0);
  glViewport(0, 0, width, height);
  glDisable(GL_SCISSOR_TEST);
  clear(backing.lines);
  glEnable(GL_SCISSOR_TEST);
  for (const BackingFill& fill : backing.fills) {
    glScissor(fill.x, height - fill.y - fill.height, fill.width, fill.height);
    clear(fill.colour);
  }
  glDisable(GL_SCISSOR_TEST);
  if (width_ == 0) return;
  const int bottom = height - backing.picture_y - height_;
  glBindFramebuffer(GL_READ_FRAMEBUFFER, target_.get());
  glBlitFramebuffer(0, 0, width_, height_, backing.picture_x, bottom, backing.picture_x + width_,
                    bottom + height_, GL_COLOR_BUFFER_BIT, GL_NEAREST);
  glBindFramebuffer(GL_FRAMEBUFFER, 0);
}

void GlEngine::read_ids(const Scene& scene, int width, int height, IdImage& out) {
  resize_ids(width, height);
  glBindFramebuffer(GL_FRAMEBUFFER, id_target_.get());
  glViewport(0, 0, width, height);
  glDisable(GL_BLEND);
  glDisable(GL_SCISSOR_TEST);
  const GLuint none[4] = {0, 0, 0, 0};
  glClearBufferuiv(GL_COLOR, 0, none);
  glClear(GL_DEPTH_BUFFER_BIT);
  const bool has_item = !scene.items.empty() && !mesh(scene.items[0].slot).is_empty();
  if (has_item && scene.items[0].is_exact && !tree_.is_empty()) {
    glEnable(GL_DEPTH_TEST);
    tree_.draw_ids({scene, width, height, mesh(scene.items[0].slot).states()});
    glDisable(GL_DEPTH_TEST);
  } else if (has_item) {
    const GpuMesh& part = mesh(scene.items[0].slot);
    glEnable(GL_DEPTH_TEST);
    glEnable(GL_CLIP_DISTANCE0);
    glUseProgram(ids_.get());
    Uniforms(ids_).set("view_projection", matrix_for(scene, part));
    Uniforms(ids_).set("section", shifted(scene.section, shift_of(scene, part)));
    part.bind_states();
    part.draw_faces(false);
    glDisable(GL_CLIP_DISTANCE0);
    glDisable(GL_DEPTH_TEST);
  }
  out.width = width;
  out.height = height;
  out.ids.resize(static_cast<std::size_t>(width) * height);
  glReadPixels(0, 0, width, height, GL_RED_INTEGER, GL_UNSIGNED_INT, out.ids.data());
  glBindVertexArray(0);
  glBindFramebuffer(GL_FRAMEBUFFER, 0);
}

}  // namespace hewn
