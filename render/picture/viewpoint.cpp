#include "render/picture/viewpoint.h"

#include "render/draw/camera.h"
#include "sim/base/archive.h"
#include "sim/base/key_times.h"
#include "sim/base/math.h"
#include "sim/base/reach.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace rend {
namespace {

using Bounds = Eigen::AlignedBox3d;

Vec3 corner_of(const Bounds& box, int n) {
  return box.corner(static_cast<Bounds::CornerType>(n));
}

// A camera that is to see farther than a preset can put anything shows nothing else.
Vec3 in_reach(const Vec3& x) {
  return x.unaryExpr([](double c) { return std::isnan(c) ? 0 : std::clamp(c, -farthest, farthest); });
}

// Whether fixed vertices hold the body on all sides: then it sags, but does not swing down.
bool held_all_around(const Body& body, const Bounds& box, int vertical) {
  Bounds held;
  for (Slot v : body.constraints.vertices()) held.extend(body.map->position()[v].vec());
  if (held.isEmpty()) return false;
  for (int axis = 0; axis < 3; ++axis)
    if (axis != vertical && held.sizes()[axis] < 0.9 * box.sizes()[axis]) return false;
  return true;
}

Bounds bounds_to_frame(const Body& body, double duration) {
  const Bounds box = bounds_of(body);
  Bounds room = box;
  for (const Motion& motion : body.constraints.motions())
    for (int n = 0; n < 8; ++n)
      room.extend(in_reach(corner_of(box, n) + motion.offset(corner_of(box, n), motion.at(duration))));
  const Vec3 gravity = body.gravity;
  if (gravity.norm() == 0) return room;
  int vertical = 0;
  gravity.cwiseAbs().maxCoeff(&vertical);
  const double size = box.sizes().maxCoeff();
  const double hang = held_all_around(body, box, vertical) ? 0 : 0.9 * size - box.sizes()[vertical];
  const Vec3 down = gravity.normalized() * std::max(0.15 * size, hang);
  const Bounds below(in_reach(room.min() + down), in_reach(room.max() + down));
  return room.merged(below);
}

// The angle of view of a lens must be one that fov may have.
double fov_of_lens(const SettingsSource& source, double lens, double aspect) {
  const double fov = rend::fov_of_lens(lens, aspect);
  if (fov < least_fov || fov > most_fov)
    source.fail(
        "lens",
        fmt::format("a lens of {:g} mm sees {:.3g} degrees from bottom to top of this picture", lens, fov),
        fmt::format("from {:g} to {:g} are possible", least_fov, most_fov));
  return fov;
}

// To round-off: no direction is left.
bool at_target(const Vec3& eye, const Vec3& target) {
  return (eye - target).norm() < 1e-9 * (1 + target.norm());
}

// Faces the flat side of a thin body, slightly from the right and from above.
Vec3 best_direction(const Bounds& box) {
  int thin = 0;
  box.sizes().minCoeff(&thin);
  if (thin == 2) return {0.45, -1, 0.75};
  return thin == 1 ? Vec3(0.35, -1, 0.25) : Vec3(1, -0.35, 0.25);
}

Bounds bounds_of(const Sphere& sphere, const Vec3& centre) {
  const Vec3 reach = Vec3::Constant(sphere.radius);
  return {centre - reach, centre + reach};
}

Bounds bounds_of(const Box& box, const Pose& pose) {
  const Bounds still(box.low, box.high);
  Bounds around;
  for (int n = 0; n < 8; ++n) around.extend(in_reach(pose.of(corner_of(still, n))));
  return around;
}

Bounds bounds_of(const MeshObstacle& mesh, const Pose& pose) {
  Bounds around;
  for (const Vec3& x : mesh.surface.points) around.extend(in_reach(pose.of(x)));
  return around;
}

// What the camera should show of an obstacle that moves: its start, and its path as far as it lies in the
// bodies' box; all of it would make the bodies small. `at`: its bounds at a time [s].
template <class At> Bounds bounds_of_path(const Bounds& bodies, double duration, At&& at) {
  constexpr int looks = 32;
  const Bounds start = at(0);
  Bounds path = start;
  for (int n = 1; n <= looks; ++n) path.extend(at(duration * n / looks));
  return start.merged(bodies.intersection(path));
}

// A box or a mesh.
template <class Obstacle>
Bounds bounds_to_frame(const Obstacle& obstacle, const Bounds& bodies, double duration) {
  return bounds_of_path(bodies, duration,
                        [&](double time) { return bounds_of(obstacle, obstacle.pose(time)); });
}

Bounds bounds_to_frame(const Sphere& sphere, const Bounds& bodies, const Vec3& gravity, double duration) {
  if (sphere.follows_keys())
    return bounds_of_path(bodies, duration, [&](double time) {
      return bounds_of(sphere, in_reach(sphere.motion.at(sphere.start, time).place));
    });
  const Bounds start = bounds_of(sphere, sphere.start);
  Vec3 way = duration * sphere.velocity;
  if (sphere.falls()) way += 0.5 * duration * duration * gravity;
  const Bounds end(in_reach(start.min() + way), in_reach(start.max() + way));
  return start.merged(bodies.intersection(start.merged(end)));
}

} // namespace

