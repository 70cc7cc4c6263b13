#include "render/draw/occlusion.h"

#include <algorithm>
#include <fmt/format.h>

namespace rend {
namespace {

constexpr int part = 3;                // resolution: one texel for so many pixels of the picture, each way
constexpr double reach_share = 0.11;   // radius of occlusion, in distances from eye to target
constexpr double longest_share = 0.18; // its largest length on the picture, in heights of the picture

constexpr float very_far = 1e9f; // [m]

void make_target(const GlTexture& texture, const GlFramebuffer& target, GLint format, GLenum channels,
                 int width, int height) {
  glBindTexture(GL_TEXTURE_2D, texture.name());
  glTexImage2D(GL_TEXTURE_2D, 0, format, width, height, 0, channels, GL_FLOAT, nullptr);
  // value beyond the border of the picture
  const float far_away[4] = {channels == GL_RED ? very_far : 0, very_far, 0, 0};
  glTexParameterfv(GL_TEXTURE_2D, GL_TEXTURE_BORDER_COLOR, far_away);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_BORDER);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_BORDER);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAX_LEVEL, 0);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
  glBindFramebuffer(GL_FRAMEBUFFER, target.name());
  glFramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, texture.name(), 0);
  check_framebuffer("Occlusion");
}

void bind(int unit, GLenum kind, GLuint texture) {
  glActiveTexture(GL_TEXTURE0 + static_cast<GLenum>(unit));
  glBindTexture(kind, texture);
}

void draw_over(const PixelRect& box) {
  glScissor(box.x, box.y, box.width, box.height);
  glDrawArrays(GL_TRIANGLES, 0, 3);
}

double reach(const View& view) {
  return reach_share * view.distance;
}

// 1 over the difference in depth above which neighbours are on different surfaces [1/m]: a quarter of the
// radius.
float tolerance(const View& view) {
  return static_cast<float>(4 / reach(view));
}

// 1 / depth = x + y * (value of the depth buffer).
Eigen::Vector2f to_nearness(const View& view) {
  const Eigen::Matrix4d& clip = view.eye_to_clip;
  return Eigen::Vector2d((clip(2, 2) - 1) / clip(2, 3), 2 / clip(2, 3)).cast<float>();
}

} // namespace

std::string Occlusion::definitions(int samples, int supersampling) {
  return fmt::format("#define SAMPLES {}\n#define FINE {}\n#define PART {}\n", samples, supersampling, part);
}

Occlusion::Occlusion(int width, int height, int samples, int supersampling)
    : width_(width), height_(height), small_width_((width + part - 1) / part),
      small_height_((height + part - 1) / part),
      depths_program_("occlusion.vert", "occlusion_depth.frag", definitions(samples, supersampling)) {
  make_target(depths_, depths_target_, GL_R32F, GL_RED, small_width_, small_height_);
  make_target(occlusion_texture_, occlusion_target_, GL_RG32F, GL_RG, small_width_, small_height_);
  make_target(blurred_, blurred_target_, GL_RG32F, GL_RG, small_width_, small_height_);
}

void Occlusion::find(const BodyTargets& bodies, const View& view, std::optional<double> floor_z) {
  const PixelRect& covered = bodies.covered;
  const auto longest = static_cast<int>(longest_share * small_height_);
  const auto grown = [&](int margin) { // `covered` in texels of the small picture, enlarged by a margin
    const int x = std::max(covered.x / part - margin, 0), y = std::max(covered.y / part - margin, 0);
    return PixelRect{x, y, std::min((covered.x + covered.width) / part + 1 + margin, small_width_) - x,
                     std::min((covered.y + covered.height) / part + 1 + margin, small_height_) - y};
  };
  glDisable(GL_DEPTH_TEST);
  glDisable(GL_BLEND);
  glEnable(GL_SCISSOR_TEST);
  glViewport(0, 0, small_width_, small_height_);
  read_depths(bodies, view, grown(longest + 7), floor_z);
  compute_occlusion(view, grown(5));
  blur(view, grown(3), occlusion_texture_, blurred_target_, -2);
  blur(view, grown(1), blurred_, occlusion_target_, -1);
  glDisable(GL_SCISSOR_TEST);
}

void Occlusion::set(const GlProgram& program, const View& view, const BodyTargets& bodies, int unit) const {
  program.set("depth", unit);
  program.set("kept", unit + 1);
  program.set("texel", texel());
  program.set("to_nearness", to_nearness(view));
  program.set("tolerance", tolerance(view));
  bind(unit, bodies.kind(), bodies.depth);
  bind(unit + 1, GL_TEXTURE_2D, occlusion_texture_.name());
}

void Occlusion::read_depths(const BodyTargets& bodies, const View& view, const PixelRect& box,
                            std::optional<double> floor_z) {
  Eigen::Vector3d floor = Eigen::Vector3d::Zero(); // 1 / depth of the floor, linear over the small picture
  if (floor_z) {
    const Eigen::Vector3d up = view.world_to_eye.topLeftCorner<3, 3>().col(2); // in eye coordinates
    const double x = up.x() / view.eye_to_clip(0, 0), y = up.y() / view.eye_to_clip(1, 1);
    const double odd_x = 1.0 * part * small_width_ / width_, odd_y = 1.0 * part * small_height_ / height_;
    floor = {x * odd_x, y * odd_y, x * (odd_x - 1) + y * (odd_y - 1) - up.z()};
    floor /= *floor_z - view.eye.z();
  }
  glBindFramebuffer(GL_FRAMEBUFFER, depths_target_.name());
  depths_program_.use();
  depths_program_.set("floor_plane", Eigen::Vector3f(floor.cast<float>()));
  depths_program_.set("depth", 0);
  depths_program_.set("end",
                      Eigen::Vector2i(width_ * bodies.supersampling - 1, height_ * bodies.supersampling - 1));
  depths_program_.set("to_nearness", to_nearness(view));
  bind(0, bodies.kind(), bodies.depth);
  draw_over(box);
}

void Occlusion::compute_occlusion(const View& view, const PixelRect& box) {
  const double across = 1 / view.eye_to_clip(0, 0), up = 1 / view.eye_to_clip(1, 1);
  const Eigen::Vector4d ray(-across, -up, 2.0 * part / width_ * across, 2.0 * part / height_ * up);
  glBindFramebuffer(GL_FRAMEBUFFER, occlusion_target_.name());
  occlusion_program_.use();
  occlusion_program_.set("depths", 0);
  occlusion_program_.set("texel", texel());
  occlusion_program_.set("ray", Eigen::Vector4f(ray.cast<float>()));
  occlusion_program_.set("reach", static_cast<float>(reach(view)));
  occlusion_program_.set("pixels", static_cast<float>(1 / ray.w()));
  occlusion_program_.set("longest", static_cast<float>(longest_share * small_height_));
  bind(0, GL_TEXTURE_2D, depths_.name());
  draw_over(box);
}

void Occlusion::blur(const View& view, const PixelRect& box, const GlTexture& from, const GlFramebuffer& to,
                     int first) {
  glBindFramebuffer(GL_FRAMEBUFFER, to.name());
  blur_program_.use();
  blur_program_.set("kept", 0);
  blur_program_.set("texel", texel());
  blur_program_.set("first", static_cast<float>(first));
  blur_program_.set("tolerance", tolerance(view));
  bind(0, GL_TEXTURE_2D, from.name());
  draw_over(box);
}

} // namespace rend
