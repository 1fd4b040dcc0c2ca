#include "ui/gl/program.h"

#include <string>

namespace hewn {
namespace {

template <class Get>
std::string log_of(GLuint object, const Get& get) {
  std::string log(2048, '\0');
  GLsizei length = 0;
  get(object, static_cast<GLsizei>(log.size()), &length, log.data());
  log.resize(static_cast<std::size_t>(length));
  return log;
}

Result<GLuint> compile(GLenum stage, std::string source, const char* define) {
  // The version must stay the first line.
  if (define) source.insert(source.find('\n') + 1, std::string("#define ") + define + "\n");
  const GLuint shader = glCreateShader(stage);
  const char* text = source.c_str();
  glShaderSource(shader, 1, &text, nullptr);
  glCompileShader(shader);
  GLint done = GL_FALSE;
  glGetShaderiv(shader, GL_COMPILE_STATUS, &done);
  if (done == GL_TRUE) return shader;
  Error error{ErrorCode::Internal, log_of(shader, glGetShaderInfoLog), "shader"};
  glDeleteShader(shader);
  return error;
}

template <class Name, class Make>
Name made(const Make& make) {
  GLuint name = 0;
  make(1, &name);
  return Name(name);
}

}  // namespace

GlBuffer make_buffer() { return made<GlBuffer>(glGenBuffers); }
GlVertexArray make_vertex_array() { return made<GlVertexArray>(glGenVertexArrays); }
GlTexture make_texture() { return made<GlTexture>(glGenTextures); }
GlFramebuffer make_framebuffer() { return made<GlFramebuffer>(glGenFramebuffers); }
GlRenderbuffer make_renderbuffer() { return made<GlRenderbuffer>(glGenRenderbuffers); }

Result<GlProgram> link_program(const char* vertex_source, const char* fragment_source,
                               const char* define) {
  auto vertex = compile(GL_VERTEX_SHADER, vertex_source, define);
  if (!vertex) return vertex.error();
  auto fragment = compile(GL_FRAGMENT_SHADER, fragment_source, define);
  if (!fragment) {
    glDeleteShader(*vertex);
    return fragment.error();
  }
  GlProgram program(glCreateProgram());
  glAttachShader(program.get(), *vertex);
  glAttachShader(program.get(), *fragment);
  glLinkProgram(program.get());
  glDeleteShader(*vertex);
  glDeleteShader(*fragment);
  GLint done = GL_FALSE;
  glGetProgramiv(program.get(), GL_LINK_STATUS, &done);
  if (done != GL_TRUE) {
    return Error{ErrorCode::Internal, log_of(program.get(), glGetProgramInfoLog), "shader"};
  }
  return program;
}

}  // namespace hewn