Bounds bounds_of(const Body& body) {
  Bounds box;
  const CellIndex& cells = body.map->cells(Vertex);
  for (Slot v = 0; v < cells.slots(); ++v)
    if (cells.alive(v)) box.extend(body.map->position()[v].vec());
  return box;
}

Bounds bounds_to_frame(const Scene& scene, double duration) {
  Bounds start, room;
  for (const auto& body : scene.bodies()) {
    start.extend(bounds_of(*body));
    room.extend(bounds_to_frame(*body, duration));
  }
  const World& world = scene.world();
  for (const Box& box : world.boxes)
    if (!box.moves()) room.extend(box.low).extend(box.high);
  for (const MeshObstacle& mesh : world.meshes)
    if (!mesh.moves()) room.extend(mesh.bounds);
  const Bounds bodies = room;
  for (const Box& box : world.boxes)
    if (box.moves()) room.extend(bounds_to_frame(box, bodies, duration));
  for (const MeshObstacle& mesh : world.meshes)
    if (mesh.moves()) room.extend(bounds_to_frame(mesh, bodies, duration));
  for (const Sphere& sphere : world.spheres)
    room.extend(bounds_to_frame(sphere, bodies, world.gravity, duration));
  if (world.floor) room.min().z() = std::max(room.min().z(), std::min(world.floor->z, start.min().z()));
  return room;
}

Viewpoint::Viewpoint(const CameraSettings& camera, const Scene& scene, double aspect, double duration)
    : aspect_(aspect), turn_(camera.turn), duration_(duration) {
  check_framing(camera);
  Bounds start;
  for (const auto& body : scene.bodies()) start.extend(bounds_of(*body));
  start_.up = camera.up;
  start_.fov = camera.lens ? fov_of_lens(camera.source, *camera.lens, aspect) : camera.fov;
  start_.target = camera.target.value_or(start.center());
  Vec3 direction = best_direction(start);
  if (camera.eye) {
    start_.eye = *camera.eye;
    direction = start_.eye - start_.target;
    if (at_target(start_.eye, start_.target))
      camera.source.fail("eye", "the camera's eye stands at its target", "move it away from there");
  }
  read_keys(camera);
  const bool stands_at_eye = camera.eye && camera.fit.empty();
  const Framing frame = camera.frame.value_or(stands_at_eye ? Framing::Given : Framing::Auto);
  follows_ = frame == Framing::Follow;
  direction_ = direction;
  start_middle_ = start.center();
  reach_ = 3 * start.sizes().norm();
  if (frame == Framing::Given) return;
  const bool known = camera.room && !camera.room->isEmpty();
  const Bounds room = known ? Bounds(in_reach(camera.room->min()), in_reach(camera.room->max()))
                            : bounds_to_frame(scene, duration);
  const FrameCamera fitted = fit_camera(room, start_.fov, aspect, direction);
  start_.eye = fitted.eye;
  start_.target = fitted.target;
}

