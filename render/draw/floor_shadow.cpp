#include "render/draw/floor_shadow.h"

#include <algorithm>
#include <cmath>

namespace rend {
namespace {

// of the key light, seen from the floor: width of the penumbra per distance of the occluder
constexpr double light_width = 0.22;
constexpr int blur_side = 64;          // [texels]; small, since the width of the blur varies slowly
constexpr int shade_side = 256;        // [texels]: 512 would take 17 ms more, and differ by at most 9 of 255
constexpr double contact_reach = 0.08; // height at which the contact shadow ends, per scale of the picture

// How far the blurred picture of a body extends beyond it, in texels of the coarsest level used: bilinear
// lookups take two texels, and each level adds one texel of the level before it.
constexpr double blurred_over = 3.1;

void clamp_to_edge(GLint filter) {
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, filter);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
}

void make_target(const GlTexture& texture, const GlFramebuffer& target, GLint format, GLenum channels,
                 int side) {
  glBindTexture(GL_TEXTURE_2D, texture.name());
  glTexImage2D(GL_TEXTURE_2D, 0, format, side, side, 0, channels, GL_UNSIGNED_BYTE, nullptr);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAX_LEVEL, 0);
  clamp_to_edge(GL_LINEAR);
  glBindFramebuffer(GL_FRAMEBUFFER, target.name());
  glFramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, texture.name(), 0);
  check_framebuffer("FloorShadow");
}

// Lookups beyond the edge return the edge texel (clamp to edge): the outermost texels stay 0, no shadow.
void begin_with_empty_rim(const GlFramebuffer& target, int side) {
  glBindFramebuffer(GL_FRAMEBUFFER, target.name());
  glViewport(0, 0, side, side);
  glDisable(GL_SCISSOR_TEST);
  glClearColor(0, 0, 0, 0);
  glClear(GL_COLOR_BUFFER_BIT);
  glEnable(GL_SCISSOR_TEST);
  glScissor(1, 1, side - 2, side - 2);
}

// From (x, y, z, 1) [m] to texture coordinates of a light's view.
Eigen::Matrix<float, 2, 4> texture_of(const LightView& view) {
  Eigen::Matrix<double, 2, 4> map = 0.5 * view.world_to_clip.topRows<2>();
  map.col(3).array() += 0.5;
  return map.cast<float>();
}

// From (x, y, 1) on the floor [m] to texture coordinates of a light's view.
Eigen::Matrix<double, 2, 3> texture_of_floor(const LightView& view, double floor_z) {
  Eigen::Matrix<double, 2, 3> map;
  map << view.world_to_clip.topLeftCorner<2, 2>(),
      view.world_to_clip.block<2, 1>(0, 2) * floor_z + view.world_to_clip.block<2, 1>(0, 3);
  map *= 0.5;
  map.col(2).array() += 0.5;
  return map;
}

} // namespace

MipPyramid::MipPyramid(int side, int levels) : side_(side), levels_(static_cast<std::size_t>(levels)) {
  glBindTexture(GL_TEXTURE_2D, texture_.name());
  for (int level = 0; level < levels; ++level)
    glTexImage2D(GL_TEXTURE_2D, level, GL_RG16, side >> level, side >> level, 0, GL_RG, GL_UNSIGNED_SHORT,
                 nullptr);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAX_LEVEL, levels - 1);
  clamp_to_edge(GL_LINEAR_MIPMAP_LINEAR);
  for (int level = 0; level < levels; ++level) {
    glBindFramebuffer(GL_FRAMEBUFFER, levels_[static_cast<std::size_t>(level)].name());
    glFramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, texture_.name(), level);
    check_framebuffer("Pyramid");
  }
}

