// The renderer: draws a Frame into a picture.
//
// Passes: shadow map of the key light ─▶ floor shadows ─▶ bodies (multisampled) ─▶ ambient occlusion ─▶
// composite.
//
// Bodies are drawn over a transparent background, and the studio (floor and backdrop) is composited behind them
// afterwards, once a pixel: it has no edges to anti-alias, and covers most of the picture. The multisampled
// target covers only the part of the picture where bodies can be: clearing it takes a third of the time of
// drawing the bodies. Parts of bodies below the floor are clipped. Both sides of a sheet are lit; back faces of
// solids are culled. Lines along cells are computed in the fragment shader from barycentric coordinates, so
// they need no geometry and are smooth at any size.
//
// The picture is a pure function of the frame, the size and the number of samples: the same on every run, for
// any number of threads.
//
// A Device must be current, from construction to destruction.
#pragma once

#include "render/draw/composite.h"
#include "render/draw/coverage_grid.h"
#include "render/draw/floor_shadow.h"
#include "render/draw/frame.h"
#include "render/draw/gl.h"
#include "render/draw/light.h"
#include "render/draw/motion_blur.h"
#include "render/draw/occlusion.h"
#include "render/draw/uploaded_textures.h"
#include "render/files/image.h"

#include <array>
#include <map>
#include <optional>
#include <span>
#include <utility>
#include <vector>

namespace rend {

class Renderer {
public:
  // width, height [pixels]; samples a pixel: 1, 4 or 16 (16: 2 x 2 supersampling with 4 samples each, for fine
  // lines and highlights). Throws UserError (BadInput) for a size that cannot be drawn.
  Renderer(int width, int height, int samples);

  // Afterwards the framebuffer of the resolved picture is bound: an overlay may draw on it before read().
  // CHECK: all numbers of the frame are finite. With motion blur it takes as long as the pictures of all
  // moments.
  void draw(const Frame& frame);
  Image read(); // RGB, or RGBA where the frame is transparent

  int width() const { return width_; }
  int height() const { return height_; }

private:
  struct Draw { // a body's range in the vertex buffer
    GLint first = 0;
    GLsizei count = 0;
    const FrameBody* body = nullptr; // of the current frame
    Eigen::AlignedBox3d bounds;      // [m]
  };
  struct BodyKind { // a variant of the program of bodies
    bool filled;
    std::array<float, 3>
        torn; // the colour of torn edges: a uniform would cost every fragment (shaders/body.vert)
    bool front, back, cut_out; // has pictures, and one with holes
    bool roughness;            // has a picture of that
    auto operator<=>(const BodyKind&) const = default;
  };

  void draw_plain(const Frame& frame);
  void make_target(int width, int height);
  void fit_target(const PixelRect& covered);
  void make_picture();
  // UserError where OpenGL cannot allocate the bound framebuffer: BadInput if it is beyond any limit,
  // OutOfBudget for lack of memory.
  void check_framebuffer_fits() const;
  bool is_within_gl_limits() const;
  void make_shadow_map();
  void make_vertex_array();
  void upload(const Frame& frame);
  std::span<const Corner> corners_of(const Draw& draw) const;
  std::vector<std::span<const Corner>> shadow_casters() const; // bodies that cast shadows
  void draw_all() const; // of these bodies; where some have holes, for a program that leaves holes out
  void draw_shadow_map(const LightView& light);
  void draw_bodies(const Frame& frame, const View& view, const Lights& lights, const LightView& light,
                   const BodyTargets& bodies);
  const GlProgram& body_program(const FrameBody& body); // compiled on first use
  void set_view(const GlProgram& program, const Frame& frame, const View& view) const;
  static void set_light(const GlProgram& program, const Lights& lights, const LightView& light);
  static void set_finish(const GlProgram& program, const FrameBody& body);
  void set_texture(const GlProgram& program, const FrameBody& body) const;
  void draw_body(const GlProgram& program, const Draw& draw) const;
  BodyTargets body_targets(const PixelRect& covered) const;
  void occlude(const Frame& frame, const View& view, const BodyTargets& bodies);

  int width_, height_;    // [pixels], of the picture
  int samples_;           // per pixel, as asked for
  int supersampling_;     // texels drawn per pixel, each way: 1 or 2
  int samples_per_texel_; // samples per texel: 1 or 4
  bool transparent_ = false;
  GlProgram depth_{"depth.vert", "depth.frag"};
  std::optional<GlProgram> cut_out_depth_; // created for the first frame in which something has holes
  std::map<BodyKind, GlProgram> body_programs_;
  UploadedTextures textures_;
  FloorShadow floor_shadow_;
  Composite composite_;
  CoverageGrid blocks_;                // of the picture that bodies may cover
  std::optional<Occlusion> occlusion_; // created for the first frame that uses it
  std::optional<MotionBlur> blur_;     // likewise

  GlFramebuffer target_, picture_, shadow_; // target_: of bodies, multisampled
  GlRenderbuffer picture_colour_;
  GlTexture target_colour_, target_depth_, shadow_map_;
  int target_width_ = 0, target_height_ = 0; // [texels]
  GlVertexArray corners_array_;
  GlBuffer corners_buffer_;
  std::size_t capacity_ = 0; // [corners], of that buffer

  std::vector<Corner> packed_;       // the frame's corners, ready for upload
  std::vector<TexturePoint> points_; // one a corner, 0 where there is no picture; empty: nothing has one
  std::vector<Draw> draws_;          // one a body
  std::vector<std::uint8_t> pixels_; // RGBA, bottom row first, as OpenGL returns them
};

} // namespace rend