void Viewpoint::read_keys(const CameraSettings& camera) {
  for (const CameraKey& given : camera.keys) {
    Key key;
    key.time = given.at;
    const double fov =
        given.lens ? fov_of_lens(given.source, *given.lens, aspect_) : given.fov.value_or(start_.fov);
    key.camera << given.eye, given.target.value_or(start_.target), fov;
    if (at_target(key.camera.head<3>(), key.camera.segment<3>(3)))
      given.source.fail("eye", "the camera's eye stands at its target", "move it away from there");
    if (!keys_.empty()) check_key_times(keys_.back().time, key.time, given.source);
    keys_.push_back(key);
  }
}

// Cubic Hermite interpolation; the slope at a key is that between its neighbours. Constant before the first and
// after the last key.
FrameCamera Viewpoint::between_keys(double time) const {
  FrameCamera camera = start_;
  const auto set = [&](const Eigen::Matrix<double, 7, 1>& at) {
    camera.eye = at.head<3>();
    camera.target = at.segment<3>(3);
    camera.fov = std::clamp(at[6], least_fov, most_fov);
  };
  if (time <= keys_.front().time) return set(keys_.front().camera), camera;
  if (time >= keys_.back().time) return set(keys_.back().camera), camera;
  std::size_t n = 0;
  while (keys_[n + 1].time <= time) ++n;
  const auto slope = [&](std::size_t k) -> Eigen::Matrix<double, 7, 1> {
    if (k == 0 || k + 1 == keys_.size()) return Eigen::Matrix<double, 7, 1>::Zero();
    return (keys_[k + 1].camera - keys_[k - 1].camera) / (keys_[k + 1].time - keys_[k - 1].time);
  };
  const double span = keys_[n + 1].time - keys_[n].time, t = (time - keys_[n].time) / span;
  const double a = t * t * (3 - 2 * t), b = t * (1 - t) * (1 - t), c = t * t * (t - 1);
  set((1 - a) * keys_[n].camera + a * keys_[n + 1].camera + span * (b * slope(n) + c * slope(n + 1)));
  return camera;
}

void Viewpoint::observe(const Scene& scene) {
  if (!follows_) return;
  constexpr double lag = 0.3; // [s]
  Bounds box;
  for (const auto& body : scene.bodies()) box.extend(bounds_of(*body));
  box =
      box.intersection(Bounds(start_middle_ - Vec3::Constant(reach_), start_middle_ + Vec3::Constant(reach_)));
  if (box.isEmpty()) return; // no body is within reach
  const double passed = last_ < 0 ? 0 : scene.time() - last_, share = passed / (passed + lag);
  last_ = scene.time();
  const double distance = (start_.eye - start_.target).norm();
  const FrameCamera wanted = fit_camera(box, start_.fov, aspect_, direction_);
  start_.target += share * (wanted.target - start_.target);
  Bounds around = box; // with its mirror image, so that the target is its centre
  around.extend(2 * start_.target - box.min()).extend(2 * start_.target - box.max());
  const FrameCamera needed = fit_camera(around, start_.fov, aspect_, direction_);
  const double near = (needed.eye - needed.target).norm(), far = (wanted.eye - wanted.target).norm();
  start_.eye = start_.target + direction_.normalized() * std::max(distance + share * (far - distance), near);
}

void Viewpoint::store(Archive& archive, double now) {
  const FrameCamera given = start_;
  archive(start_.eye, start_.target, last_);
  if (!archive.reading()) return;
  refuse_unless(last_ == -1 || (last_ >= 0 && last_ <= now), "the camera looked at a later state");
  if (follows_)
    refuse_unless(std::isfinite((start_.eye - start_.target).squaredNorm()) && start_.eye != start_.target,
                  "the camera is at its target, or without end away from it");
  else
    refuse_unless(start_.eye == given.eye && start_.target == given.target, "the camera stands elsewhere");
}

FrameCamera Viewpoint::at(double time) const {
  FrameCamera camera = keys_.empty() ? start_ : between_keys(time);
  if (turn_ == 0 || duration_ <= 0) return camera;
  const double angle = turn_ * time / duration_;
  const double c = cosine_of_degrees(angle), s = sine_of_degrees(angle);
  const Vec3 axis = camera.up.normalized(), arm = camera.eye - camera.target;
  camera.eye = camera.target + c * arm + s * axis.cross(arm) + (1 - c) * axis.dot(arm) * axis;
  return camera;
}

} // namespace rend
