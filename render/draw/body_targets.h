// The render targets of the bodies: colour and depth textures, multisampled, without floor and backdrop.
#pragma once

#include "render/draw/gl.h"
#include "render/draw/pixel_rect.h"

namespace rend {

struct BodyTargets {
  GLuint colours = 0, depth = 0; // textures, multisampled if samples > 1; colours are premultiplied by alpha
  int samples = 1;               // per texel: 1 or 4
  int supersampling = 1;         // texels per pixel of the picture, each way
  PixelRect covered; // [pixels] of the picture: no body is outside of it, and the textures may end beyond it

  GLenum kind() const { return samples == 1 ? GL_TEXTURE_2D : GL_TEXTURE_2D_MULTISAMPLE; }
};

} // namespace rend
