// Obstacles: spheres and boxes that bodies do not pass through, and where a point that moves meets them.
//
// A point that ends a step within an obstacle is kept outside of a plane. Which one depends on where it came
// from, so that nothing is pushed out on the far side:
//
//   sphere   the tangent plane over the point; where that leans otherwise than the one where its way meets the
//            sphere, or the way passes through and out again, deeper than 0.02 of the radius, the latter
//   box      the side through which its way comes in; of a point that was inside, the nearest side
//
// The way is a straight line, relative to the obstacle. What is as long as a step's motion is therefore not
// missed, nor what is thinner. A sphere moves as prescribed (start + velocity × time), or, having mass, falls:
// it does not turn, so that friction acts on it as on a slider.
#pragma once

#include "sim/base/settings.h"

#include <array>
#include <optional>

namespace rend {

class Archive;

// The half-space n·x ≥ offset.
struct Plane {
  Vec3 normal = Vec3::UnitZ(); // unit
  double offset = 0;           // [m]
};

// Coulomb's coefficient, of all that slides on it.
AttributeType friction_attribute();

struct SphereSettings {
  Vec3 centre = Vec3::Zero();          // [m], at time 0
  double radius = 0;                   // [m]
  Vec3 velocity = Vec3::Zero();        // [m/s]; of one that falls: at time 0
  std::optional<double> mass = {};     // [kg]; none: it moves as prescribed
  std::optional<double> friction = {}; // none: that of the body
  SettingsSource source = {};
};
template <> const Fields<SphereSettings>& fields_of();

struct Sphere {
  Vec3 start = Vec3::Zero();      // [m], its centre at time 0
  double radius = 0, mass = 0;    // [m], [kg]; mass 0: moves as prescribed
  std::optional<double> friction; // Coulomb's coefficient; none: that of the body

  Vec3 centre = start, velocity = Vec3::Zero();           // [m], [m/s], of the current state
  Vec3 next_centre = start, next_velocity = Vec3::Zero(); // at the end of the step that is being made

  Sphere() = default;
  explicit Sphere(const SphereSettings& settings); // UserError

  bool falls() const { return mass > 0; }
  bool moves() const { return falls() || !velocity.isZero(0); }
  double inverse_mass() const { return mass > 0 ? 1 / mass : 0; } // [1/kg]

  // Where it goes if nothing stops it; `time` [s] at the end of the step.
  void predict(double time, double step, const Vec3& gravity);
  void commit();
  void store(Archive& archive); // what changes of it

  // For a point that went from → to [m] in the step, relative to the centre at its start and end; `reach` [m]
  // is the radius and what is kept from it. None: it is outside.
  static std::optional<Plane> stop(const Vec3& from, const Vec3& to, double reach);
};

struct Box {
  Vec3 low = Vec3::Zero(), high = Vec3::Zero(); // [m]
  std::optional<double> friction = {};
  SettingsSource source = {};

  // As for a sphere, but in world space; `margin` [m] is kept from it.
  std::optional<Plane> stop(const Vec3& from, const Vec3& to, double margin) const;
};

template <> const Fields<Box>& fields_of();
void check_box(const Box& box); // UserError: it has no inside

// Weights of the point of a triangle that lies deepest; they sum up to 1.
using Weights = std::array<double, 3>;
using TriangleCorners = std::array<Vec3, 3>;

// Nearest to `point`: Ericson, Real-Time Collision Detection, 5.1.5.
Weights nearest_in_triangle(const TriangleCorners& x, const Vec3& point);

// Where the largest of the distances to the sides of the box is least: a convex function, whose least is found
// by golden section within golden section, to 1/300 of the triangle. (Frank and Wolfe's method, Macklin et al.
// 2020, takes as many evaluations and stalls where two sides are equally far.)
Weights deepest_in_box(const TriangleCorners& x, const Box& box);

} // namespace rend
