#include "sim/contact/obstacle_contact.h"

#include <algorithm>
#include <cmath>

namespace rend {
namespace {

constexpr int obstacle_sweeps = 8;
constexpr int passes = 2;            // over faces: moving one out may move its neighbour in
constexpr double touching = 1e-9;    // [m]
constexpr double own_friction = 0.5; // between obstacles without a friction of their own

using Bounds = Eigen::AlignedBox3d;

// A sphere in a step, with the interface that the templates below use.
struct MovingSphere {
  const Sphere* sphere;
  const RigidStep* turning; // null: it does not turn
  Vec3 velocity_at(const Vec3& x) const { return turning ? turning->velocity(x) : sphere->next_velocity; }
  Bounds bounds(double margin) const {
    const Vec3 reach = Vec3::Constant(sphere->radius + margin);
    Bounds box(sphere->next_centre - reach, sphere->next_centre + reach);
    return box.extend(sphere->centre - reach).extend(sphere->centre + reach);
  }
  double depth(const Vec3& from, double margin) const {
    return sphere->radius + margin - (from - sphere->centre).norm();
  }
  std::optional<Plane> stop(const Vec3& from, const Vec3& to, double margin) const {
    const Vec3 a = from - sphere->centre, b = to - sphere->next_centre;
    auto plane = Sphere::stop(a, b, sphere->radius + margin);
    if (plane) plane->offset += plane->normal.dot(sphere->next_centre);
    return plane;
  }
  Weights deepest(const TriangleCorners& x) const { return nearest_in_triangle(x, sphere->next_centre); }
};

struct StandingBox {
  const Box* box;
  Vec3 velocity_at(const Vec3&) const { return Vec3::Zero(); }
  Bounds bounds(double margin) const {
    return {box->low - Vec3::Constant(margin), box->high + Vec3::Constant(margin)};
  }
  double depth(const Vec3& from, double margin) const {
    return margin + std::min((from - box->low).minCoeff(), (box->high - from).minCoeff());
  }
  std::optional<Plane> stop(const Vec3& from, const Vec3& to, double margin) const {
    return box->stop(from, to, margin);
  }
  Weights deepest(const TriangleCorners& x) const { return deepest_in_box(x, *box); }
};

struct MovingBox {
  const Box* box;
  const RigidStep* way;
  Vec3 velocity_at(const Vec3& x) const { return way->velocity(x); }
  Bounds bounds(double margin) const {
    const Bounds still = StandingBox{box}.bounds(margin);
    Bounds around;
    for (int n = 0; n < 8; ++n) {
      const Vec3 corner = still.corner(static_cast<Bounds::CornerType>(n));
      around.extend(way->from.of(corner)).extend(way->to.of(corner));
    }
    return around;
  }
  double depth(const Vec3& from, double margin) const {
    return StandingBox{box}.depth(way->from.back(from), margin);
  }
  std::optional<Plane> stop(const Vec3& from, const Vec3& to, double margin) const {
    const auto plane = box->stop(way->from.back(from), way->to.back(to), margin);
    return plane ? std::optional(moved(way->to, *plane)) : std::nullopt;
  }
  Weights deepest(const TriangleCorners& x) const {
    return deepest_in_box({way->to.back(x[0]), way->to.back(x[1]), way->to.back(x[2])}, *box);
  }
};

// The sides of a box outside which a point is: bits 2 a and 2 a + 1 for below and above along axis a (outcodes
// of Cohen and Sutherland).
using Outside = std::uint8_t;
Outside outside(const Bounds& near, const Vec3& x) {
  unsigned code = 0;
  for (int axis = 0; axis < 3; ++axis)
    code |= static_cast<unsigned>(x[axis] <= near.min()[axis]) << (2 * axis) |
            static_cast<unsigned>(x[axis] >= near.max()[axis]) << (2 * axis + 1);
  return static_cast<Outside>(code);
}

// Calls f(point, plane) for each vertex of the body that the obstacle stops. `codes`: the resulting outcode of
// each slot.
template <class Shape, class F>
void for_each_vertex(const Shape& shape, const ContactBody& body, std::vector<Outside>& codes, F&& f) {
  const double margin = body.settings().thickness;
  const Bounds near = shape.bounds(margin - touching); // points outside one of its sides are skipped
  codes.resize(body.vertices());
  for (Slot v = 0; v < body.vertices(); ++v) {
    const Vec3 to = body.position(v);
    codes[v] = outside(near, to);
    if (codes[v] != 0 && (codes[v] & outside(near, body.from(v))) != 0) continue;
    if (!body.alive(v)) continue;
    const auto plane = shape.stop(body.from(v), to, margin);
    if (!plane) continue;
    f(ContactPoint::at(body, v), *plane, shape.depth(body.from(v), margin));
    codes[v] = outside(near, body.position(v));
  }
}

// The same for the deepest point of each face, using those outcodes.
template <class Shape, class F>
void for_each_face(const Shape& shape, const ContactBody& body, const std::vector<Outside>& codes, F&& f) {
  const double margin = body.settings().thickness;
  for (const ContactFaces::Triangle& triangle : body.faces.triangles()) {
    const auto [a, b, c] = triangle.vertex;
    if ((codes[a] & codes[b] & codes[c]) != 0) continue;
    const TriangleCorners x{body.position(a), body.position(b), body.position(c)};
    const ContactPoint point{&body, triangle.vertex, shape.deepest(x)};
    if (*std::max_element(point.weight.begin(), point.weight.end()) == 1) continue; // a vertex
    const auto plane = shape.stop(point.from(), point.position(), margin);
    if (plane) f(point, *plane, shape.depth(point.from(), margin));
  }
}

// On positions only, leaving the penetration `kept` [m].
void move_out(const ContactPoint& point, const Plane& plane, double kept) {
  const double gap = plane.normal.dot(point.position()) - plane.offset + kept;
  if (gap < 0) point.displace(-gap / inverse_mass_along(plane.normal, point.inverse_mass()) * plane.normal);
}

// Moves a point out of an obstacle with infinite mass.
void keep_out(const ContactPoint& point, const Plane& plane, const Vec3& obstacle, double friction, double kept,
              double step) {
  if (plane.normal.dot(point.position()) >= plane.offset || point.held(plane.normal)) return;
  const Impulse impulse = impact(point.velocity() - obstacle, plane.normal, friction, point.inverse_mass());
  point.apply_impulse(impulse.whole(), 0);
  point.displace(step * impulse.friction);
  move_out(point, plane, kept);
}

// Of an obstacle that falls, the momentum was traded with the bodies before.
enum class Momentum { Taken, TradedBefore };

template <class Shape>
void keep_body_out(const Shape& shape, const ContactBody& body, std::vector<Outside>& codes, double friction,
                   double step, Momentum momentum) {
  const auto act = [&](const ContactPoint& point, const Plane& plane, double before) {
    const double kept = way_out(before, step);
    if (momentum == Momentum::Taken)
      return keep_out(point, plane, shape.velocity_at(point.position()), friction, kept, step);
    if (!point.held(plane.normal)) move_out(point, plane, kept);
  };
  for_each_vertex(shape, body, codes, act);
  for (int pass = 0; pass < passes; ++pass) for_each_face(shape, body, codes, act);
}

// The point of the box that is nearest to x.
Vec3 nearest(const Box& box, const Vec3& x) {
  return x.cwiseMax(box.low).cwiseMin(box.high);
}

// The plane that keeps a centre, which moves from `start` to `to`, outside a box that stands still.
std::optional<Plane> plane_against_standing(const Box& box, double radius, const Vec3& start, const Vec3& to) {
  const Vec3 at = nearest(box, to), from = to - at;
  const double distance = from.norm();
  if (distance >= radius) return {};
  if (distance == 0) return box.stop(start, to, radius);
  return Plane{from / distance, from.dot(at) / distance + radius};
}

// Contact with an object of infinite mass, whose surface has that velocity [m/s].
void stop(Sphere& sphere, const Vec3& normal, double friction, const Vec3& surface = Vec3::Zero()) {
  sphere.next_velocity += impact(sphere.next_velocity - surface, normal, friction, Vec3::Ones()).whole();
}

} // namespace

ObstacleContact::ObstacleContact(World& world) : world_(world) {
  const auto turns = [](const Sphere& sphere) { return sphere.motion.turns(); };
  const auto moves = [](const Box& box) { return box.moves(); };
  if (std::any_of(world.spheres.begin(), world.spheres.end(), turns))
    sphere_steps_.resize(world.spheres.size());
  if (std::any_of(world.boxes.begin(), world.boxes.end(), moves)) box_steps_.resize(world.boxes.size());
}

void ObstacleContact::predict(double time, double step) {
  for (Sphere& sphere : world_.spheres) sphere.predict(time + step, step, world_.gravity_at(time));
  for (std::size_t s = 0; s < sphere_steps_.size(); ++s) {
    const Sphere& sphere = world_.spheres[s];
    sphere_steps_[s] = {sphere.motion.at(sphere.start, time), sphere.motion.at(sphere.start, time + step),
                        step};
  }
  for (std::size_t b = 0; b < box_steps_.size(); ++b)
    box_steps_[b] = {world_.boxes[b].pose(time), world_.boxes[b].pose(time + step), step};
}

const RigidStep* ObstacleContact::step_of(const Sphere& sphere) const {
  return sphere.motion.turns() ? &sphere_steps_[static_cast<std::size_t>(&sphere - world_.spheres.data())]
                               : nullptr;
}

const RigidStep* ObstacleContact::step_of(const Box& box) const {
  return box.moves() ? &box_steps_[static_cast<std::size_t>(&box - world_.boxes.data())] : nullptr;
}

Vec3 ObstacleContact::velocity_at(const Sphere& sphere, const Vec3& x) const {
  return MovingSphere{&sphere, step_of(sphere)}.velocity_at(x);
}

std::optional<Plane> ObstacleContact::plane_against(const Box& box, const Sphere& sphere) const {
  const RigidStep* way = step_of(box);
  if (!way) return plane_against_standing(box, sphere.radius, sphere.centre, sphere.next_centre);
  const auto plane = plane_against_standing(box, sphere.radius, way->from.back(sphere.centre),
                                            way->to.back(sphere.next_centre));
  return plane ? std::optional(moved(way->to, *plane)) : std::nullopt;
}

void ObstacleContact::advance(const std::vector<std::unique_ptr<ContactBody>>& bodies, double time,
                              double step) {
  predict(time, step);
  exchange_momentum(bodies, step);
  for (const auto& body : bodies) {
    if (!body->settings().obstacles) continue;
    const double own = body->settings().friction;
    for (const Sphere& sphere : world_.spheres)
      keep_body_out(MovingSphere{&sphere, step_of(sphere)}, *body, codes_, sphere.friction.value_or(own), step,
                    sphere.falls() ? Momentum::TradedBefore : Momentum::Taken);
    for (const Box& box : world_.boxes) {
      const double friction = box.friction.value_or(own);
      if (const RigidStep* way = step_of(box))
        keep_body_out(MovingBox{&box, way}, *body, codes_, friction, step, Momentum::Taken);
      else
        keep_body_out(StandingBox{&box}, *body, codes_, friction, step, Momentum::Taken);
    }
  }
}

void ObstacleContact::exchange_momentum(const std::vector<std::unique_ptr<ContactBody>>& bodies, double step) {
  touches_.clear();
  bool falls = false;
  for (std::size_t s = 0; s < world_.spheres.size(); ++s) {
    if (!world_.spheres[s].falls()) continue;
    falls = true;
    for (const auto& body : bodies)
      if (body->settings().obstacles) find_touches(s, *body);
  }
  if (!falls) return;
  for (int sweep = 0; sweep < obstacle_sweeps; ++sweep) {
    for (Touch& touch : touches_) meet(touch, step);
    for (Sphere& a : world_.spheres)
      for (Sphere& b : world_.spheres)
        if (&a < &b) collide(a, b);
    for (Sphere& sphere : world_.spheres)
      if (sphere.falls()) support(sphere);
  }
  for (Sphere& sphere : world_.spheres)
    if (sphere.falls()) settle(sphere, step);
}

void ObstacleContact::find_touches(std::size_t number, const ContactBody& body) {
  const Sphere& sphere = world_.spheres[number];
  const double friction = sphere.friction.value_or(body.settings().friction);
  const auto keep = [&](const ContactPoint& point, const Plane& plane, double) {
    touches_.push_back({number, point, plane.normal, friction, point.held(plane.normal)});
  };
  const MovingSphere falling{&sphere, nullptr};
  for_each_vertex(falling, body, codes_, keep);
  for_each_face(falling, body, codes_, keep);
}

void ObstacleContact::meet(Touch& touch, double step) {
  Sphere& sphere = world_.spheres[touch.sphere];
  const double W = sphere.inverse_mass();
  const Vec3 inverse_masses =
      Vec3::Constant(W) + (touch.held ? Vec3(Vec3::Zero()) : touch.point.inverse_mass());
  const Vec3 impulse =
      impact(touch.point.velocity() - sphere.next_velocity, touch.normal, touch.friction, inverse_masses)
          .whole();
  if (!touch.held) touch.point.apply_impulse(impulse, step);
  sphere.next_velocity -= W * impulse;
}

// Contacts of a falling sphere with the floor and boxes.
void ObstacleContact::support(Sphere& sphere) {
  const double own = sphere.friction.value_or(own_friction);
  if (world_.floor && sphere.next_centre.z() < world_.floor->z + sphere.radius)
    stop(sphere, Vec3::UnitZ(), world_.floor->friction.value_or(own));
  for (const Box& box : world_.boxes) {
    const auto plane = plane_against(box, sphere);
    if (!plane) continue;
    const RigidStep* way = step_of(box);
    const Vec3 touched = sphere.next_centre - sphere.radius * plane->normal;
    stop(sphere, plane->normal, box.friction.value_or(own), way ? way->velocity(touched) : Vec3(Vec3::Zero()));
  }
}

void ObstacleContact::collide(Sphere& a, Sphere& b) {
  const Vec3 apart = b.next_centre - a.next_centre;
  const double distance = apart.norm(), w = a.inverse_mass() + b.inverse_mass();
  if (w == 0 || distance == 0 || distance >= a.radius + b.radius) return;
  const double friction = a.friction.value_or(b.friction.value_or(own_friction));
  const Vec3 normal = apart / distance, touched = a.next_centre + a.radius * normal;
  const Vec3 relative = velocity_at(b, touched) - velocity_at(a, touched);
  const Vec3 impulse = impact(relative, normal, friction, Vec3::Constant(w)).whole();
  a.next_velocity -= a.inverse_mass() * impulse;
  b.next_velocity += b.inverse_mass() * impulse;
}

// Moves it with its velocity, but not into the floor or boxes.
void ObstacleContact::settle(Sphere& sphere, double step) {
  sphere.next_centre = sphere.centre + step * sphere.next_velocity;
  for (const Box& box : world_.boxes)
    if (const auto plane = plane_against(box, sphere))
      sphere.next_centre +=
          std::max(0.0, plane->offset - plane->normal.dot(sphere.next_centre)) * plane->normal;
  if (world_.floor) sphere.next_centre.z() = std::max(sphere.next_centre.z(), world_.floor->z + sphere.radius);
}

} // namespace rend
