// The pictures of bodies as OpenGL has them: uploaded when a frame first has them, dropped with the first frame
// that no longer does.
//
// OpenGL is to filter light, and the shaders' light is the square of an sRGB number (shaders/common.glsl): so
// texels are uploaded as such squares, times alpha, of 16 bits. A picture of one colour then looks as a body of
// that colour does. (GL_SRGB8_ALPHA8 takes half of the memory, but decodes another curve, and that for each of
// the eight texels of a fragment: where a sheet fills the picture, a frame takes 1.5 times what it takes
// without a texture, and 1.33 times so.)
//
// A Device must be current, from construction to destruction.
#pragma once

#include "render/draw/frame.h"
#include "render/draw/gl.h"

#include <map>
#include <memory>
#include <span>

namespace rend {

class UploadedTextures {
public:
  // Texture units: 0 to 2 are those of shadows.
  static constexpr int front_unit = 3, back_unit = 4, roughness_unit = 5;

  // places: one per corner of the vertex array that is bound; empty: nothing has a picture.
  // UserError (OutOfBudget) if there is not enough memory.
  void take_those_of(const Frame& frame, std::span<const TexturePoint> places);
  bool holes() const { return holes_; } // in something of that frame

  // To be sampled by the program in use, as `front`, `back` and `roughness`. CHECK: it was taken.
  void bind(const FrameTexture& texture) const;
  // Its front where that has holes, elsewhere one without, as `front`. CHECK: something in the frame has holes.
  void bind_holes(const FrameTexture& texture) const;

private:
  void take_places(std::span<const TexturePoint> places);
  void take(const std::shared_ptr<const Texture>& texture);
  void bind(int unit, const Texture& texture, Wrap wrap) const;

  std::map<std::shared_ptr<const Texture>, GlTexture> textures_;
  GlBuffer places_;
  bool holes_ = false;
  std::shared_ptr<const Texture> opaque_; // one white pixel; null: not needed yet
};

} // namespace rend
