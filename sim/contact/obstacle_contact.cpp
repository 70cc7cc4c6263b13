#include "sim/contact/obstacle_contact.h"

#include <algorithm>
#include <cmath>

namespace rend {
namespace {

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

// Calls f(point, plane) for each vertex of the body that the obstacle stops. `codes`: the outcode of each slot
// at the end of the step.
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
    if (const auto plane = shape.stop(body.from(v), to, margin)) f(ContactPoint::at(body, v), *plane);
  }
}

// The same for the deepest point of each face, using those outcodes.
template <class Shape, class F>
void for_each_face(const Shape& shape, const ContactBody& body, const std::vector<Outside>& codes, F&& f) {
  const double margin = body.settings().thickness;
  for (const ContactFaces::Triangle& triangle : body.faces->triangles()) {
    const auto [a, b, c] = triangle.vertex;
    if ((codes[a] & codes[b] & codes[c]) != 0) continue;
    const TriangleCorners x{body.position(a), body.position(b), body.position(c)};
    const ContactPoint point{&body, triangle.vertex, shape.deepest(x)};
    if (*std::max_element(point.weight.begin(), point.weight.end()) == 1) continue; // a vertex
    const auto plane = shape.stop(point.from(), point.position(), margin);
    if (plane) f(point, *plane);
  }
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

void ObstacleContact::detect(const std::vector<std::unique_ptr<ContactBody>>& bodies, ContactAnswer& answer) {
  for (const auto& body : bodies) {
    detect_floor(*body, answer);
    if (!body->settings().obstacles) continue;
    for (std::size_t s = 0; s < world_.spheres.size(); ++s) {
      if (body->body->contact_table.excludes_obstacle(world_.number_of_sphere(s))) continue;
      Sphere& sphere = world_.spheres[s];
      const MovingSphere shape{&sphere, step_of(sphere)};
      const auto side = [&](const Vec3& at) {
        return sphere.falls() ? ContactSide::of(sphere) : ContactSide::of_obstacle(shape.velocity_at(at));
      };
      detect_shape(shape, *body, world_.number_of_sphere(s), side, answer);
    }
    for (std::size_t b = 0; b < world_.boxes.size(); ++b) {
      if (body->body->contact_table.excludes_obstacle(world_.number_of_box(b))) continue;
      const Box& box = world_.boxes[b];
      const auto add = [&](const auto& shape) {
        const auto side = [&](const Vec3& at) { return ContactSide::of_obstacle(shape.velocity_at(at)); };
        detect_shape(shape, *body, world_.number_of_box(b), side, answer);
      };
      if (const RigidStep* way = step_of(box))
        add(MovingBox{&box, way});
      else
        add(StandingBox{&box});
    }
  }
  for (Sphere& sphere : world_.spheres)
    if (sphere.falls()) detect_around(sphere, answer);
}

void ObstacleContact::detect_floor(const ContactBody& body, ContactAnswer& answer) const {
  if (!body.body->floor_contact) return;
  const double height = body.body->floor_contact->height;
  const ContactTerms& terms = body.body->contact_table.obstacles[0];
  for (Slot v = 0; v < body.vertices(); ++v)
    if (body.position(v).z < height && body.inverse_mass(v).z() != 0)
      answer.add({.a = ContactSide::of(ContactPoint::at(body, v), false),
                  .b = ContactSide::of_obstacle(Vec3::Zero()),
                  .normal = Vec3::UnitZ(),
                  .apart = height,
                  .kept = body.settings().thickness,
                  .friction = terms.friction,
                  .restitution = terms.restitution,
                  .obstacle = 0});
}

// `number`: of the obstacle; `side(x)`: its side, at a place x.
template <class Shape, class Side>
void ObstacleContact::detect_shape(const Shape& shape, const ContactBody& body, std::size_t number,
                                   const Side& side, ContactAnswer& answer) {
  const ContactTerms& terms = body.body->contact_table.obstacles[number];
  const auto add = [&](const ContactPoint& point, const Plane& plane) {
    const ContactSide other = side(point.position());
    answer.add({.a = ContactSide::of(point, point.held(plane.normal)),
                .b = other,
                .normal = plane.normal,
                .apart = plane.offset - plane.normal.dot(other.position()),
                .kept = body.settings().thickness,
                .friction = terms.friction,
                .restitution = terms.restitution,
                .obstacle = number});
  };
  for_each_vertex(shape, body, codes_, add);
  for_each_face(shape, body, codes_, add);
}

// Contacts of a falling sphere with the floor, boxes and spheres.
void ObstacleContact::detect_around(Sphere& sphere, ContactAnswer& answer) {
  const double own = sphere.friction.value_or(own_friction), bounce = sphere.restitution.value_or(0);
  const auto add = [&](const Plane& plane, double friction, double restitution, const Vec3& surface) {
    answer.add({.a = ContactSide::of(sphere),
                .b = ContactSide::of_obstacle(surface),
                .normal = plane.normal,
                .apart = plane.offset,
                .friction = friction,
                .restitution = restitution});
  };
  if (world_.floor && sphere.next_centre.z() < world_.floor->z + sphere.radius) {
    const double height = world_.floor->z + sphere.radius;
    const Floor& floor = *world_.floor;
    add({Vec3::UnitZ(), height}, floor.friction.value_or(own), floor.restitution.value_or(bounce),
        Vec3::Zero());
  }
  for (const Box& box : world_.boxes) {
    const RigidStep* way = step_of(box);
    const Vec3 from = way ? way->from.back(sphere.centre) : sphere.centre,
               to = way ? way->to.back(sphere.next_centre) : sphere.next_centre;
    auto plane = plane_against_standing(box, sphere.radius, from, to);
    if (!plane) continue;
    if (way) plane = moved(way->to, *plane);
    const Vec3 touched = sphere.next_centre - sphere.radius * plane->normal;
    add(*plane, box.friction.value_or(own), box.restitution.value_or(bounce),
        way ? way->velocity(touched) : Vec3(Vec3::Zero()));
  }
  for (Sphere& other : world_.spheres)
    if (!other.falls() || &sphere < &other) detect_pair(sphere, other, answer);
}

void ObstacleContact::detect_pair(Sphere& a, Sphere& b, ContactAnswer& answer) {
  const Vec3 apart = a.next_centre - b.next_centre;
  const double distance = apart.norm(), least = a.radius + b.radius;
  if (&a == &b || distance == 0 || distance >= least) return;
  const Vec3 normal = apart / distance, touched = b.next_centre + b.radius * normal;
  const ContactSide other = b.falls()
                                ? ContactSide::of(b)
                                : ContactSide::of_obstacle(MovingSphere{&b, step_of(b)}.velocity_at(touched));
  answer.add({.a = ContactSide::of(a),
              .b = other,
              .normal = normal,
              .apart = least + normal.dot(b.next_centre - other.position()),
              .friction = a.friction.value_or(b.friction.value_or(own_friction)),
              .restitution = a.restitution.value_or(b.restitution.value_or(0))});
}

} // namespace rend
