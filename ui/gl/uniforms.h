#pragma once
/// Sets uniforms by name.
#include <epoxy/gl.h>
#include <glm/glm.hpp>
#include <glm/gtc/type_ptr.hpp>

#include "ui/gl/program.h"

namespace hewn {

/// One program's uniforms; it must be in use.
class Uniforms {
 public:
  explicit Uniforms(const GlProgram& program) : program_(program.get()) {}

  void set(const char* name, const glm::mat4& m) const {
    glUniformMatrix4fv(at(name), 1, GL_FALSE, glm::value_ptr(m));
  }
  void set(const char* name, const glm::mat3& m) const {
    glUniformMatrix3fv(at(name), 1, GL_FALSE, glm::value_ptr(m));
  }
  void set(const char* name, const glm::vec4& v) const {
    glUniform4fv(at(name), 1, glm::value_ptr(v));
  }
  void set(const char* name, const glm::vec3& v) const {
    glUniform3fv(at(name), 1, glm::value_ptr(v));
  }
  void set(const char* name, const glm::vec2& v) const {
    glUniform2fv(at(name), 1, glm::value_ptr(v));
  }
  void set(const char* name, float v) const { glUniform1f(at(name), v); }
  void set(const char* name, int v) const { glUniform1i(at(name), v); }
  void set(const char* name, unsigned v) const { glUniform1ui(at(name), v); }
  void set(const char* name, bool v) const { glUniform1i(at(name), v ? 1 : 0); }

 private:
  GLint at(const char* name) const { return glGetUniformLocation(program_, name); }
  GLuint program_;
};

}  // namespace hewn
