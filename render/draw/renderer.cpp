#include "render/draw/renderer.h"

#include "render/draw/packing.h"
#include "render/draw/picture_image.h"
#include "sim/base/check.h"
#include "sim/base/error.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace rend {
namespace {

// [texels]. With eight taps an edge is some five texels wide: softer than at 2048.
constexpr int shadow_side = 1024;
constexpr float shadow_spread = 2.3f; // [texels], of the eight taps (percentage-closer filtering)
constexpr float far_side_tint = 0.74f;
// [pixels]: in lower pictures the line along torn edges gets thinner in proportion, and does not hide the body
constexpr float full_torn_line = 120;
// depth below the floor down to which bodies are drawn, in distances from eye to target
constexpr double sunk = 0.002;
constexpr float shadow_step_out = 2.5f; // offset of the shadow lookup along the normal [texels]

// From [-1, 1]³ to [0, 1]³.
Eigen::Matrix4d to_texture(const Eigen::Matrix4d& clip) {
  Eigen::Matrix4d half = Eigen::Matrix4d::Identity() * 0.5;
  half.topRightCorner<3, 1>().setConstant(0.5);
  half(3, 3) = 1;
  return half * clip;
}

} // namespace

Renderer::Renderer(int width, int height, int samples)
    : width_(width), height_(height), samples_(samples), supersampling_(samples == 16 ? 2 : 1),
      samples_per_texel_(std::min(samples, 4)), composite_(width, height), blocks_(blocks_of(width, height)) {
  CHECK(samples == 1 || samples == 4 || samples == 16);
  GLint largest = 0, most = 0;
  glGetIntegerv(GL_MAX_RENDERBUFFER_SIZE, &largest);
  glGetIntegerv(GL_MAX_SAMPLES, &most);
  largest /= supersampling_;
  if (width < 1 || height < 1 || width > largest || height > largest)
    throw UserError(Exit::BadInput, {}, fmt::format("a picture of {} x {} cannot be drawn.", width, height),
                    fmt::format("Each side may have from 1 to {} pixels.", largest));
  if (samples_per_texel_ > most)
    throw UserError(Exit::BadInput, {}, "this machine's OpenGL cannot take 4 samples a pixel.",
                    "Set samples=\"1\" and draw a larger picture.");
  make_picture();
  // fails early if there is no room for the largest target that may be needed
  make_target(width * supersampling_, height * supersampling_);
  make_shadow_map();
  make_vertex_array();
  check_gl("Stage");
}

// For the bound framebuffer. Whether OpenGL can allocate it is known only by trying.
void Renderer::check_framebuffer_fits() const {
  const bool full = glGetError() == GL_OUT_OF_MEMORY;
  if (!full && glCheckFramebufferStatus(GL_FRAMEBUFFER) == GL_FRAMEBUFFER_COMPLETE) return;
  const std::string picture =
      fmt::format("a picture of {} x {} with {} samples a pixel", width_, height_, samples_);
  const std::string hint = "draw a smaller one, or take fewer samples: --set image.samples=1";
  if (is_within_gl_limits())
    throw UserError(Exit::OutOfBudget, {}, "there is not enough memory for " + picture, hint);
  throw UserError(Exit::BadInput, {}, picture + " is more than this machine's OpenGL can hold", hint);
}

// Whether it could with enough memory: a proxy texture allocates nothing. The depth texture takes as much.
bool Renderer::is_within_gl_limits() const {
  const int width = width_ * supersampling_, height = height_ * supersampling_;
  const bool many = samples_per_texel_ > 1;
  const GLenum proxy = many ? GL_PROXY_TEXTURE_2D_MULTISAMPLE : GL_PROXY_TEXTURE_2D;
  if (many)
    glTexImage2DMultisample(proxy, samples_per_texel_, GL_RGBA8, width, height, GL_TRUE);
  else
    glTexImage2D(proxy, 0, GL_RGBA8, width, height, 0, GL_RGBA, GL_UNSIGNED_BYTE, nullptr);
  GLint held = 0;
  glGetTexLevelParameteriv(proxy, 0, GL_TEXTURE_WIDTH, &held);
  return held == width;
}

