// GCC 12 takes the numbers of an empty optional array for ones that are read.
#pragma GCC diagnostic ignored "-Wmaybe-uninitialized"

#include "sim/outside/obstacle_motion.h"

#include "sim/base/key_times.h"
#include "sim/base/math.h"
#include "sim/base/reach.h"

#include <algorithm>
#include <cmath>

namespace rend {

AttributeType rotate_attribute() {
  return within(numbers("rotate", 4, "degrees/s", "it turns: axis x y z, then the speed of rotation about it"),
                most_degrees);
}

template <> const Fields<ObstacleKey>& fields_of() {
  using S = ObstacleKey;
  static const Fields<S> fields{
      field(&S::at, number("at", "s", "when").at_least(0).is_required()),
      field(&S::position,
            position("position", "where its middle is then; default: as between the keys before and after")),
      field(&S::rotate, within(numbers("rotate", 3, "degrees",
                                       "how it is turned then: angles about x, then y, then z; may exceed 360"),
                               most_degrees))};
  return fields;
}

namespace {

// Written out, since GCC 12 takes the default of an optional array here for uninitialized.
Field<ObstacleMotion> rotate_field() {
  return {rotate_attribute(),
          [](ObstacleMotion& motion, const AttributeValue& value) {
            std::copy_n(value.numbers.begin(), 4, motion.rotate.emplace().begin());
          },
          [](const ObstacleMotion& motion, const SettingsSource& source) {
            if (motion.rotate) fields::check_numbers(rotate_attribute(), *motion.rotate, source);
          }};
}

} // namespace

template <> const Fields<ObstacleMotion>& fields_of() {
  using S = ObstacleMotion;
  static const Fields<S> fields{
      field(&S::velocity, velocity("velocity", "constant velocity")), rotate_field(),
      field(&S::centre, position("centre", "a point on the axis of rotation; default: its middle"))};
  return fields;
}

namespace {

// A value by its keys.
class Curve {
public:
  // Before the first key, from time 0 on, it goes there from `start`.
  Curve(const std::vector<ObstacleKey>& keys, std::optional<Vec3> ObstacleKey::*member, const Vec3& start)
      : keys_(keys), member_(member), start_(start) {}

  Vec3 at(double time) const {
    const Knot b = next_after(time), a = before(b);
    if (!b.there) return a.value;
    const Vec3 from = slope(before(a), a, b), to = slope(a, b, next_after(b.time));
    const double span = b.time - a.time, t = (time - a.time) / span;
    const double share = t * t * (3 - 2 * t);
    return a.value + share * (b.value - a.value) + span * (t * (1 - t) * (1 - t) * from + t * t * (t - 1) * to);
  }

private:
  struct Knot {
    bool there = false;
    double time = 0;
    Vec3 value = Vec3::Zero();
  };

  Knot next_after(double time) const {
    for (const ObstacleKey& key : keys_)
      if (key.at > time && key.*member_) return {true, key.at, *(key.*member_)};
    return {};
  }
  // The one before `knot`; the last of all where that is none.
  Knot before(const Knot& knot) const {
    Knot last;
    for (const ObstacleKey& key : keys_) {
      if (knot.there && key.at >= knot.time) break;
      if (key.*member_) last = {true, key.at, *(key.*member_)};
    }
    if (last.there) return last;
    if (knot.there && knot.time == 0) return {};
    return {true, 0, start_};
  }
  static Vec3 slope(const Knot& a, const Knot& b, const Knot& c) {
    if (!a.there || !c.there || !(b.time > a.time)) return Vec3::Zero();
    const double before = b.time - a.time, after = c.time - b.time;
    Vec3 out = Vec3::Zero();
    for (int n = 0; n < 3; ++n) {
      const double p = (b.value[n] - a.value[n]) / before, q = (c.value[n] - b.value[n]) / after;
      const double w = 2 * after + before, u = after + 2 * before;
      if ((p > 0) == (q > 0) && p != 0 && q != 0) out[n] = (w + u) / (w / p + u / q);
    }
    return out;
  }

  const std::vector<ObstacleKey>& keys_;
  std::optional<Vec3> ObstacleKey::*member_;
  Vec3 start_;
};

Eigen::Matrix3d about(const Vec3& axis, double degrees) {
  const double c = cosine_of_degrees(degrees), s = sine_of_degrees(degrees);
  Eigen::Matrix3d across;
  across << 0, -axis.z(), axis.y(), axis.z(), 0, -axis.x(), -axis.y(), axis.x(), 0;
  return c * Eigen::Matrix3d::Identity() + s * across + (1 - c) * (axis * axis.transpose()); // Rodrigues
}

Eigen::Matrix3d turned(const Vec3& degrees) {
  return about(Vec3::UnitZ(), degrees.z()) * about(Vec3::UnitY(), degrees.y()) *
         about(Vec3::UnitX(), degrees.x());
}

bool any(const std::vector<ObstacleKey>& keys, std::optional<Vec3> ObstacleKey::*member) {
  return std::any_of(keys.begin(), keys.end(),
                     [&](const ObstacleKey& key) { return (key.*member).has_value(); });
}

} // namespace

bool ObstacleMotion::turns() const {
  return rotate || any(keys, &ObstacleKey::rotate);
}

Pose ObstacleMotion::at(const Vec3& middle, double time) const {
  if (!moves()) return {};
  Pose pose;
  pose.origin = centre.value_or(middle);
  pose.place = pose.origin + time * velocity;
  if (any(keys, &ObstacleKey::position))
    pose.place += Curve(keys, &ObstacleKey::position, middle).at(time) - middle;
  if (rotate) {
    const auto& [x, y, z, rate] = *rotate;
    pose.turn = about(Vec3(x, y, z).normalized(), rate * time);
  } else if (any(keys, &ObstacleKey::rotate)) {
    pose.turn = turned(Curve(keys, &ObstacleKey::rotate, Vec3::Zero()).at(time));
  }
  return pose;
}

void check_motion(const ObstacleMotion& motion, const SettingsSource& source) {
  const ObstacleKey* last = nullptr;
  for (const ObstacleKey& key : motion.keys) {
    check_settings(key);
    if (!key.position && !key.rotate)
      key.source.fail("", "the key says neither where the obstacle is nor how it is turned",
                      "add position=\"0 0 1\" or rotate=\"0 0 90\"");
    if (last) check_key_times(last->at, key.at, key.source);
    last = &key;
  }
  if (!motion.velocity.isZero(0) && any(motion.keys, &ObstacleKey::position))
    source.fail("velocity", "velocity cannot be used together with positions of keys: these give the motion",
                "leave out velocity, or the keys");
  if (motion.rotate) {
    const auto& [x, y, z, rate] = *motion.rotate;
    if (!(Vec3(x, y, z).norm() > 0))
      source.fail("rotate", "the axis of the rotation has no direction", "rotate=\"0 0 1 90\"");
    if (any(motion.keys, &ObstacleKey::rotate))
      source.fail("rotate", "rotate cannot be used together with angles of keys: these give the rotation",
                  "leave out rotate, or the angles of the keys");
  }
  if (motion.centre && !motion.turns())
    source.fail("centre", "centre has no use without rotate",
                "rotate=\"0 0 1 90\" turns by 90 degrees a second");
}

} // namespace rend
