// The stage: draws a Frame into a picture.
//
// Passes: shadow map from the key light ─▶ floor's shadows ─▶ bodies (with samples) ─▶ occlusion ─▶ composite.
//
// Bodies are drawn over nothing, and the studio (floor and backdrop) is put behind them afterwards, once a
// pixel: it has no edges that samples would smooth, and covers most of the picture. Samples are there for the
// part of the picture alone that bodies can cover: clearing them takes as long as a third of the bodies. What
// is under the floor is clipped away. Both sides of a sheet are lit; of a solid, only the outside is drawn.
// Lines along cells are worked out in the fragment shader, from barycentric coordinates, so they cost no
// geometry and are smooth at any size.
//
// The picture is a pure function of the frame, the size and the number of samples: the same on every run, for
// any number of threads.
//
// A Device must be current, from construction to destruction.
#pragma once

#include "render/draw/composite.h"
#include "render/draw/floor_shadow.h"
#include "render/draw/frame.h"
#include "render/draw/gl.h"
#include "render/draw/light.h"
#include "render/draw/occlusion.h"
#include "render/draw/pixel_footprint.h"
#include "render/files/image.h"

#include <optional>
#include <span>
#include <vector>

namespace rend {

class Stage {
public:
  // width, height [pixels]; samples a pixel: 1, 4 or 16 (4 of each of 4 pixels that become one, for fine lines
  // and gloss). Throws UserError (BadInput) for a size that cannot be drawn.
  Stage(int width, int height, int samples);

  // Afterwards the resolved picture is the bound framebuffer: an overlay may draw on it before read().
  // CHECK: all numbers of the frame are finite.
  void draw(const Frame& frame);
  Image read(); // RGB, or RGBA where the frame is transparent

  int width() const { return width_; }
  int height() const { return height_; }

private:
  struct Draw { // a body's corners in the vertex buffer
    GLint first = 0;
    GLsizei count = 0;
    const FrameBody* body = nullptr; // of the frame at hand
    Eigen::AlignedBox3d bounds;      // [m]
  };

  void make_target(int width, int height);
  void fit_target(const PixelBox& covered);
  void make_picture();
  // UserError where OpenGL has no room for what was asked for: BadInput for more than it can ever hold,
  // OutOfBudget for want of memory.
  void must_hold() const;
  bool can_ever_hold() const;
  void make_shadow_map();
  void make_vertex_array();
  void upload(const Frame& frame);
  std::span<const Corner> corners_of(const Draw& draw) const;
  std::vector<std::span<const Corner>> casting() const; // what throws shadows
  void draw_all() const;                                // the same
  void draw_shadow_map(const LightView& light);
  void draw_bodies(const Frame& frame, const View& view, const Lights& lights, const LightView& light,
                   const BodiesPicture& bodies);
  const GlProgram& body_program(bool filled); // compiled when it is first asked for
  void set_view(const GlProgram& program, const Frame& frame, const View& view) const;
  static void set_light(const GlProgram& program, const Lights& lights, const LightView& light);
  static void set_finish(const GlProgram& program, const FrameBody& body);
  void draw_body(const GlProgram& program, const Draw& draw) const;
  BodiesPicture bodies_picture(const PixelBox& covered) const;
  void occlude(const Frame& frame, const View& view, const BodiesPicture& bodies);

  int width_, height_; // [pixels], of the picture
  int samples_;        // a pixel, as asked for
  int fine_;           // pixels that are drawn for one of the picture, each way: 1 or 2
  int taken_;          // samples of each of those: 1 or 4
  bool transparent_ = false;
  GlProgram depth_{"depth.vert", "depth.frag"};
  std::optional<GlProgram> body_, wires_; // of bodies that are filled, and of the others
  FloorShadow floor_shadow_;
  Composite composite_;
  Footprint blocks_;                   // of the picture, that bodies cover
  std::optional<Occlusion> occlusion_; // made for the first frame that has it

  GlFramebuffer target_, picture_, shadow_; // target_: of bodies, with samples
  GlRenderbuffer picture_colour_;
  GlTexture target_colour_, target_depth_, shadow_map_;
  int target_width_ = 0, target_height_ = 0; // [pixels], fine
  GlVertexArray corners_array_;
  GlBuffer corners_buffer_;
  std::size_t capacity_ = 0; // of that buffer [corners]

  std::vector<Corner> packed_;       // the frame's corners, ready for upload
  std::vector<Draw> draws_;          // one a body
  std::vector<std::uint8_t> pixels_; // RGBA, bottom row first: as OpenGL hands them over
};

} // namespace rend