void Renderer::make_picture() {
  glBindRenderbuffer(GL_RENDERBUFFER, picture_colour_.name());
  glRenderbufferStorage(GL_RENDERBUFFER, GL_RGBA8, width_, height_);
  glBindFramebuffer(GL_FRAMEBUFFER, picture_.name());
  glFramebufferRenderbuffer(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_RENDERBUFFER, picture_colour_.name());
  check_framebuffer_fits();
}

void Renderer::make_target(int width, int height) {
  const BodyTargets bodies = body_targets({});
  const auto make = [&](const GlTexture& texture, GLenum format, GLenum channels, GLenum numbers) {
    glBindTexture(bodies.kind(), texture.name());
    if (samples_per_texel_ > 1)
      return glTexImage2DMultisample(bodies.kind(), samples_per_texel_, format, width, height, GL_TRUE);
    glTexImage2D(bodies.kind(), 0, static_cast<GLint>(format), width, height, 0, channels, numbers, nullptr);
    glTexParameteri(bodies.kind(), GL_TEXTURE_MAX_LEVEL, 0);
    glTexParameteri(bodies.kind(), GL_TEXTURE_MIN_FILTER, GL_NEAREST);
  };
  make(target_colour_, GL_RGBA8, GL_RGBA, GL_UNSIGNED_BYTE);
  make(target_depth_, GL_DEPTH_COMPONENT24, GL_DEPTH_COMPONENT, GL_UNSIGNED_INT);
  glBindFramebuffer(GL_FRAMEBUFFER, target_.name());
  glFramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, bodies.kind(), bodies.colours, 0);
  glFramebufferTexture2D(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, bodies.kind(), bodies.depth, 0);
  check_framebuffer_fits();
  target_width_ = width;
  target_height_ = height;
}

// Reallocates the target if the covered area does not fit, or is less than half of it; in coarse steps, so that
// moving bodies rarely cause it. The target always starts at the picture's corner: at another origin, vertices
// would be rounded to other sub-pixel positions.
void Renderer::fit_target(const PixelRect& covered) {
  constexpr int step = 128; // [pixels]
  const auto rounded = [&](int size, int most) {
    return std::min((size + step - 1) / step * step, most) * supersampling_;
  };
  const int width = rounded(covered.x + covered.width, width_),
            height = rounded(covered.y + covered.height, height_);
  const bool fits = width <= target_width_ && height <= target_height_;
  if (!fits || 2L * width * height < 1L * target_width_ * target_height_) make_target(width, height);
}

BodyTargets Renderer::body_targets(const PixelRect& covered) const {
  return {target_colour_.name(), target_depth_.name(), samples_per_texel_, supersampling_, covered};
}

void Renderer::make_shadow_map() {
  glBindTexture(GL_TEXTURE_2D, shadow_map_.name());
  glTexImage2D(GL_TEXTURE_2D, 0, GL_DEPTH_COMPONENT32F, shadow_side, shadow_side, 0, GL_DEPTH_COMPONENT,
               GL_FLOAT, nullptr);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_COMPARE_MODE, GL_COMPARE_REF_TO_TEXTURE);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_COMPARE_FUNC, GL_LEQUAL);
  glBindFramebuffer(GL_FRAMEBUFFER, shadow_.name());
  glFramebufferTexture2D(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_TEXTURE_2D, shadow_map_.name(), 0);
  glDrawBuffer(GL_NONE);
  glReadBuffer(GL_NONE);
  check_framebuffer("Stage, shadow map");
}

void Renderer::make_vertex_array() {
  const auto at = [](std::size_t offset) { return reinterpret_cast<const void*>(offset); };
  constexpr GLsizei stride = sizeof(Corner);
  glBindVertexArray(corners_array_.name());
  glBindBuffer(GL_ARRAY_BUFFER, corners_buffer_.name());
  glVertexAttribPointer(0, 3, GL_FLOAT, GL_FALSE, stride, at(offsetof(Corner, position)));
  glVertexAttribPointer(1, 3, GL_FLOAT, GL_FALSE, stride, at(offsetof(Corner, normal)));
  glVertexAttribPointer(2, 4, GL_UNSIGNED_BYTE, GL_TRUE, stride, at(offsetof(Corner, colour)));
  glVertexAttribIPointer(3, 4, GL_UNSIGNED_BYTE, stride, at(offsetof(Corner, line)));
  for (GLuint attribute = 0; attribute < 4; ++attribute) glEnableVertexAttribArray(attribute);
}

