#include "render/app/viewpoint.h"

#include "render/camera.h"
#include "sim/base/math.h"

namespace rend {
namespace {

using Bounds = Eigen::AlignedBox3d;

Vec3 corner_of(const Bounds& box, int n) {
  return box.corner(static_cast<Bounds::CornerType>(n));
}

Bounds bounds_of(const Body& body) {
  Bounds box;
  const CellIndex& cells = body.map->cells(Vertex);
  for (Slot v = 0; v < cells.slots(); ++v)
    if (cells.alive(v)) box.extend(body.map->position()[v].vec());
  return box;
}

// Whether prescribed vertices hold the body on all sides: then it sags, but does not swing down.
bool held_all_around(const Body& body, const Bounds& box, int vertical) {
  Bounds held;
  for (Slot v : body.constraints.vertices()) held.extend(body.map->position()[v].vec());
  if (held.isEmpty()) return false;
  for (int axis = 0; axis < 3; ++axis)
    if (axis != vertical && held.sizes()[axis] < 0.9 * box.sizes()[axis]) return false;
  return true;
}

Bounds room_of(const Body& body, double duration) {
  const Bounds box = bounds_of(body);
  Bounds room = box;
  for (const Motion& motion : body.constraints.motions())
    for (int n = 0; n < 8; ++n) room.extend(corner_of(box, n) + motion.offset(corner_of(box, n), duration));
  const Vec3 gravity = body.gravity;
  if (gravity.norm() == 0) return room;
  int vertical = 0;
  gravity.cwiseAbs().maxCoeff(&vertical);
  const double size = box.sizes().maxCoeff();
  const double hang = held_all_around(body, box, vertical) ? 0 : 0.9 * size - box.sizes()[vertical];
  const Vec3 down = gravity.normalized() * std::max(0.15 * size, hang);
  const Bounds below(room.min() + down, room.max() + down);
  return room.merged(below);
}

// Towards the side that a flat thing shows: from the front, a little from the right and from above.
Vec3 best_direction(const Bounds& box) {
  int thin = 0;
  box.sizes().minCoeff(&thin);
  if (thin == 2) return {0.45, -1, 0.75};
  return thin == 1 ? Vec3(0.35, -1, 0.25) : Vec3(1, -0.35, 0.25);
}

Bounds bounds_of(const Sphere& sphere) {
  const Vec3 reach = Vec3::Constant(sphere.radius);
  return {sphere.start - reach, sphere.start + reach};
}

// What a sphere needs that moves: where it starts, and where it goes to as far as that is in the bodies' room,
// or it would make them small.
Bounds room_of(const Sphere& sphere, const Bounds& bodies, const Vec3& gravity, double duration) {
  const Bounds start = bounds_of(sphere);
  Vec3 way = duration * sphere.velocity;
  if (sphere.falls()) way += 0.5 * duration * duration * gravity;
  const Bounds end(start.min() + way, start.max() + way);
  return start.merged(bodies.intersection(start.merged(end)));
}

} // namespace

Bounds room_of(const Scene& scene, double duration) {
  Bounds start, room;
  for (const auto& body : scene.bodies()) {
    start.extend(bounds_of(*body));
    room.extend(room_of(*body, duration));
  }
  const World& world = scene.world();
  for (const Box& box : world.boxes) room.extend(box.low).extend(box.high);
  const Bounds bodies = room;
  for (const Sphere& sphere : world.spheres) room.extend(room_of(sphere, bodies, world.gravity, duration));
  if (const auto floor = world.floor)
    room.min().z() = std::max(room.min().z(), std::min(*floor, start.min().z()));
  return room;
}

Viewpoint::Viewpoint(const Node& preset, const Scene& scene, double aspect, double duration)
    : duration_(duration) {
  const Node* camera = preset.child("camera");
  Bounds start;
  for (const auto& body : scene.bodies()) start.extend(bounds_of(*body));
  const bool has_eye = camera && camera->given("eye");
  if (camera) {
    start_.up = camera->vector("up");
    start_.fov = camera->number("fov");
    turn_ = camera->number("turn");
  }
  start_.target = camera && camera->given("target") ? camera->vector("target") : Vec3(start.center());
  Vec3 direction = best_direction(start);
  if (has_eye) {
    start_.eye = camera->vector("eye");
    direction = start_.eye - start_.target;
    if (direction.norm() < 1e-9 * (1 + start_.target.norm()))
      camera->fail("eye", "the camera's eye stands at its target", "move it away from there");
  }
  if (has_eye && !(camera->has("frame") && camera->text("frame") == "auto")) return;
  const FrameCamera fitted = frame_auto(room_of(scene, duration), start_.fov, aspect, direction);
  start_.eye = fitted.eye;
  start_.target = fitted.target;
}

FrameCamera Viewpoint::at(double time) const {
  FrameCamera camera = start_;
  if (turn_ == 0 || duration_ <= 0) return camera;
  const double angle = turn_ * time / duration_;
  const double c = cosine_of_degrees(angle), s = sine_of_degrees(angle);
  const Vec3 axis = start_.up.normalized(), arm = start_.eye - start_.target;
  camera.eye = start_.target + c * arm + s * axis.cross(arm) + (1 - c) * axis.dot(arm) * axis;
  return camera;
}

} // namespace rend