void MipPyramid::build(const GlProgram& halve, const Eigen::AlignedBox2f& drawn,
                       const std::function<void()>& draw) {
  begin_with_empty_rim(levels_[0], side_);
  if (!drawn.isEmpty()) draw();

  halve.use();
  halve.set("source", 0);
  glActiveTexture(GL_TEXTURE0);
  glBindTexture(GL_TEXTURE_2D, texture_.name());
  const int count = static_cast<int>(levels_.size());
  for (int level = 1; level < count; ++level) {
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_BASE_LEVEL, level - 1); // reads one level, writes the next
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAX_LEVEL, level - 1);
    begin_with_empty_rim(levels_[static_cast<std::size_t>(level)], side_ >> level);
    if (drawn.isEmpty()) continue;
    // a texel of margin for the blur, and one for rounding; the outermost texel stays empty
    const auto at = [&](float u) {
      return std::clamp(static_cast<int>(std::floor(u * static_cast<float>(side_ >> level))), 3,
                        (side_ >> level) - 3);
    };
    const int x = at(drawn.min().x()) - 2, y = at(drawn.min().y()) - 2;
    glScissor(x, y, at(drawn.max().x()) + 2 - x, at(drawn.max().y()) + 2 - y);
    glDrawArrays(GL_TRIANGLES, 0, 3);
  }
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_BASE_LEVEL, 0);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAX_LEVEL, count - 1);
  glDisable(GL_SCISSOR_TEST);
}

FloorShadow::FloorShadow() {
  make_target(blur_, blur_target_, GL_R16, GL_RED, blur_side);
  make_target(shade_, shade_target_, GL_RG8, GL_RG, shade_side);
}

void FloorShadow::build(double floor_z, double scale, const Eigen::Vector3d& towards_key,
                        const Eigen::AlignedBox3d& lit, const std::vector<std::span<const Corner>>& triangles,
                        const std::function<void()>& draw, std::optional<int> holes) {
  const double contact = contact_reach * scale;      // [m]
  const Eigen::Vector3d around(contact, contact, 0); // margin for the blur, which extends beyond the bodies
  const Eigen::AlignedBox3d covered(lit.min() - around, lit.max() + around);
  const LightView key = light_view(towards_key, covered), above = light_view(Eigen::Vector3d::UnitZ(), covered);
  const double key_reach = 2 * key.half; // [m]
  // The blur of a level is about two of its texels wide.
  const double key_texel = 2 * key.half / key_.side(), contact_texel = 2 * above.half / contact_.side();
  const double penumbra = std::log2(light_width * key_reach / towards_key.z() / (2 * key_texel));
  const double contact_level = std::clamp(std::log2(0.4 * contact / contact_texel), 0.0, 4.0);
  shade_of_floor_ = texture_of_floor(key, floor_z);

  const double contact_blur = blurred_over * std::exp2(std::ceil(contact_level)) * contact_texel; // [m]
  Views views{texture_of(key), texture_of(above), {}, static_cast<float>(floor_z + contact), {}, {}};
  views.below << shade_of_floor_.leftCols<2>().cast<float>(), Eigen::Vector2f::Zero(),
      shade_of_floor_.col(2).cast<float>();
  views.key_blur.setConstant(static_cast<float>(blurred_over * 16 / key_.side()));
  views.contact_blur = (shade_of_floor_.leftCols<2>().rowwise().norm() * contact_blur).cast<float>();
  find_reached(views, triangles);

  glDisable(GL_DEPTH_TEST);
  glEnable(GL_BLEND);
  glBlendEquation(GL_MAX);
  if (holes && !cut_out_occluder_)
    cut_out_occluder_.emplace("occluder.vert", "occluder.frag", "#define CUT_OUT\n");
  const GlProgram& occluder = holes ? *cut_out_occluder_ : occluder_;
  const auto occluders = [&](const LightView& view, double reach, float sharpness) {
    return [&, reach, sharpness] {
      occluder.use();
      occluder.set("world_to_clip", view.world_to_clip);
      occluder.set("floor_z", static_cast<float>(floor_z));
      occluder.set("reach", static_cast<float>(reach));
      occluder.set("sharpness", sharpness);
      if (holes) occluder.set("front", *holes);
      draw();
    };
  };
  key_.build(halve_, key_drawn_, occluders(key, key_reach, 1));
  contact_.build(halve_, contact_drawn_, occluders(above, contact, 2));
  glDisable(GL_BLEND);
  glBlendEquation(GL_FUNC_ADD);
  render_blur_levels(penumbra);
  render_shade(contact_level, texture_of_floor(above, floor_z));
}

