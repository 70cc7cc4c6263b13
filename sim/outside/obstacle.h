// Obstacles: spheres and boxes, and continuous collision detection of moving points against them.
//
// A point that ends a step inside an obstacle is kept on one side of a plane. Which plane depends on where it
// came from, so that nothing is pushed out on the far side:
//
//   sphere   the tangent plane above the point; if its normal differs much from that where the path enters
//            the sphere, or the path crosses the sphere entirely, deeper than 0.02 of the radius, the latter
//   box      the side through which the path enters; for a point that was inside, the nearest side, also where
//            it was hardly inside and went through the box
//
// The path is a straight line, relative to the obstacle. So objects that are thinner than the motion of a step
// are not missed. A sphere or box moves as prescribed (obstacle_motion.h). A sphere with mass falls instead: it
// does not rotate, so that friction acts on it as on a sliding block.
#pragma once

#include "sim/outside/contact_work.h"
#include "sim/outside/obstacle_motion.h"

#include <array>
#include <optional>
#include <vector>

namespace rend {

class Archive;

// The half-space n·x ≥ offset.
struct Plane {
  Vec3 normal = Vec3::UnitZ(); // unit
  double offset = 0;           // [m]
};

// A plane of an obstacle as the preset puts it, where the obstacle is.
Plane moved(const Pose& pose, const Plane& plane);

// Of all that touches an obstacle: Coulomb's coefficient, and Newton's of restitution.
AttributeType friction_attribute();
AttributeType restitution_attribute();
AttributeType obstacle_name_attribute();

struct SphereSettings {
  Vec3 centre = Vec3::Zero();                       // [m], at time 0
  double radius = 0;                                // [m]
  Vec3 velocity = Vec3::Zero();                     // [m/s]; of one that falls: at time 0
  std::optional<double> mass = {};                  // [kg]; none: it moves as prescribed
  std::optional<std::array<double, 4>> rotate = {}; // the axis x y z, and the rate [degrees/s]
  std::vector<ObstacleKey> keys = {};               // of a prescribed motion
  std::optional<double> friction = {};              // none: that of the body
  std::optional<double> restitution = {};           // likewise
  std::string name = {};                            // empty: none
  SettingsSource source = {};
};
template <> const Fields<SphereSettings>& fields_of();

struct Sphere {
  Vec3 start = Vec3::Zero();                   // [m], its centre at time 0
  double radius = 0, mass = 0;                 // [m], [kg]; mass 0: moves as prescribed
  std::optional<double> friction, restitution; // coefficients; none: those of the body
  ObstacleMotion motion;                       // by keys, and its rotation
  std::string name;                            // empty: none
  SettingsSource source;

  Vec3 centre = start, velocity = Vec3::Zero();           // [m], [m/s], of the current state
  Vec3 next_centre = start, next_velocity = Vec3::Zero(); // at the end of the current step

  Sphere() = default;
  explicit Sphere(const SphereSettings& settings); // UserError

  ContactWork contact_work; // of its contacts with obstacles since the start, if it falls
  double gravity_work = 0;  // [J], of its potential, by gravity that grew since the start, if it falls

  bool falls() const { return mass > 0; }
  bool follows_keys() const { return !motion.keys.empty(); }
  bool moves() const { return falls() || !velocity.isZero(0) || follows_keys(); } // not: only turns
  double inverse_mass() const { return mass > 0 ? 1 / mass : 0; }                 // [1/kg]

  // Its motion without contact, by symplectic Euler; `time` [s] at the end of the step.
  void predict(double time, double step, const Vec3& gravity);
  void commit(const Vec3& gravity, const Vec3& later); // gravity at the start of the step and at its end
  void store(Archive& archive);                        // the members that change
  bool can_be_there(double time) const;                // false: it follows keys, and is elsewhere at that time

  // For a point that moved from → to [m] in the step, relative to the sphere's centre at its start and end;
  // `reach` [m] is the radius plus the distance to keep. nullopt: no contact.
  static std::optional<Plane> stop(const Vec3& from, const Vec3& to, double reach);
};

struct Box {
  Vec3 low = Vec3::Zero(), high = Vec3::Zero();          // [m]
  std::optional<double> friction = {}, restitution = {}; // coefficients; none: those of the body
  ObstacleMotion motion = {};
  std::string name = {}; // empty: none
  SettingsSource source = {};

  Vec3 middle() const { return 0.5 * (low + high); }
  bool moves() const { return motion.moves(); }
  Pose pose(double time) const { return motion.at(middle(), time); }

  // Of the box as it is in the preset, as are all functions here; a point of one that moves is taken back to
  // there by its pose.
  // As for a sphere, but in world coordinates; `margin` [m] is the distance to keep.
  std::optional<Plane> stop(const Vec3& from, const Vec3& to, double margin) const;
};

template <> const Fields<Box>& fields_of();
void check_box(const Box& box); // UserError: it has no inside, or what moves it does not fit together

// Weights of the point of a triangle that lies deepest; they sum up to 1.
using Weights = std::array<double, 3>;
using TriangleCorners = std::array<Vec3, 3>;

// The point nearest to `point`: Ericson, Real-Time Collision Detection, 5.1.5.
Weights nearest_in_triangle(const TriangleCorners& x, const Vec3& point);

// The deepest point of a triangle in the box: where the largest signed distance to the sides of the box is
// minimal. A convex function, minimised by nested golden section searches to 1/300 of the triangle. (Frank and
// Wolfe's method, Macklin et al. 2020, takes as many evaluations and stalls if two sides are equally far.)
Weights deepest_in_box(const TriangleCorners& x, const Box& box);

} // namespace rend
