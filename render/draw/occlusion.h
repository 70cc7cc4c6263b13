// Ambient occlusion: how much of the light from all around is kept from a place by what stands near it. It
// darkens folds, cracks and the gaps of a heap, where shadows of lamps are not enough.
//
// Found in the picture itself, from the depths that the bodies left, at a third of its size each way (at half
// of it, it takes 8 ms more):
//
//   depths ─▶ what is kept along a slice ─▶ mean over 4 x 4 ─▶ multiplied into the bodies (composite.h)
//
// The visibility of a place is the cosine-weighted share of its hemisphere that is free. For one slice of the
// hemisphere through the eye, with n the angle of the normal in it and h1 ≤ n ≤ h2 the angles of the two
// horizons, it is
//
//   V = |n'| / 4 Σ (cos n + 2 h sin n - cos(2 h - n)),   n': the normal projected into the slice,
//
// and what is kept is V without horizons less V with them. A horizon is what rises highest over the surface at
// four depths along the slice; its squared sine counts in full up to 0.6 of the reach, and falls to nothing
// there, which comes within 0.03 of rays whose hits count less with the squared distance. Neighbours in a block
// of 4 x 4 take 16 slices and 4 offsets along them, always the same, and the mean over those that lie on the
// same surface brings them together: 128 depths for a place. A plane keeps nothing from itself, nor does a
// convex body but for 2 % along sharp edges. What is hidden or out of the picture keeps nothing either.
//
// Source: Jimenez, Wu, Pesce and Jarabo, Practical real-time strategies for accurate indirect occlusion, 2016.
//
// A Device must be current, from construction to destruction.
#pragma once

#include "render/draw/bodies_picture.h"
#include "render/draw/camera.h"

#include <optional>
#include <string>

namespace rend {

class Occlusion {
public:
  // width, height [pixels], of the picture; samples, fine: of the bodies that come (bodies_picture.h).
  Occlusion(int width, int height, int samples, int fine);

  // floor_z: of a floor that is seen [m].
  void find(const BodiesPicture& bodies, const View& view, std::optional<double> floor_z);
  // For a program that multiplies it into the picture (composite.frag), which is in use: its textures and
  // numbers, from a texture unit on.
  void set(const GlProgram& program, const View& view, const BodiesPicture& bodies, int unit) const;
  static std::string definitions(int samples, int fine); // for shaders that read samples

private:
  void read_depths(const BodiesPicture& bodies, const View& view, const PixelBox& box,
                   std::optional<double> floor_z);
  void find_kept(const View& view, const PixelBox& box);
  void blur(const View& view, const PixelBox& box);
  Eigen::Vector2f texel() const {
    return {1.0f / static_cast<float>(small_width_), 1.0f / static_cast<float>(small_height_)};
  }

  int width_, height_, small_width_, small_height_; // [pixels]
  GlProgram depths_program_;
  GlProgram kept_program_{"screen.vert", "occlusion.frag"};
  GlProgram blur_program_{"screen.vert", "occlusion_blur.frag"};
  GlTexture depths_, kept_, blurred_; // small: depth [m]; the other two: what is kept, depth [m]
  GlFramebuffer depths_target_, kept_target_, blurred_target_;
};

} // namespace rend
