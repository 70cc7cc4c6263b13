// What was drawn of the bodies, with its samples, and nothing behind.
#pragma once

#include "render/draw/gl.h"
#include "render/draw/pixel_box.h"

namespace rend {

struct BodiesPicture {
  GLuint colours = 0, depth = 0; // textures, with samples; colours are multiplied by their alpha
  int samples = 1;               // of each of their pixels: 1 or 4
  int fine = 1;                  // pixels of theirs for one of the picture, each way
  PixelBox covered;              // of the picture: elsewhere are none, and beyond it the textures may end

  GLenum kind() const { return samples == 1 ? GL_TEXTURE_2D : GL_TEXTURE_2D_MULTISAMPLE; }
};

} // namespace rend
