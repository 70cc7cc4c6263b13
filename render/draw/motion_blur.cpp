#include "render/draw/motion_blur.h"

#include "sim/base/check.h"

#include <Eigen/Geometry>

#include <cmath>

namespace rend {
namespace {

Corner between(const Corner& a, const Corner& b, float share) {
  Corner out = b;
  Eigen::Vector3f normal;
  for (std::size_t k = 0; k < 3; ++k) {
    out.position[k] = a.position[k] + share * (b.position[k] - a.position[k]);
    normal[static_cast<Eigen::Index>(k)] = a.normal[k] + share * (b.normal[k] - a.normal[k]);
    const auto from = static_cast<float>(a.colour[k]), to = static_cast<float>(b.colour[k]);
    out.colour[k] = static_cast<std::uint8_t>(std::lround(from + share * (to - from)));
  }
  const float length = normal.norm();
  if (length > 1e-3f) // otherwise that of the later state: in between it turns over
    for (std::size_t k = 0; k < 3; ++k) out.normal[k] = normal[static_cast<Eigen::Index>(k)] / length;
  return out;
}

std::vector<FrameBody> between(const std::vector<FrameBody>& a, const std::vector<FrameBody>& b, float share) {
  CHECK(a.size() == b.size());
  std::vector<FrameBody> out = b;
  for (std::size_t n = 0; n < out.size(); ++n) {
    CHECK(a[n].corners.size() == b[n].corners.size());
    for (std::size_t k = 0; k < out[n].corners.size(); ++k)
      out[n].corners[k] = between(a[n].corners[k], b[n].corners[k], share);
  }
  return out;
}

} // namespace

Frame frame_at(const Frame& frame, const FrameMoment& moment) {
  const FrameState &before = frame.states.at(moment.before), &after = frame.states.at(moment.after);
  const bool exact = moment.share >= 1;
  CHECK(exact || before.shape == after.shape);
  const auto share = static_cast<float>(moment.share);
  Frame out;
  out.time = frame.time;
  out.number = frame.number;
  out.bodies = exact ? after.bodies : between(before.bodies, after.bodies, share);
  out.obstacles = exact ? after.obstacles : between(before.obstacles, after.obstacles, share);
  out.floor = frame.floor;
  out.camera = moment.camera;
  out.light = frame.light;
  out.background = frame.background;
  out.transparent = frame.transparent;
  out.floor_shadow = frame.floor_shadow;
  out.occlusion = frame.occlusion;
  return out;
}

void MotionBlur::start(GLuint picture, int width, int height, bool opaque) {
  picture_ = picture;
  width_ = width;
  height_ = height;
  pixels_.resize(std::size_t{4} * static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
  average_.start(pixels_.size(), opaque);
}

void MotionBlur::add(int weight) {
  glBindFramebuffer(GL_READ_FRAMEBUFFER, picture_);
  glPixelStorei(GL_PACK_ALIGNMENT, 1);
  glReadPixels(0, 0, width_, height_, GL_RGBA, GL_UNSIGNED_BYTE, pixels_.data());
  average_.add(pixels_, weight);
}

void MotionBlur::finish() {
  average_.mean(pixels_);
  glBindTexture(GL_TEXTURE_2D, mean_.name());
  glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
  glTexImage2D(GL_TEXTURE_2D, 0, GL_RGBA8, width_, height_, 0, GL_RGBA, GL_UNSIGNED_BYTE, pixels_.data());
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAX_LEVEL, 0);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
  glBindFramebuffer(GL_READ_FRAMEBUFFER, mean_target_.name());
  glFramebufferTexture2D(GL_READ_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, mean_.name(), 0);
  glBindFramebuffer(GL_DRAW_FRAMEBUFFER, picture_);
  glBlitFramebuffer(0, 0, width_, height_, 0, 0, width_, height_, GL_COLOR_BUFFER_BIT, GL_NEAREST);
  glBindFramebuffer(GL_FRAMEBUFFER, picture_);
  check_gl("MotionBlur");
}

} // namespace rend
