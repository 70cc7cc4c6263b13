// OpenGL objects with RAII, and programs whose uniforms are set by name.
//
// Only for use while a Device is current. The functions are linked from libOSMesa itself, without a loader: the
// loaders that Debian packages look for libGL and give black frames or abort.
#pragma once

#ifndef GL_GLEXT_PROTOTYPES
#define GL_GLEXT_PROTOTYPES
#endif
#include <GL/glcorearb.h>

#include <Eigen/Core>
#include <array>
#include <string>
#include <utility>

namespace rend {

template <auto Create, auto Delete> class GlObject {
public:
  GlObject() { Create(1, &name_); }
  ~GlObject() {
    if (name_ != 0) Delete(1, &name_);
  }
  GlObject(GlObject&& other) noexcept : name_(std::exchange(other.name_, 0)) {}
  GlObject& operator=(GlObject&& other) noexcept {
    std::swap(name_, other.name_);
    return *this;
  }
  GLuint name() const { return name_; }

private:
  GLuint name_ = 0;
};

using GlBuffer = GlObject<glGenBuffers, glDeleteBuffers>;
using GlTexture = GlObject<glGenTextures, glDeleteTextures>;
using GlFramebuffer = GlObject<glGenFramebuffers, glDeleteFramebuffers>;
using GlRenderbuffer = GlObject<glGenRenderbuffers, glDeleteRenderbuffers>;
using GlVertexArray = GlObject<glGenVertexArrays, glDeleteVertexArrays>;

// A vertex and a fragment shader from shaders/, each with common.glsl prepended.
class GlProgram {
public:
  // File names as in shaders/; definitions: #define lines for both.
  GlProgram(const std::string& vertex, const std::string& fragment, const std::string& definitions = "");
  ~GlProgram();
  GlProgram(const GlProgram&) = delete;
  GlProgram& operator=(const GlProgram&) = delete;

  void use() const;
  // Set uniforms of the program in use. CHECK that the program has a uniform of that name.
  void set(const char* name, int value) const;
  void set(const char* name, float value) const;
  void set(const char* name, const Eigen::Vector2i& value) const;
  void set(const char* name, const Eigen::Vector2f& value) const;
  void set(const char* name, const Eigen::Vector3f& value) const;
  void set(const char* name, const Eigen::Vector4f& value) const;
  void set(const char* name, const Eigen::Matrix4d& value) const;

private:
  GLint location(const char* name) const;
  GLuint name_ = 0;
};

// Throws InternalError if OpenGL reported an error, or if the bound framebuffer is not complete; UserError
// (OutOfBudget) if the reason is lack of memory.
void check_gl(const char* where);
void check_framebuffer(const char* where);

} // namespace rend
