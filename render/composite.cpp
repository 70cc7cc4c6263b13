#include "render/composite.h"

#include <fmt/format.h>

namespace rend {
namespace {

constexpr double floor_reach = 4; // where the floor has become backdrop, in distances from eye to target

// Lengths on the floor are taken from below the camera's target, in units of the floor's reach.
void set_floor(const GlProgram& program, const Frame& frame, const View& view) {
  const Eigen::Vector3d centre(frame.camera.target.x(), frame.camera.target.y(), frame.floor->z);
  const Eigen::Matrix3d axes = view.world_to_eye.topLeftCorner<3, 3>().transpose();
  const auto set = [&](const char* name, const Eigen::Vector3d& value) {
    program.set(name, Eigen::Vector3f(value.cast<float>()));
  };
  set("eye", (view.eye - centre) / (floor_reach * view.distance));
  set("ray", -axes.col(2));
  set("ray_x", axes.col(0) / view.eye_to_clip(0, 0));
  set("ray_y", axes.col(1) / view.eye_to_clip(1, 1));
}

void set_shade(const GlProgram& program, const Frame& frame, const View& view, const FloorShadow& shadow) {
  const double reach = floor_reach * view.distance; // [m]
  const Eigen::Matrix<double, 2, 3>& shade = shadow.shade_of_floor();
  const auto set = [&](const char* name, const Eigen::Vector2d& value) {
    program.set(name, Eigen::Vector2f(value.cast<float>()));
  };
  set("shade_origin", shade.leftCols<2>() * frame.camera.target.head<2>() + shade.col(2));
  set("shade_x", shade.col(0) * reach);
  set("shade_y", shade.col(1) * reach);
  program.set("shade", 0);
  glActiveTexture(GL_TEXTURE0);
  glBindTexture(GL_TEXTURE_2D, shadow.shade());
}

void set_bodies(const GlProgram& program, const BodiesPicture& bodies) {
  program.set("colours", 1);
  program.set("origin", bodies.origin());
  glActiveTexture(GL_TEXTURE1);
  glBindTexture(bodies.kind(), bodies.colours);
}

} // namespace

void Composite::draw(const Frame& frame, const View& view, const BodiesPicture& bodies,
                     const FloorShadow& shadow, const Occlusion* occlusion) {
  const Scene scene{frame, view, bodies, shadow, occlusion};
  const PixelBox whole{0, 0, width_, height_}, &covered = bodies.covered;
  const bool floor = frame.floor && !frame.transparent && view.eye.z() > frame.floor->z; // from below there is none
  const Behind bare = frame.transparent ? Behind::Nothing : floor ? Behind::Floor : Behind::Backdrop;
  const Behind shaded = floor ? Behind::FloorInShadow : bare;
  glViewport(0, 0, width_, height_);
  glDisable(GL_DEPTH_TEST);
  glClearColor(0, 0, 0, 0);
  if (frame.transparent) glClear(GL_COLOR_BUFFER_BIT);
  glBindVertexArray(no_array_.name());
  glEnable(GL_SCISSOR_TEST);
  if (covered.width > 0) draw_boxes({true, occlusion != nullptr, shaded}, {covered}, scene);
  if (!frame.transparent) {
    const PixelBox reached = floor ? covered_by(shadow.reached(), view, width_, height_) : PixelBox{};
    std::vector<PixelBox> in_shadow = without(reached, covered), in_light;
    for (const PixelBox& box : without(whole, covered))
      for (const PixelBox& part : without(box, reached)) in_light.push_back(part);
    draw_boxes({false, false, shaded}, in_shadow, scene);
    draw_boxes({false, false, bare}, in_light, scene);
  }
  glDisable(GL_SCISSOR_TEST);
}

void Composite::draw_boxes(const Kind& kind, const std::vector<PixelBox>& boxes, const Scene& scene) {
  if (boxes.empty()) return;
  const GlProgram& used = program(kind, scene.bodies);
  used.use();
  const auto& background = scene.frame.background;
  if (kind.behind >= Behind::Backdrop)
    used.set("background", Eigen::Vector3f(background[0], background[1], background[2]));
  if (kind.behind >= Behind::Floor) set_floor(used, scene.frame, scene.view);
  if (kind.behind >= Behind::FloorInShadow) set_shade(used, scene.frame, scene.view, scene.shadow);
  if (kind.bodies) set_bodies(used, scene.bodies);
  if (kind.occluded) scene.occlusion->set(used, scene.view, scene.bodies, 2);
  for (const PixelBox& box : boxes) {
    glScissor(box.x, box.y, box.width, box.height);
    glDrawArrays(GL_TRIANGLES, 0, 3);
  }
}

const GlProgram& Composite::program(const Kind& kind, const BodiesPicture& bodies) {
  const auto found = programs_.find(kind);
  if (found != programs_.end()) return found->second;
  const std::string definitions =
      fmt::format("#define BODIES {:d}\n#define OCCLUDED {:d}\n#define BEHIND {}\n", kind.bodies, kind.occluded,
                  static_cast<int>(kind.behind)) +
      Occlusion::definitions(bodies.samples, bodies.fine);
  return programs_.try_emplace(kind, "composite.vert", "composite.frag", definitions).first->second;
}

} // namespace rend