// Marks the squares that the blurred shadow of any triangle can reach on the floor.
void FloorShadow::find_reached(const Views& views, const std::vector<std::span<const Corner>>& triangles) {
  reached_.clear();
  key_drawn_.setEmpty();
  contact_drawn_.setEmpty();
  const auto squares = static_cast<float>(reached_.columns());
  const auto seen = [](const Eigen::Matrix<float, 2, 4>& view, const Corner* corner) {
    Eigen::AlignedBox2f box;
    for (int k = 0; k < 3; ++k) {
      const auto& p = corner[k].position;
      box.extend(Eigen::Vector2f(view.col(0) * p[0] + view.col(1) * p[1] + view.col(2) * p[2] + view.col(3)));
    }
    return box;
  };
  const auto mark = [&](const Eigen::AlignedBox2f& box, const Eigen::Vector2f& blur) {
    const Eigen::Vector2f low = (box.min() - blur) * squares, high = (box.max() + blur) * squares;
    reached_.mark(low.x(), low.y(), high.x(), high.y());
  };
  for (const std::span<const Corner>& corners : triangles)
    for (std::size_t n = 0; n + 2 < corners.size(); n += 3) {
      const Corner* corner = &corners[n];
      const Eigen::AlignedBox2f along_key = seen(views.key, corner);
      key_drawn_.extend(along_key);
      mark(along_key, views.key_blur);
      if (std::min({corner[0].position[2], corner[1].position[2], corner[2].position[2]}) > views.low) continue;
      contact_drawn_.extend(seen(views.above, corner));
      mark(seen(views.below, corner), views.contact_blur);
    }
}

void FloorShadow::render_blur_levels(double penumbra) {
  begin_with_empty_rim(blur_target_, blur_side);
  glDisable(GL_SCISSOR_TEST);
  blur_level_program_.use();
  blur_level_program_.set("penumbra", static_cast<float>(penumbra));
  blur_level_program_.set("occluders", 0);
  glActiveTexture(GL_TEXTURE0);
  glBindTexture(GL_TEXTURE_2D, key_.texture());
  glDrawArrays(GL_TRIANGLES, 0, 3);
}

void FloorShadow::render_shade(double contact_level, const Eigen::Matrix<double, 2, 3>& contact_of_floor) {
  // shade = A floor + a, contact = C floor + c: contact = C A⁻¹ shade + (c - C A⁻¹ a)
  const Eigen::Matrix2d turn = contact_of_floor.leftCols<2>() * shade_of_floor_.leftCols<2>().inverse();
  const Eigen::Vector2d origin = contact_of_floor.col(2) - turn * shade_of_floor_.col(2);
  begin_with_empty_rim(shade_target_, shade_side);
  shade_program_.use();
  shade_program_.set("contact_level", static_cast<float>(contact_level));
  shade_program_.set("contact_origin", Eigen::Vector2f(origin.cast<float>()));
  shade_program_.set("contact_x", Eigen::Vector2f(turn.col(0).cast<float>()));
  shade_program_.set("contact_y", Eigen::Vector2f(turn.col(1).cast<float>()));
  shade_program_.set("occluders", 0);
  shade_program_.set("contact", 1);
  shade_program_.set("blur", 2);
  glActiveTexture(GL_TEXTURE2);
  glBindTexture(GL_TEXTURE_2D, blur_.name());
  glActiveTexture(GL_TEXTURE1);
  glBindTexture(GL_TEXTURE_2D, contact_.texture());
  glActiveTexture(GL_TEXTURE0);
  glBindTexture(GL_TEXTURE_2D, key_.texture());
  const auto marked = [&](int column, int row) { return reached_.at(column, row) ? 1 : 0; };
  rect_painter_.draw(runs(reached_.columns(), reached_.rows(), 2, marked)[1], reached_.columns(),
                     reached_.rows());
  glDisable(GL_SCISSOR_TEST);
}

} // namespace rend
