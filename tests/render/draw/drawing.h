// A framebuffer, and programs with their own fragment shaders: for tests that draw without a Renderer. A Device
// must be current.
#pragma once

#include "render/draw/gl.h"
#include "render/draw/shaders.h"

#include <gtest/gtest.h>
#include <vector>

namespace rend::test {

using Pixel = std::array<std::uint8_t, 4>; // RGBA
using Pixels = std::vector<Pixel>;         // rows from the bottom up, as in OpenGL

class Canvas {
public:
  Canvas(int width, int height, const Pixel& filled) : width_(width), height_(height) {
    glBindRenderbuffer(GL_RENDERBUFFER, colour_.name());
    glRenderbufferStorage(GL_RENDERBUFFER, GL_RGBA8, width, height);
    bind();
    glFramebufferRenderbuffer(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_RENDERBUFFER, colour_.name());
    check_framebuffer("Canvas");
    glClearColor(filled[0] / 255.0f, filled[1] / 255.0f, filled[2] / 255.0f, filled[3] / 255.0f);
    glClear(GL_COLOR_BUFFER_BIT);
  }
  void bind() const {
    glBindFramebuffer(GL_FRAMEBUFFER, target_.name());
    glViewport(0, 0, width_, height_);
  }
  Pixels read() const {
    bind();
    Pixels all(static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_));
    glPixelStorei(GL_PACK_ALIGNMENT, 1);
    glReadPixels(0, 0, width_, height_, GL_RGBA, GL_UNSIGNED_BYTE, all.data());
    check_gl("Canvas");
    return all;
  }

private:
  int width_, height_; // [pixels]
  GlFramebuffer target_;
  GlRenderbuffer colour_;
};

// A fragment shader with boxes.vert as its vertex shader.
class FragmentProgram {
public:
  explicit FragmentProgram(const char* fragment) : name_(glCreateProgram()) {
    attach(GL_VERTEX_SHADER, std::string(shader_source("boxes.vert")));
    attach(GL_FRAGMENT_SHADER, fragment);
    glLinkProgram(name_);
    GLint linked = 0;
    glGetProgramiv(name_, GL_LINK_STATUS, &linked);
    EXPECT_EQ(linked, GL_TRUE);
  }
  ~FragmentProgram() { glDeleteProgram(name_); }
  FragmentProgram(const FragmentProgram&) = delete;
  FragmentProgram& operator=(const FragmentProgram&) = delete;
  void use() const { glUseProgram(name_); }

private:
  void attach(GLenum kind, const std::string& text) const {
    const GLuint shader = glCreateShader(kind);
    const std::string whole = "#version 330 core\n" + text;
    const char* start = whole.c_str();
    glShaderSource(shader, 1, &start, nullptr);
    glCompileShader(shader);
    glAttachShader(name_, shader);
    glDeleteShader(shader); // lives as long as the program
  }
  GLuint name_;
};

} // namespace rend::test