void Renderer::draw(const Frame& frame) {
  if (frame.moments.empty()) return draw_plain(frame);
  if (frame.moments.size() == 1) return draw_plain(frame_at(frame, frame.moments.front()));
  if (!blur_) blur_.emplace();
  blur_->start(picture_.name(), width_, height_, !frame.transparent);
  for (const FrameMoment& moment : frame.moments) {
    draw_plain(frame_at(frame, moment));
    blur_->add(moment.weight);
  }
  blur_->finish();
}

void Renderer::draw_plain(const Frame& frame) {
  CHECK(!frame.floor || std::isfinite(frame.floor->z));
  CHECK(Eigen::Map<const Eigen::Array3f>(frame.background.data()).isFinite().all());
  upload(frame);
  const double aspect = static_cast<double>(width_) / height_;
  Eigen::AlignedBox3d bounds;
  for (const Draw& draw : draws_) bounds.extend(draw.bounds);
  const View view = view_of(frame.camera, bounds, aspect);
  const Lights lights = lights_of(frame);
  const Eigen::AlignedBox3d lit = lit_bounds(frame.camera, aspect, bounds);
  const LightView light = light_view(lights.key, lit);

  glEnable(GL_DEPTH_CLAMP);
  draw_shadow_map(light);
  if (frame.has_floor())
    floor_shadow_.build(
        frame.floor->z, view.distance, lights.key, lit, shadow_casters(), [this] { draw_all(); },
        textures_.holes() ? std::optional(UploadedTextures::front_unit) : std::nullopt);
  glDisable(GL_DEPTH_CLAMP);

  blocks_.clear();
  for (const Draw& draw : draws_) mark_covered(blocks_, corners_of(draw), view, width_, height_);
  const BodyTargets bodies = body_targets(pixels_of(blocks_.bounds(), width_, height_));
  draw_bodies(frame, view, lights, light, bodies);
  const bool occluded = frame.occlusion && bodies.covered.width > 0;
  if (occluded) occlude(frame, view, bodies);
  glBindFramebuffer(GL_FRAMEBUFFER, picture_.name());
  composite_.draw(frame, view, bodies, blocks_, floor_shadow_, occluded ? &*occlusion_ : nullptr);
  transparent_ = frame.transparent;
  check_gl("Stage::draw");
}

void Renderer::upload(const Frame& frame) {
  packed_.clear();
  points_.clear();
  draws_.clear();
  for (const auto* bodies : {&frame.bodies, &frame.obstacles})
    for (const FrameBody& body : *bodies) {
      const std::size_t first = packed_.size();
      if (body.texture.any()) points_.resize(first);
      pack(body, packed_, points_);
      const auto packed = std::span(packed_).subspan(first);
      if (packed.empty()) continue;
      draws_.push_back(
          {static_cast<GLint>(first), static_cast<GLsizei>(packed.size()), &body, bounds_of(packed)});
    }
  glBindBuffer(GL_ARRAY_BUFFER, corners_buffer_.name());
  if (packed_.size() > capacity_) {
    // room for the corners that tearing adds from frame to frame
    capacity_ = packed_.size() + packed_.size() / 4;
    glBufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(capacity_ * sizeof(Corner)), nullptr, GL_STREAM_DRAW);
  }
  glBufferSubData(GL_ARRAY_BUFFER, 0, static_cast<GLsizeiptr>(packed_.size() * sizeof(Corner)), packed_.data());
  if (!points_.empty()) points_.resize(packed_.size());
  glBindVertexArray(corners_array_.name());
  textures_.take_those_of(frame, points_);
}

std::span<const Corner> Renderer::corners_of(const Draw& draw) const {
  return {packed_.data() + draw.first, static_cast<std::size_t>(draw.count)};
}

std::vector<std::span<const Corner>> Renderer::shadow_casters() const {
  std::vector<std::span<const Corner>> all;
  for (const Draw& draw : draws_)
    if (draw.body->filled) all.push_back(corners_of(draw));
  return all;
}

