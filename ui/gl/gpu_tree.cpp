#include "ui/gl/gpu_tree.h"

#include <algorithm>
#include <array>
#include <utility>

#include "ui/gl/shaders.h"
#include "ui/gl/uniforms.h"

namespace hewn {
namespace {

/// Shaders are made for so many stretches: arrays that are seldom full cost registers.
constexpr int kCapacities[] = {16, 40, kMostStretches};
/// Share of the solid's diagonal within which crossings count as one: coincident faces of two
/// literals, as single precision sees them.
constexpr float kSame = 2e-5F;
/// Of the diagonal, around the solid's box: rays must begin outside.
constexpr double kMargin = 1e-3;

glm::vec3 single(const Vec3& v) {
  return {static_cast<float>(v.x()), static_cast<float>(v.y()), static_cast<float>(v.z())};
}

template <class T>
void fill(const GlBuffer& buffer, const GlTexture& texture, GLenum format, const T& values) {
  glBindBuffer(GL_TEXTURE_BUFFER, buffer.get());
  glBufferData(GL_TEXTURE_BUFFER,
               static_cast<GLsizeiptr>(values.size() * sizeof(typename T::value_type)),
               values.data(), GL_STATIC_DRAW);
  glBindTexture(GL_TEXTURE_BUFFER, texture.get());
  glTexBuffer(GL_TEXTURE_BUFFER, format, buffer.get());
}

/// The pixels in which the box may be seen: x, y, width, height, from the bottom left.
std::array<int, 4> pixels_of(const Box3& box, const Vec3& origin, const GpuTree::View& view) {
  const glm::mat4 to_clip = view.scene.projection * view.scene.view;
  glm::vec2 lo(1), hi(-1);
  for (int k = 0; k < 8; ++k) {
    const Vec3 corner((k & 1) ? box.hi.x() : box.lo.x(), (k & 2) ? box.hi.y() : box.lo.y(),
                      (k & 4) ? box.hi.z() : box.lo.z());
    const glm::vec4 clip = to_clip * glm::vec4(single(corner - origin), 1);
    if (clip.w <= 0) return {0, 0, view.width, view.height};  // beside or behind the eye
    lo = glm::min(lo, glm::vec2(clip) / clip.w);
    hi = glm::max(hi, glm::vec2(clip) / clip.w);
  }
  const glm::vec2 size(view.width, view.height);
  const glm::vec2 from = glm::clamp((lo * 0.5F + 0.5F) * size - 1.0F, glm::vec2(0), size);
  const glm::vec2 to = glm::clamp((hi * 0.5F + 0.5F) * size + 2.0F, from, size);
  return {static_cast<int>(from.x), static_cast<int>(from.y), static_cast<int>(to.x - from.x) + 1,
          static_cast<int>(to.y - from.y) + 1};
}

}  // namespace

std::string GpuTree::upload(const TreeProgram* program) {
  program_ = {};
  if (!program) return {};
  const int capacity = *std::find_if(std::begin(kCapacities), std::end(kCapacities) - 1,
                                     [&](int c) { return c >= program->stretches; });
  if (capacity != capacity_) {
    const std::string define = "STRETCHES " + std::to_string(capacity);
    auto picture = link_program(shaders::tree_vert, shaders::tree_frag, define.c_str());
    auto ids = link_program(shaders::tree_vert, shaders::tree_frag,
                            (define + "\n#define HAS_IDS").c_str());
    if (!picture || !ids) return (picture ? ids : picture).error().message;
    picture_ = std::move(*picture);
    ids_ = std::move(*ids);
    capacity_ = capacity;
  }
  if (array_.get() == 0) {
    array_ = make_vertex_array();
    literal_buffer_ = make_buffer();
    step_buffer_ = make_buffer();
    shown_buffer_ = make_buffer();
    literal_texture_ = make_texture();
    step_texture_ = make_texture();
    shown_texture_ = make_texture();
  }
  fill(literal_buffer_, literal_texture_, GL_RGBA32F, program->literals);
  fill(step_buffer_, step_texture_, GL_RGBA32UI, program->steps);
  fill(shown_buffer_, shown_texture_, GL_R32I, program->shown);
  program_ = *program;
  return {};
}

void GpuTree::draw_with(const GlProgram& shader, const View& view) const {
  const Scene& scene = view.scene;
  const Uniforms uniforms(shader);
  const glm::vec3 shift = single(program_.origin - scene.origin);
  const double diagonal = program_.bounds.diagonal();
  const Vec3 margin = Vec3::Constant(kMargin * diagonal);
  uniforms.set("view", scene.view);
  uniforms.set("projection", scene.projection);
  uniforms.set("shift", shift);
  uniforms.set("box_lo", single(program_.bounds.lo - margin - program_.origin));
  uniforms.set("box_hi", single(program_.bounds.hi + margin - program_.origin));
  uniforms.set("section", glm::vec4(glm::vec3(scene.section),
                                    scene.section.w - glm::dot(glm::vec3(scene.section), shift)));
  uniforms.set("same", kSame * static_cast<float>(diagonal));
  uniforms.set("pixel", 2 / (scene.projection[1][1] * static_cast<float>(view.height)));
  uniforms.set("literal_count", static_cast<int>(program_.literals.size()));
  uniforms.set("start", program_.start);
  uniforms.set("states", 0);
  uniforms.set("literals", 1);
  uniforms.set("steps", 2);
  uniforms.set("shown", 3);
  const GLuint textures[] = {view.states, literal_texture_.get(), step_texture_.get(),
                             shown_texture_.get()};
  for (GLenum unit = 4; unit-- > 0;) {  // unit 0 stays the active one
    glActiveTexture(GL_TEXTURE0 + unit);
    glBindTexture(GL_TEXTURE_BUFFER, textures[unit]);
  }
  const auto area =
      pixels_of({program_.bounds.lo - margin, program_.bounds.hi + margin}, scene.origin, view);
  glEnable(GL_SCISSOR_TEST);
  glScissor(area[0], area[1], area[2], area[3]);
  glBindVertexArray(array_.get());
  glDrawArrays(GL_TRIANGLES, 0, 3);
  glDisable(GL_SCISSOR_TEST);
}

void GpuTree::draw(const View& view, float opacity) const {
  glUseProgram(picture_.get());
  const Uniforms uniforms(picture_);
  uniforms.set("opacity", opacity);
  uniforms.set("cut_face", view.scene.cut_face);
  uniforms.set("accent", view.scene.accent);
  // Edges lie inside the one triangle: every sample needs its own ray.
  glEnable(GL_SAMPLE_SHADING);
  glMinSampleShading(1);
  draw_with(picture_, view);
  glDisable(GL_SAMPLE_SHADING);
}

void GpuTree::draw_ids(const View& view) const {
  glUseProgram(ids_.get());
  draw_with(ids_, view);
}

}  // namespace hewn
