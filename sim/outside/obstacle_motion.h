// How an obstacle moves: a rigid motion that is a function of time alone, so that nothing of it is stored.
//
//   x(X, t) = c + d(t) + R(t) (X − c)      X: a point where the preset puts it; c: a point of the axis
//
//   velocity V   d = V t
//   rotate       R turns about an axis, at a constant rate
//   keys         d and the angles of R = Rz Ry Rx go through those of the keys
//
// Between keys each coordinate, and each angle, is a cubic whose slope at a key is the harmonic mean of those
// of the chords at both sides, 0 where they have different signs, and 0 at the first and last key (Fritsch and
// Butland, SIAM J. Sci. Stat. Comput. 5, 1984): the velocity has no jumps, nothing overshoots, and what has the
// same place at two keys in a row stands still between them. Splines through three keys and more (Catmull and
// Rom) do overshoot.
//
// At a point of contact the velocity of the obstacle's surface is that of its material point, on average over
// the step (RigidStep). With the velocity at an instant, what rests on an obstacle would creep along it.
#pragma once

#include "sim/base/settings.h"

#include <array>
#include <optional>
#include <vector>

namespace rend {

// Where an obstacle is at a time. Coordinates that no key gives are those of the keys before and after.
struct ObstacleKey {
  double at = 0;                     // [s]
  std::optional<Vec3> position = {}; // [m], of its middle, if it did not turn
  std::optional<Vec3> rotate = {};   // [degrees] about x, then y, then z
  SettingsSource source = {};
};
template <> const Fields<ObstacleKey>& fields_of();

// Maps points of an obstacle to where they are: x = place + turn (X − origin). By default nothing moves.
struct Pose {
  Vec3 origin = Vec3::Zero(), place = Vec3::Zero(); // [m]
  Eigen::Matrix3d turn = Eigen::Matrix3d::Identity();

  Vec3 of(const Vec3& X) const { return place + turn * (X - origin); }
  Vec3 back(const Vec3& x) const { return origin + turn.transpose() * (x - place); }
};

struct ObstacleMotion {
  Vec3 velocity = Vec3::Zero();                     // [m/s]
  std::optional<std::array<double, 4>> rotate = {}; // the axis x y z, and the rate [degrees/s]
  std::optional<Vec3> centre = {};                  // [m], a point of the axis; none: the obstacle's middle
  std::vector<ObstacleKey> keys = {}; // in order of time; before the first it comes from its place

  bool moves() const { return !velocity.isZero(0) || rotate || !keys.empty(); }
  bool turns() const;
  // `middle` [m]: of the obstacle, where the preset puts it.
  Pose at(const Vec3& middle, double time) const;
};
template <> const Fields<ObstacleMotion>& fields_of(); // without keys

// UserError, with its place in `source`: what does not fit together.
void check_motion(const ObstacleMotion& motion, const SettingsSource& source);

AttributeType rotate_attribute();

// The motion of an obstacle in a step.
struct RigidStep {
  Pose from, to;   // at its start and end
  double step = 1; // [s]

  // [m/s], of the material point that is at x [m] at the end.
  Vec3 velocity(const Vec3& x) const { return (x - from.of(to.back(x))) / step; }
};

} // namespace rend
