#pragma once
/// Shader programs and other objects that live in an OpenGL context.
#include <utility>

#include <epoxy/gl.h>

#include "core/base/result.h"

namespace hewn {

/// Owns one OpenGL name; `Deleter` is called with it.
template <auto Deleter>
class GlName {
 public:
  GlName() = default;
  explicit GlName(GLuint name) : name_(name) {}
  ~GlName() { reset(); }
  GlName(GlName&& other) noexcept : name_(std::exchange(other.name_, 0)) {}
  GlName& operator=(GlName&& other) noexcept {
    if (this != &other) reset(std::exchange(other.name_, 0));
    return *this;
  }
  void reset(GLuint name = 0) {
    if (name_ != 0) Deleter(name_);
    name_ = name;
  }
  GLuint get() const { return name_; }

 private:
  GLuint name_ = 0;
};

inline void delete_buffer(GLuint n) { glDeleteBuffers(1, &n); }
inline void delete_vertex_array(GLuint n) { glDeleteVertexArrays(1, &n); }
inline void delete_texture(GLuint n) { glDeleteTextures(1, &n); }
inline void delete_framebuffer(GLuint n) { glDeleteFramebuffers(1, &n); }
inline void delete_renderbuffer(GLuint n) { glDeleteRenderbuffers(1, &n); }
inline void delete_program(GLuint n) { glDeleteProgram(n); }

using GlBuffer = GlName<delete_buffer>;
using GlVertexArray = GlName<delete_vertex_array>;
using GlTexture = GlName<delete_texture>;
using GlFramebuffer = GlName<delete_framebuffer>;
using GlRenderbuffer = GlName<delete_renderbuffer>;
using GlProgram = GlName<delete_program>;

GlBuffer make_buffer();
GlVertexArray make_vertex_array();
GlTexture make_texture();
GlFramebuffer make_framebuffer();
GlRenderbuffer make_renderbuffer();

/// `define`: a name, and a value if need be, that is defined in both sources; null: none. Fails
/// with Internal: the driver's message.
Result<GlProgram> link_program(const char* vertex_source, const char* fragment_source,
                               const char* define = nullptr);

}  // namespace hewn
