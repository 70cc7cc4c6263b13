#include "render/draw/gl.h"

#include "render/draw/shaders.h"
#include "render/files/memory_left.h"
#include "sim/base/check.h"

#include <fmt/format.h>

namespace rend {
namespace {

std::string log_of(GLuint name, decltype(glGetShaderiv) get, decltype(glGetShaderInfoLog) read) {
  GLint length = 0;
  get(name, GL_INFO_LOG_LENGTH, &length);
  std::string text(static_cast<std::size_t>(std::max(length, 1)), '\0');
  read(name, length, nullptr, text.data());
  return text;
}

GLuint compile(GLenum kind, const std::string& file, const std::string& definitions) {
  const GLuint name = glCreateShader(kind);
  const std::string header = "#version 330 core\n" + definitions;
  const std::string common(shader_source("common.glsl"));
  const std::string own(shader_source(file));
  const std::array<const char*, 3> texts{header.c_str(), common.c_str(), own.c_str()};
  glShaderSource(name, static_cast<GLsizei>(texts.size()), texts.data(), nullptr);
  glCompileShader(name);
  GLint compiled = 0;
  glGetShaderiv(name, GL_COMPILE_STATUS, &compiled);
  CHECK_NOTE(compiled == GL_TRUE, file + ": " + log_of(name, glGetShaderiv, glGetShaderInfoLog));
  return name;
}

} // namespace

GlProgram::GlProgram(const std::string& vertex, const std::string& fragment, const std::string& definitions)
    : name_(glCreateProgram()) {
  for (const GLuint shader :
       {compile(GL_VERTEX_SHADER, vertex, definitions), compile(GL_FRAGMENT_SHADER, fragment, definitions)}) {
    glAttachShader(name_, shader);
    glDeleteShader(shader); // lives as long as the program
  }
  glLinkProgram(name_);
  GLint linked = 0;
  glGetProgramiv(name_, GL_LINK_STATUS, &linked);
  CHECK_NOTE(linked == GL_TRUE, fragment + ": " + log_of(name_, glGetProgramiv, glGetProgramInfoLog));
}

GlProgram::~GlProgram() {
  glDeleteProgram(name_);
}

void GlProgram::use() const {
  glUseProgram(name_);
}

GLint GlProgram::location(const char* name) const {
  const GLint location = glGetUniformLocation(name_, name);
  CHECK_NOTE(location >= 0, fmt::format("the program has no uniform {}", name));
  return location;
}

void GlProgram::set(const char* name, int value) const {
  glUniform1i(location(name), value);
}
void GlProgram::set(const char* name, float value) const {
  glUniform1f(location(name), value);
}
void GlProgram::set(const char* name, const Eigen::Vector2i& value) const {
  glUniform2iv(location(name), 1, value.data());
}
void GlProgram::set(const char* name, const Eigen::Vector2f& value) const {
  glUniform2fv(location(name), 1, value.data());
}
void GlProgram::set(const char* name, const Eigen::Vector3f& value) const {
  glUniform3fv(location(name), 1, value.data());
}
void GlProgram::set(const char* name, const Eigen::Vector4f& value) const {
  glUniform4fv(location(name), 1, value.data());
}
void GlProgram::set(const char* name, const Eigen::Matrix4d& value) const {
  const Eigen::Matrix4f rounded = value.cast<float>();
  glUniformMatrix4fv(location(name), 1, GL_FALSE, rounded.data());
}

namespace {

// After an out-of-memory error Mesa may have drawn less than it was told: the picture is not valid.
void check_memory(GLenum error) {
  if (error == GL_OUT_OF_MEMORY || !is_memory_left()) refuse_without_memory();
}

} // namespace

void check_gl(const char* where) {
  const GLenum error = glGetError();
  check_memory(error);
  CHECK_NOTE(error == GL_NO_ERROR, fmt::format("OpenGL error 0x{:04x} in {}", error, where));
}

void check_framebuffer(const char* where) {
  const GLenum status = glCheckFramebufferStatus(GL_FRAMEBUFFER);
  // an attachment without storage is a lack of memory
  if (status != GL_FRAMEBUFFER_COMPLETE) check_memory(glGetError());
  CHECK_NOTE(status == GL_FRAMEBUFFER_COMPLETE, fmt::format("framebuffer 0x{:04x} in {}", status, where));
}

} // namespace rend
