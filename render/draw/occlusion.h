// Ambient occlusion: the share of ambient light that nearby surfaces block at a point. It darkens folds, cracks
// and the gaps of a heap, which the shadow of the key light alone does not show.
//
// Computed in screen space from the bodies' depth buffer, at a third of the resolution each way (at half of it,
// it takes 8 ms more):
//
//   depths ─▶ occlusion along a slice ─▶ mean over 4 x 4, twice ─▶ multiplied into the bodies (composite.h)
//
// The visibility of a point is the cosine-weighted unoccluded share of its hemisphere. For one slice of the
// hemisphere through the eye, with n the angle of the normal in it and h1 ≤ n ≤ h2 the angles of the two
// horizons, it is
//
//   V = |n'| / 4 Σ (cos n + 2 h sin n - cos(2 h - n)),   n': the normal projected into the slice,
//
// and the occlusion is V without horizons minus V with them. A horizon is the highest of four depth samples
// along the slice; its squared sine counts in full up to 0.6 of the radius, and falls off to 0 at the radius,
// which is within 0.03 of ray casting with a fall-off by squared distance. The pixels of a 4 x 4 block take 16
// slices and 4 offsets along them, in a fixed pattern, and are averaged over those on the same surface: 128
// depth samples for a point. At the edge of a surface a block contains only some of the slices, so that
// neighbouring blocks differ: a second mean, over blocks that lie the other way, smooths this. A plane does
// not occlude itself, nor does a convex body, up to 2 % along sharp edges. Surfaces that are hidden or outside
// the picture do not occlude.
//
// Source: Jimenez, Wu, Pesce and Jarabo, Practical real-time strategies for accurate indirect occlusion, 2016.
//
// A Device must be current, from construction to destruction.
#pragma once

#include "render/draw/body_targets.h"
#include "render/draw/camera.h"

#include <optional>
#include <string>

namespace rend {

class Occlusion {
public:
  // width, height [pixels] of the picture; samples, supersampling: as in the BodyTargets given to find().
  Occlusion(int width, int height, int samples, int supersampling);

  // Computes the occlusion. floor_z: height of the floor if it is visible [m].
  void find(const BodyTargets& bodies, const View& view, std::optional<double> floor_z);
  // Binds textures, from a texture unit on, and sets uniforms of the program in use, which multiplies the
  // occlusion into the picture (composite.frag).
  void set(const GlProgram& program, const View& view, const BodyTargets& bodies, int unit) const;
  static std::string definitions(int samples, int supersampling); // #defines for shaders that read samples

private:
  void read_depths(const BodyTargets& bodies, const View& view, const PixelRect& box,
                   std::optional<double> floor_z);
  void compute_occlusion(const View& view, const PixelRect& box);
  // Over the texels first to first + 3 away, along each axis.
  void blur(const View& view, const PixelRect& box, const GlTexture& from, const GlFramebuffer& to, int first);
  Eigen::Vector2f texel() const {
    return {1.0f / static_cast<float>(small_width_), 1.0f / static_cast<float>(small_height_)};
  }

  int width_, height_, small_width_, small_height_; // [pixels]
  GlProgram depths_program_;
  GlProgram occlusion_program_{"screen.vert", "occlusion.frag"};
  GlProgram blur_program_{"screen.vert", "occlusion_blur.frag"};
  // small textures: depth [m]; the other two: occlusion, depth [m], averaged once, and not at all or twice
  GlTexture depths_, occlusion_texture_, blurred_;
  GlFramebuffer depths_target_, occlusion_target_, blurred_target_;
};

} // namespace rend
