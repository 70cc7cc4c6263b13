#include "render/draw/composite.h"

#include <fmt/format.h>
#include <optional>

namespace rend {
namespace {

// where the floor has faded into the backdrop, in distances from eye to target
constexpr double floor_reach = 4;

// The floor's ray equation, in terms that are linear over the picture (composite.vert). Lengths on the floor
// are measured from the point below the camera's target, in units of the floor's reach.
struct FloorView {
  FloorView(const Frame& frame, const View& view, const FloorShadow& shadow);
  Eigen::Vector3d along(double x, double y) const { return ray + x * ray_x + y * ray_y; } // corners at -1 and 1
  // Where the ray through a block's corner hits the shade texture, in texture coordinates; none: it misses the
  // floor.
  std::optional<Eigen::Vector2d> shade_at(double x, double y) const;

  Eigen::Vector3d eye, ray, ray_x, ray_y;
  Eigen::Vector2d shade_origin, shade_x, shade_y;
};

FloorView::FloorView(const Frame& frame, const View& view, const FloorShadow& shadow) {
  const double reach = floor_reach * view.distance; // [m]
  const Eigen::Vector3d centre(frame.camera.target.x(), frame.camera.target.y(), frame.floor->z);
  const Eigen::Matrix3d axes = view.world_to_eye.topLeftCorner<3, 3>().transpose();
  eye = (view.eye - centre) / reach;
  ray = -axes.col(2);
  ray_x = axes.col(0) / view.eye_to_clip(0, 0);
  ray_y = axes.col(1) / view.eye_to_clip(1, 1);
  const Eigen::Matrix<double, 2, 3>& shade = shadow.shade_of_floor();
  shade_origin = shade.leftCols<2>() * centre.head<2>() + shade.col(2);
  shade_x = shade.col(0) * reach;
  shade_y = shade.col(1) * reach;
}

std::optional<Eigen::Vector2d> FloorView::shade_at(double x, double y) const {
  const Eigen::Vector3d away = along(x, y);
  if (!(away.z() < -1e-6)) return std::nullopt;
  const Eigen::Vector2d at = eye.head<2>() - eye.z() / away.z() * away.head<2>();
  return shade_origin + at.x() * shade_x + at.y() * shade_y;
}

void set(const GlProgram& program, const char* name, const Eigen::Vector3d& value) {
  program.set(name, Eigen::Vector3f(value.cast<float>()));
}
void set(const GlProgram& program, const char* name, const Eigen::Vector2d& value) {
  program.set(name, Eigen::Vector2f(value.cast<float>()));
}

void set_floor(const GlProgram& program, const FloorView& floor) {
  set(program, "eye", floor.eye);
  set(program, "ray", floor.ray);
  set(program, "ray_x", floor.ray_x);
  set(program, "ray_y", floor.ray_y);
}

void set_shade(const GlProgram& program, const FloorView& floor, GLuint shade) {
  set(program, "shade_origin", floor.shade_origin);
  set(program, "shade_x", floor.shade_x);
  set(program, "shade_y", floor.shade_y);
  program.set("shade", 0);
  glActiveTexture(GL_TEXTURE0);
  glBindTexture(GL_TEXTURE_2D, shade);
}

// Whether a shadow may reach a block of pixels.
bool in_shadow(const FloorView& floor, const CoverageGrid& reached, const PixelRect& block, int width,
               int height) {
  Eigen::AlignedBox2d seen; // in squares of `reached`
  int hits = 0;
  for (int corner = 0; corner < 4; ++corner) {
    const double x = block.x + (corner & 1) * block.width, y = block.y + (corner >> 1) * block.height;
    const auto at = floor.shade_at(2 * x / width - 1, 2 * y / height - 1);
    if (at) seen.extend(Eigen::Vector2d(*at * reached.columns()));
    hits += at ? 1 : 0;
  }
  if (hits < 4) return hits > 0;  // the block crosses the horizon: a shadow may be anywhere in it
  constexpr double margin = 0.05; // for rounding
  const auto f = [](double number) { return static_cast<float>(number); };
  return reached.any(f(seen.min().x() - margin), f(seen.min().y() - margin), f(seen.max().x() + margin),
                     f(seen.max().y() + margin));
}

void set_bodies(const GlProgram& program, const BodyTargets& bodies) {
  program.set("colours", 1);
  glActiveTexture(GL_TEXTURE1);
  glBindTexture(bodies.kind(), bodies.colours);
}

} // namespace

void Composite::draw(const Frame& frame, const View& view, const BodyTargets& bodies,
                     const CoverageGrid& blocks, const FloorShadow& shadow, const Occlusion* occlusion) {
  const bool seen = frame.has_floor() && view.eye.z() > frame.floor->z; // the floor is invisible from below
  const std::optional<FloorView> floor = seen ? std::optional(FloorView(frame, view, shadow)) : std::nullopt;
  const Background bare = frame.transparent ? Background::Nothing
                          : floor           ? Background::Floor
                                            : Background::Backdrop;
  const Background shaded = !floor              ? bare
                            : frame.transparent ? Background::ShadowAlone
                                                : Background::FloorInShadow;
  glViewport(0, 0, width_, height_);
  glDisable(GL_DEPTH_TEST);
  glClearColor(0, 0, 0, 0);
  if (frame.transparent) glClear(GL_COLOR_BUFFER_BIT);

  const auto kind = [&](int column, int row) {
    if (blocks.at(column, row)) return 0;
    const PixelRect block = pixels_of({column, row, 1, 1}, width_, height_);
    return floor && in_shadow(*floor, shadow.reached(), block, width_, height_) ? 1 : 2;
  };
  const auto draw_blocks = [&](const Kind& what, std::vector<PixelRect> boxes) {
    if (boxes.empty()) return;
    const GlProgram& used = program(what, bodies);
    used.use();
    if (what.background >= Background::Backdrop && what.background != Background::ShadowAlone)
      used.set("background", Eigen::Vector3f(frame.background.data()));
    if (what.background >= Background::Floor) set_floor(used, *floor);
    if (what.background >= Background::FloorInShadow) set_shade(used, *floor, shadow.shade());
    if (what.bodies) set_bodies(used, bodies);
    if (what.occluded) occlusion->set(used, view, bodies, 2);
    for (PixelRect& box : boxes) box = pixels_of(box, width_, height_);
    rect_painter_.draw(boxes, width_, height_);
  };
  const auto boxes = runs(blocks.columns(), blocks.rows(), 3, kind);
  draw_blocks({.bodies = true, .occluded = occlusion != nullptr, .background = shaded}, boxes[0]);
  draw_blocks({.bodies = false, .occluded = false, .background = shaded}, boxes[1]);
  if (frame.transparent) return;
  draw_blocks({.bodies = false, .occluded = false, .background = bare}, boxes[2]);
}

const GlProgram& Composite::program(const Kind& kind, const BodyTargets& bodies) {
  const auto found = programs_.find(kind);
  if (found != programs_.end()) return found->second;
  const std::string definitions = fmt::format("#define BODIES {:d}\n#define OCCLUDED {:d}\n#define BEHIND {}\n",
                                              kind.bodies, kind.occluded, static_cast<int>(kind.background)) +
                                  Occlusion::definitions(bodies.samples, bodies.supersampling);
  return programs_.try_emplace(kind, "composite.vert", "composite.frag", definitions).first->second;
}

} // namespace rend