void Renderer::draw_all() const {
  glBindVertexArray(corners_array_.name());
  for (const Draw& draw : draws_) {
    if (!draw.body->filled) continue; // wire frames cast no shadow
    if (textures_.holes()) textures_.bind_holes(draw.body->texture);
    glDrawArrays(GL_TRIANGLES, draw.first, draw.count);
  }
}

void Renderer::draw_shadow_map(const LightView& light) {
  glBindFramebuffer(GL_FRAMEBUFFER, shadow_.name());
  glViewport(0, 0, shadow_side, shadow_side);
  glEnable(GL_DEPTH_TEST);
  glDepthFunc(GL_LESS);
  glClear(GL_DEPTH_BUFFER_BIT);
  glEnable(GL_SCISSOR_TEST); // the outermost texels stay empty: no shadow beyond the edge
  glScissor(1, 1, shadow_side - 2, shadow_side - 2);
  glEnable(GL_POLYGON_OFFSET_FILL);
  glPolygonOffset(2, 2);
  if (textures_.holes() && !cut_out_depth_)
    cut_out_depth_.emplace("depth.vert", "depth.frag", "#define CUT_OUT\n");
  const GlProgram& depth = textures_.holes() ? *cut_out_depth_ : depth_;
  depth.use();
  depth.set("world_to_clip", light.world_to_clip);
  if (textures_.holes()) depth.set("front", UploadedTextures::front_unit);
  draw_all();
  glDisable(GL_POLYGON_OFFSET_FILL);
  glDisable(GL_SCISSOR_TEST);
}

void Renderer::draw_bodies(const Frame& frame, const View& view, const Lights& lights, const LightView& light,
                           const BodyTargets& bodies) {
  if (bodies.covered.width == 0) return;
  fit_target(bodies.covered);
  glBindFramebuffer(GL_FRAMEBUFFER, target_.name());
  glViewport(0, 0, width_ * supersampling_, height_ * supersampling_);
  glEnable(GL_DEPTH_TEST);
  glClearColor(0, 0, 0, 0); // transparent: the studio is composited behind
  glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
  glActiveTexture(GL_TEXTURE0);
  glBindTexture(GL_TEXTURE_2D, shadow_map_.name());
  glBindVertexArray(corners_array_.name());
  glEnable(GL_CLIP_DISTANCE0);
  for (const bool filled : {true, false}) { // wire frames last: what is behind them shows through
    const GlProgram* used = nullptr;
    for (const Draw& draw : draws_) {
      if (draw.body->filled != filled) continue;
      if (const GlProgram& program = body_program(*draw.body); &program != used) {
        used = &program;
        program.use();
        set_view(program, frame, view);
        if (filled) set_light(program, lights, light);
      }
      draw_body(*used, draw);
    }
  }
  glDisable(GL_CULL_FACE);
  glDisable(GL_CLIP_DISTANCE0);
}

const GlProgram& Renderer::body_program(const FrameBody& body) {
  const auto& torn = body.torn.colour;
  const FrameTexture& texture = body.texture;
  const bool front = texture.front != nullptr, back = texture.back != nullptr;
  const BodyKind kind{
      body.filled, torn, front, back, front && texture.front->cut_out, body.filled && texture.roughness};
  if (const auto at = body_programs_.find(kind); at != body_programs_.end()) return at->second;
  return body_programs_
      .try_emplace(
          kind, "body.vert", "body.frag",
          fmt::format("#define WIRES {:d}\n#define SHADOW_SPREAD {}\n#define TORN vec3({}, {}, {})\n"
                      "#define FRONT {:d}\n#define BACK {:d}\n#define CUT_OUT {:d}\n#define ROUGHNESS {:d}\n",
                      !kind.filled, shadow_spread / shadow_side, torn[0], torn[1], torn[2], kind.front,
                      kind.back, kind.cut_out, kind.roughness))
      .first->second;
}

void Renderer::set_view(const GlProgram& program, const Frame& frame, const View& view) const {
  program.set("world_to_clip", view.world_to_clip());
  program.set("eye", Eigen::Vector3f(view.eye.cast<float>()));
  program.set("line_scale",
              std::max(static_cast<float>(height_) / 720.0f, 0.5f) * static_cast<float>(supersampling_));
  const bool floor_seen = frame.floor && view.eye.z() > frame.floor->z;
  const double hidden_below = floor_seen ? frame.floor->z - sunk * view.distance : -1e30;
  program.set("hidden_below", static_cast<float>(hidden_below));
}

