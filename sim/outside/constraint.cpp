#include "sim/outside/constraint.h"

#include "sim/base/check.h"
#include "sim/base/math.h"

#include <algorithm>
#include <cmath>

namespace rend {

namespace {

constexpr double radians = pi / 180; // in a degree

} // namespace

double Motion::elapsed(double time) const {
  return std::clamp(time, from, std::max(from, until)) - from;
}

Vec3 Motion::turned(const Vec3& rest, double time) const {
  const double angle = rate * elapsed(time), c = cosine_of_degrees(angle), s = sine_of_degrees(angle);
  const Vec3 r = rest - centre;
  return c * r + s * axis.cross(r) + (1 - c) * axis.dot(r) * axis;
}

Vec3 Motion::offset(const Vec3& rest, double time) const {
  const double s = elapsed(time);
  const double share = std::isfinite(until) && until > from ? s / (until - from) : (time >= from ? 1.0 : 0.0);
  const Vec3 turn = rate != 0 ? Vec3(turned(rest, time) - (rest - centre)) : Vec3(0, 0, 0);
  return s * velocity + share * (displacement + gradient * rest) + turn;
}

bool Motion::moves(double time) const {
  const bool over =
      then_free ? time > until : time >= until; // who is let go at `until` leaves with the drive's speed
  return time >= from && !over;
}

Vec3 Motion::velocity_at(const Vec3& rest, double time) const {
  if (!moves(time)) return Vec3::Zero();
  Vec3 v = velocity;
  if (!std::isinf(until) && until > from) v += (displacement + gradient * rest) / (until - from);
  if (rate != 0) v += radians * rate * axis.cross(turned(rest, time));
  return v;
}

Vec3 Motion::acceleration_at(const Vec3& rest, double time) const {
  if (rate == 0 || !moves(time)) return Vec3::Zero();
  return radians * rate * axis.cross(radians * rate * axis.cross(turned(rest, time)));
}

void Constraints::add(EmbeddedMap& map, const Motion& motion, const std::vector<Slot>& vertices) {
  CHECK(motions_.size() < 64);
  if (!obedience_) obedience_ = &map.add(Obedience{});
  for (Slot v : vertices) (*obedience_)[v] |= std::uint64_t{1} << motions_.size();
  motions_.push_back(motion);
  list(map);
}

void Constraints::list(const EmbeddedMap& map) {
  vertices_.clear();
  if (!obedience_) return;
  const CellIndex& cells = map.cells(Vertex);
  for (Slot v = 0; v < cells.slots(); ++v)
    if (cells.alive(v) && (*obedience_)[v] != 0) vertices_.push_back(v);
}

void Constraints::rebind(const EmbeddedMap& map, const Changes& changes) {
  if (!obedience_ || !changes.any) return;
  if (changes.whole) return list(map);
  for (Slot v : changes.slots[Vertex.mask]) {
    const auto at = std::lower_bound(vertices_.begin(), vertices_.end(), v);
    const bool listed = at != vertices_.end() && *at == v;
    const bool obeys = map.cells(Vertex).alive(v) && (*obedience_)[v] != 0;
    if (obeys && !listed) vertices_.insert(at, v);
    if (!obeys && listed) vertices_.erase(at);
  }
}

void Constraints::apply(const EmbeddedMap& map, double time, Record* position, Record* velocity) const {
  for (Slot vertex : vertices_) {
    const Vec3 rest = map.rest()[vertex];
    Vec3 x = position[vertex], v = velocity[vertex];
    std::uint64_t obeys = (*obedience_)[vertex];
    for (std::size_t k = 0; obeys; ++k, obeys >>= 1) {
      if ((obeys & 1) == 0 || !motions_[k].acts(time)) continue;
      const Vec3 offset = motions_[k].offset(rest, time), speed = motions_[k].velocity_at(rest, time);
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
    std::uint64_t obeys = (*obedience_)[vertex];
    for (std::size_t k = 0; obeys; ++k, obeys >>= 1) {
      if ((obeys & 1) == 0 || !motions_[k].acts(time)) continue;
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
