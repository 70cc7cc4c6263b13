#include "sim/outside/constraint.h"

#include "sim/base/check.h"
#include "sim/base/math.h"
#include "sim/base/reach.h"

#include <algorithm>
#include <cmath>

namespace rend {

bool holds(Axes axes, int axis) {
  using enum Axes;
  switch (axis) {
  case 0:
    return axes == X || axes == XY || axes == XZ || axes == XYZ;
  case 1:
    return axes == Y || axes == XY || axes == YZ || axes == XYZ;
  default:
    return axes == Z || axes == XZ || axes == YZ || axes == XYZ;
  }
}

namespace {

AttributeType axes_attribute() {
  return word("axes", {"x", "y", "z", "xy", "xz", "yz", "xyz"}, "which coordinates are prescribed");
}

std::array<bool, 3> held_by(Axes axes) {
  return {holds(axes, 0), holds(axes, 1), holds(axes, 2)};
}

} // namespace

template <> const Fields<FixSettings>& fields_of() {
  using S = FixSettings;
  static const Fields<S> fields = fields_of_part(&S::where) + Fields<S>{field(&S::axes, axes_attribute())};
  return fields;
}

template <> const Fields<DriveSettings>& fields_of() {
  using S = DriveSettings;
  static const Fields<S> fields =
      fields_of_part(&S::where) +
      Fields<S>{
          field(&S::velocity, velocity("velocity", "constant velocity")),
          field(
              &S::displacement,
              position("displacement",
                       "displacement reached at until, growing evenly from `from` on; without until, at once")),
          field(&S::gradient,
                within(
                    numbers("gradient", 9, "",
                            "displacement gradient G, row by row: u = G X at until, growing evenly from `from` "
                            "on"),
                    farthest)),
          field(&S::rotate, within(numbers("rotate", 4, "degrees/s",
                                           "axis x y z, then the speed of rotation about it, from `from` on"),
                                   most_degrees)),
          field(&S::centre, position("centre", "a point on the axis of rotate")),
          field(&S::from, number("from", "s", "start time; before it the vertices are held").at_least(0)),
          field(&S::until, number("until", "s", "end time; without it the motion goes on").at_least(0)),
          field(&S::then,
                word("then", {"hold", "free"},
                     "what follows until: hold: the vertices stay where they are; free: they are released")),
          field(&S::axes, axes_attribute())};
  return fields;
}

namespace {

void set_rotation(Motion& motion, const DriveSettings& settings) {
  const auto& [x, y, z, rate] = *settings.rotate;
  if (!(Vec3(x, y, z).norm() > 0))
    settings.source.fail("rotate", "the axis of the rotation has no direction", "rotate=\"0 0 1 90\"");
  motion.axis = Vec3(x, y, z).normalized();
  motion.rate = rate;
  motion.centre = settings.centre;
}

} // namespace

Motion motion_of(const FixSettings& settings) {
  Motion motion;
  motion.axes = held_by(settings.axes);
  return motion;
}

Motion motion_of(const DriveSettings& settings) {
  const SettingsSource& source = settings.source;
  const int given = settings.velocity.has_value() + settings.displacement.has_value() +
                    settings.gradient.has_value() + settings.rotate.has_value();
  if (given != 1)
    source.fail("",
                given == 0 ? "<drive> needs one of velocity, displacement, gradient, rotate"
                           : "<drive> has several of velocity, displacement, gradient, rotate: one of them",
                given == 0 ? "velocity=\"0 0 0.1\" moves it by 0.1 m upwards in each second"
                           : "write a <drive> for each, on other vertices");
  Motion motion;
  motion.axes = held_by(settings.axes);
  motion.velocity = settings.velocity.value_or(Vec3::Zero());
  motion.displacement = settings.displacement.value_or(Vec3::Zero());
  if (settings.gradient)
    motion.gradient = Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(settings.gradient->data());
  if (settings.rotate) set_rotation(motion, settings);
  if (source.given("centre") && !settings.rotate)
    source.fail("centre", "centre has no use without rotate",
                "rotate=\"0 0 1 90\" turns by 90 degrees a second");
  motion.from = settings.from;
  motion.until = settings.until;
  if (motion.until < motion.from) source.fail("until", "the drive ends before it starts");
  motion.then_free = settings.then == DriveSettings::Then::Free;
  return motion;
}

namespace {

constexpr double radians = pi / 180;     // in a degree
constexpr std::size_t most_motions = 64; // bits of a MotionMask

} // namespace

Motion::Moment Motion::at(double time) const {
  Moment now;
  now.acts = acts(time);
  // a vertex released at `until` leaves with the drive's velocity
  const bool over = then_free ? time > until : time >= until;
  now.moves = time >= from && !over;
  now.elapsed = std::clamp(time, from, std::max(from, until)) - from;
  now.share = std::isfinite(until) && until > from ? now.elapsed / (until - from) : (time >= from ? 1.0 : 0.0);
  if (rate == 0) return now;
  now.cosine = cosine_of_degrees(rate * now.elapsed);
  now.sine = sine_of_degrees(rate * now.elapsed);
  return now;
}

Vec3 Motion::turned(const Vec3& rest, const Moment& now) const {
  const double c = now.cosine, s = now.sine;
  const Vec3 r = rest - centre;
  return c * r + s * axis.cross(r) + (1 - c) * axis.dot(r) * axis;
}

Vec3 Motion::offset(const Vec3& rest, const Moment& now) const {
  const Vec3 turn = rate != 0 ? Vec3(turned(rest, now) - (rest - centre)) : Vec3(0, 0, 0);
  return now.elapsed * velocity + now.share * (displacement + gradient * rest) + turn;
}

Vec3 Motion::velocity_at(const Vec3& rest, const Moment& now) const {
  if (!now.moves) return Vec3::Zero();
  Vec3 v = velocity;
  if (!std::isinf(until) && until > from) v += (displacement + gradient * rest) / (until - from);
  if (rate != 0) v += radians * rate * axis.cross(turned(rest, now));
  return v;
}

Vec3 Motion::acceleration_at(const Vec3& rest, const Moment& now) const {
  if (rate == 0 || !now.moves) return Vec3::Zero();
  return radians * rate * axis.cross(radians * rate * axis.cross(turned(rest, now)));
}

void Constraints::add(EmbeddedMap& map, const Motion& motion, const std::vector<Slot>& vertices) {
  CHECK(motions_.size() < most_motions);
  if (!motion_mask_) motion_mask_ = &map.add(MotionMask{});
  for (Slot v : vertices) (*motion_mask_)[v] |= std::uint64_t{1} << motions_.size();
  motions_.push_back(motion);
  list(map);
}

void Constraints::list(const EmbeddedMap& map) {
  vertices_.clear();
  if (!motion_mask_) return;
  const CellIndex& cells = map.cells(Vertex);
  for (Slot v = 0; v < cells.slots(); ++v)
    if (cells.alive(v) && (*motion_mask_)[v] != 0) vertices_.push_back(v);
}

void Constraints::rebind(const EmbeddedMap& map, const Changes& changes) {
  if (!motion_mask_ || !changes.any) return;
  if (changes.whole) return list(map);
  for (Slot v : changes.slots[Vertex.mask]) {
    const auto at = std::lower_bound(vertices_.begin(), vertices_.end(), v);
    const bool listed = at != vertices_.end() && *at == v;
    const bool prescribed = map.cells(Vertex).alive(v) && (*motion_mask_)[v] != 0;
    if (prescribed && !listed) vertices_.insert(at, v);
    if (!prescribed && listed) vertices_.erase(at);
  }
}

void Constraints::apply(const EmbeddedMap& map, double time, Record* position, Record* velocity) const {
  std::array<Motion::Moment, most_motions> now;
  for (std::size_t k = 0; k < motions_.size(); ++k) now[k] = motions_[k].at(time);
  for (Slot vertex : vertices_) {
    const Vec3 rest = map.rest()[vertex];
    Vec3 x = position[vertex], v = velocity[vertex];
    std::uint64_t mask = (*motion_mask_)[vertex];
    for (std::size_t k = 0; mask; ++k, mask >>= 1) {
      if ((mask & 1) == 0 || !now[k].acts) continue;
      const Vec3 offset = motions_[k].offset(rest, now[k]), speed = motions_[k].velocity_at(rest, now[k]);
      for (int axis = 0; axis < 3; ++axis) {
        if (!motions_[k].axes[static_cast<std::size_t>(axis)]) continue;
        x[axis] = rest[axis] + offset[axis];
        v[axis] = speed[axis];
      }
    }
    position[vertex] = x;
    velocity[vertex] = v;
  }
}

void Constraints::mark(double time, std::uint8_t* axes) const {
  for (Slot vertex : vertices_) {
    std::uint64_t mask = (*motion_mask_)[vertex];
    for (std::size_t k = 0; mask; ++k, mask >>= 1) {
      if ((mask & 1) == 0 || !motions_[k].acts(time)) continue;
      for (std::size_t axis = 0; axis < 3; ++axis)
        if (motions_[k].axes[axis]) axes[vertex] |= static_cast<std::uint8_t>(1u << axis);
    }
  }
}

bool Constraints::drives() const {
  for (const Motion& m : motions_)
    if (!m.velocity.isZero() || !m.displacement.isZero() || !m.gradient.isZero() || m.rate != 0) return true;
  return false;
}

} // namespace rend