void Renderer::set_light(const GlProgram& program, const Lights& lights, const LightView& light) {
  const auto texel = static_cast<float>(2 * light.half / shadow_side);
  program.set("world_to_shadow", to_texture(light.world_to_clip));
  program.set("key", Eigen::Vector3f(lights.key.cast<float>()));
  program.set("fill", Eigen::Vector3f(lights.fill.cast<float>()));
  program.set("sky", Eigen::Vector3f(lights.sky.cast<float>()));
  program.set("shadow_offset", shadow_step_out * texel);
  program.set("shadow", 0);
}

void Renderer::set_finish(const GlProgram& program, const FrameBody& body) {
  const Finish& finish = body.finish;
  const float transmission = body.two_sided ? finish.transmission : 0;
  program.set("finish",
              Eigen::Vector4f(finish.gloss, finish.rim, transmission, finish.wrap / (1 + finish.wrap)));
  CHECK(finish.sharpness >= 0 && finish.sharpness < 8);
  const auto bit = [&](int n) { return static_cast<float>(finish.sharpness >> n & 1); };
  program.set("sheen", Eigen::Vector3f(bit(0), bit(1), bit(2)));
}

void Renderer::set_texture(const GlProgram& program, const FrameBody& body) const {
  const FrameTexture& texture = body.texture;
  if (!texture.any()) return;
  textures_.bind(texture);
  if (texture.front) program.set("front", UploadedTextures::front_unit);
  if (body.filled && texture.roughness) program.set("roughness", UploadedTextures::roughness_unit);
  if (!texture.back) return;
  program.set("back", UploadedTextures::back_unit);
  program.set("back_height", texture.back_height);
}

void Renderer::draw_body(const GlProgram& program, const Draw& draw) const {
  const FrameBody& body = *draw.body;
  program.set("cells", body.edges ? 1 : 0);
  const float thinner = std::min(static_cast<float>(height_) / full_torn_line, 1.0f);
  program.set("torn_reach", thinner * body.torn.width / 2);
  if (body.filled) set_finish(program, body);
  Eigen::Vector4f back(0, 0, 0,
                       body.shades_back ? far_side_tint : 1); // the back's own tint, relative to the front's
  if (body.back && body.shades_back) {
    const auto& colour = *body.back;
    back = Eigen::Vector4f(colour[0], colour[1], colour[2], 0) / 255;
  }
  if (!body.texture.back) program.set("far_colour", back);
  set_texture(program, body);
  const bool culled = (!body.two_sided || body.sides != SheetSides::Both) && body.filled;
  glCullFace(body.sides == SheetSides::Back ? GL_FRONT : GL_BACK);
  (culled ? glEnable : glDisable)(GL_CULL_FACE);
  if (!body.filled) {
    glEnable(GL_BLEND);
    glBlendFunc(GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
    glDepthMask(GL_FALSE);
  }
  glDrawArrays(GL_TRIANGLES, draw.first, draw.count);
  glDisable(GL_BLEND);
  glDepthMask(GL_TRUE);
}

void Renderer::occlude(const Frame& frame, const View& view, const BodyTargets& bodies) {
  if (!occlusion_) occlusion_.emplace(width_, height_, samples_per_texel_, supersampling_);
  const bool floor = frame.has_floor() && view.eye.z() > frame.floor->z;
  occlusion_->find(bodies, view, floor ? std::optional(frame.floor->z) : std::nullopt);
}

Image Renderer::read() {
  pixels_.resize(static_cast<std::size_t>(width_) * height_ * 4);
  glBindFramebuffer(GL_READ_FRAMEBUFFER, picture_.name());
  glPixelStorei(GL_PACK_ALIGNMENT, 1);
  glReadPixels(0, 0, width_, height_, GL_RGBA, GL_UNSIGNED_BYTE, pixels_.data());
  check_gl("Stage::read");
  return picture_image(pixels_, width_, height_, transparent_);
}

} // namespace rend
