#include "sim/contact/obstacle_contact.h"

#include "sim/contact/sphere_on_mesh.h"
#include "sim/outside/box_face.h"

#include <algorithm>
#include <cmath>

namespace rend {
namespace {

constexpr double touching = 1e-9;       // [m]
constexpr double least_overlap = 1e-10; // relative to an obstacle's size: what is less deep only touches
constexpr double kept_share = 0.5;      // of that at the start of the step
constexpr double own_friction = 0.5;    // between obstacles without a friction of their own

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

TriangleCorners back(const Pose& pose, const TriangleCorners& x) {
  return {pose.back(x[0]), pose.back(x[1]), pose.back(x[2])};
}

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
  Weights deepest(const TriangleCorners& x) const { return deepest_in_box(back(way->to, x), *box); }
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

// The same for the deepest point of each face, using those outcodes. Whether any face is near.
template <class Shape, class F>
bool for_each_face(const Shape& shape, const ContactBody& body, const std::vector<Outside>& codes, F&& f) {
  const double margin = body.settings().thickness;
  bool any = false;
  for (const ContactFaces::Triangle& triangle : body.faces->triangles()) {
    const auto [a, b, c] = triangle.vertex;
    if ((codes[a] & codes[b] & codes[c]) != 0) continue;
    any = true;
    const TriangleCorners x{body.position(a), body.position(b), body.position(c)};
    const ContactPoint point{&body, triangle.vertex, shape.deepest(x)};
    if (*std::max_element(point.weight.begin(), point.weight.end()) == 1) continue; // a vertex
    const auto plane = shape.stop(point.from(), point.position(), margin);
    if (plane) f(point, *plane);
  }
  return any;
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
  if (std::any_of(world.spheres.begin(), world.spheres.end(), [](const Sphere& one) { return one.falls(); }))
    for (const MeshObstacle& mesh : world.meshes) meshes_.emplace_back(mesh);
  mesh_steps_.resize(meshes_.size());
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
  for (std::size_t m = 0; m < meshes_.size(); ++m)
    if (const MeshObstacle& mesh = world_.meshes[m]; mesh.moves())
      mesh_steps_[m] = {mesh.pose(time), mesh.pose(time + step), step};
}

const RigidStep* ObstacleContact::step_of(const Sphere& sphere) const {
  return sphere.motion.turns() ? &sphere_steps_[static_cast<std::size_t>(&sphere - world_.spheres.data())]
                               : nullptr;
}

const RigidStep* ObstacleContact::step_of(const Box& box) const {
  return box.moves() ? &box_steps_[static_cast<std::size_t>(&box - world_.boxes.data())] : nullptr;
}

// Calls f(shape, number of the obstacle) with those that the body can touch.
template <class F> void ObstacleContact::each_shape(const ContactBody& body, const F& f) const {
  if (!body.settings().obstacles) return;
  const ContactTable& table = body.body->contact_table;
  for (const Sphere& sphere : world_.spheres) {
    const std::size_t number =
        world_.number_of_sphere(static_cast<std::size_t>(&sphere - world_.spheres.data()));
    if (!table.excludes_obstacle(number)) f(MovingSphere{&sphere, step_of(sphere)}, number);
  }
  for (const Box& box : world_.boxes) {
    const std::size_t number = world_.number_of_box(static_cast<std::size_t>(&box - world_.boxes.data()));
    if (table.excludes_obstacle(number)) continue;
    if (const RigidStep* way = step_of(box))
      f(MovingBox{&box, way}, number);
    else
      f(StandingBox{&box}, number);
  }
}

ContactSide ObstacleContact::side_of(std::size_t number, const Vec3& surface) const {
  if (number >= world_.number_of_box(0)) return ContactSide::of_obstacle(surface);
  Sphere& sphere = world_.spheres[number - world_.number_of_sphere(0)];
  return sphere.falls() ? ContactSide::of(sphere) : ContactSide::of_obstacle(surface);
}

RigidStep ObstacleContact::way_of(const Box& box) const {
  const RigidStep* way = step_of(box);
  return way ? *way : RigidStep{};
}

void ObstacleContact::detect(const ContactBodies& bodies, ContactAnswer& answer) {
  near_ = false;
  for (const auto& body : bodies) {
    if (!body->body) continue; // an obstacle
    detect_floor(*body, answer);
    each_shape(*body,
               [&](const auto& shape, std::size_t number) { detect_shape(shape, *body, number, answer); });
  }
  for (Sphere& sphere : world_.spheres)
    if (sphere.falls()) detect_around(sphere, answer);
}

// Of a point of a body that is kept on one side of a plane.
ContactConstraint ObstacleContact::constraint(const ContactPoint& point, const Plane& plane, std::size_t number,
                                              const Vec3& surface, double kept, double restitution) const {
  const ContactBody& body = *point.body;
  const ContactTerms& terms = body.body->contact_table.obstacles[number];
  const ContactSide other = side_of(number, surface);
  return {.a = ContactSide::of(point, point.held(plane.normal)),
          .b = other,
          .normal = plane.normal,
          .apart = plane.offset - plane.normal.dot(other.position()),
          .kept = kept,
          .friction = terms.friction,
          .restitution = restitution,
          .obstacle = number};
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

template <class Shape>
void ObstacleContact::detect_shape(const Shape& shape, const ContactBody& body, std::size_t number,
                                   ContactAnswer& answer) {
  const auto add = [&](const ContactPoint& point, const Plane& plane) {
    answer.add(constraint(point, plane, number, shape.velocity_at(point.position()), body.settings().thickness,
                          body.body->contact_table.obstacles[number].restitution));
  };
  for_each_vertex(shape, body, codes_, add);
  near_ = for_each_face(shape, body, codes_, add) || near_;
}

void ObstacleContact::find_crossing(const ContactBodies& bodies, std::vector<BoxCrossing>& found) {
  for (std::uint32_t b = 0; b < bodies.size(); ++b) {
    if (!bodies[b]->settings().obstacles) continue;
    for (std::uint32_t n = 0; n < world_.boxes.size(); ++n)
      if (!bodies[b]->body->contact_table.excludes_obstacle(world_.number_of_box(n)))
        find_crossing(*bodies[b], {b, 0, n}, found);
  }
}

// `one`: of a body and a box; with its faces.
void ObstacleContact::find_crossing(const ContactBody& body, BoxCrossing one, std::vector<BoxCrossing>& found) {
  const Box& box = world_.boxes[one.box];
  const RigidStep way = way_of(box);
  const Bounds near = MovingBox{&box, &way}.bounds(0);
  codes_.resize(body.vertices());
  for (Slot v = 0; v < body.vertices(); ++v) codes_[v] = outside(near, body.position(v));
  const double least = -least_overlap * (box.high - box.low).norm();
  const auto& triangles = body.faces->triangles();
  for (one.triangle = 0; one.triangle < triangles.size(); ++one.triangle) {
    const auto [p, q, r] = triangles[one.triangle].vertex;
    if ((codes_[p] & codes_[q] & codes_[r]) != 0) continue;
    const TriangleCorners from{body.from(p), body.from(q), body.from(r)},
        to{body.position(p), body.position(q), body.position(r)};
    const double distance = separation(box, back(way.to, to)).distance;
    if (distance >= least || separation(box, back(way.from, from)).distance < least) continue;
    one.surely = distance < 2 * least;
    found.push_back(one);
  }
}

void ObstacleContact::keep_out(const ContactBodies& bodies, const BoxCrossing& crossing,
                               std::vector<ContactConstraint>& wanted) const {
  const ContactBody& body = *bodies[crossing.body];
  const auto& corner = body.faces->triangles()[crossing.triangle].vertex;
  const Box& box = world_.boxes[crossing.box];
  const RigidStep way = way_of(box);
  const TriangleCorners from{body.from(corner[0]), body.from(corner[1]), body.from(corner[2])};
  const BoxSeparation start = separation(box, back(way.from, from));
  const double kept = kept_share * std::max(0.0, start.distance);
  Plane plane = moved(way.to, start.plane);
  plane.offset += kept;
  for (const Slot v : corner) {
    const Vec3 surface = way.velocity(body.position(v));
    wanted.push_back(
        constraint(ContactPoint::at(body, v), plane, world_.number_of_box(crossing.box), surface, kept, 0));
  }
}

Vec3 ObstacleContact::carried(std::size_t box, const Vec3& from) const {
  const RigidStep way = way_of(world_.boxes[box]);
  return way.to.of(way.from.back(from));
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
  detect_on_meshes(sphere, [&](const Plane& plane, const MeshObstacle& mesh, const Vec3& surface) {
    add(plane, mesh.friction.value_or(own), mesh.restitution.value_or(bounce), surface);
  });
  for (Sphere& other : world_.spheres)
    if (!other.falls() || &sphere < &other) detect_pair(sphere, other, answer);
}

std::size_t ObstacleContact::bytes() const {
  std::size_t sum = bytes_of(codes_) + bytes_of(sphere_steps_) + bytes_of(box_steps_) + bytes_of(meshes_) +
                    bytes_of(mesh_steps_);
  for (const StandingMesh& mesh : meshes_) sum += mesh.tree.bytes();
  return sum;
}

// Calls add(plane, mesh, velocity of its surface there).
template <class Add> void ObstacleContact::detect_on_meshes(const Sphere& sphere, const Add& add) const {
  for (std::size_t m = 0; m < meshes_.size(); ++m) {
    const RigidStep& way = mesh_steps_[m];
    for (const Plane& still : planes_against(meshes_[m].tree, sphere.radius, way.from.back(sphere.centre),
                                             way.to.back(sphere.next_centre))) {
      const Plane plane = moved(way.to, still);
      add(plane, *meshes_[m].obstacle, way.velocity(sphere.next_centre - sphere.radius * plane.normal));
    }
  }
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
