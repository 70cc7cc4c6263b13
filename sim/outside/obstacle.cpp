#include "sim/outside/obstacle.h"

#include "sim/base/archive.h"
#include "sim/base/reach.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace rend {

Plane moved(const Pose& pose, const Plane& plane) {
  const Vec3 normal = pose.turn * plane.normal;
  return {normal, plane.offset + normal.dot(pose.place) - plane.normal.dot(pose.origin)};
}

AttributeType friction_attribute() {
  return number("friction", "", "Coulomb's coefficient of friction; default: that of each body's <contact>")
      .at_least(0);
}

AttributeType restitution_attribute() {
  return number("restitution", "",
                "the share of its normal speed with which what strikes it leaves again; default: that of each "
                "body's <contact>, and 0 for other obstacles")
      .at_least(0)
      .at_most(1);
}

AttributeType obstacle_name_attribute() {
  return text("name", "for <contact>, without blanks; that of no other obstacle or body");
}

template <> const Fields<SphereSettings>& fields_of() {
  using S = SphereSettings;
  static const Fields<S> fields{
      field(&S::centre, position("centre", "position of its centre at the start").is_required()),
      field(&S::radius, number("radius", "m", "its size").above(0).at_most(farthest).is_required()),
      field(&S::velocity, velocity("velocity", "velocity: constant, or with a mass the one at the start")),
      field(&S::mass,
            number("mass", "kg",
                   "with a mass the sphere falls and is pushed by what it hits; without, it keeps its velocity")
                .above(0)
                .at_most(heaviest)),
      field(&S::rotate, rotate_attribute()),
      field(&S::friction, friction_attribute()),
      field(&S::restitution, restitution_attribute()),
      field(&S::name, obstacle_name_attribute())};
  return fields;
}

template <> const Fields<Box>& fields_of() {
  using S = Box;
  static const Fields<S> fields =
      Fields<S>{field(&S::low, position("low", "the corner with the smallest x, y and z").is_required()),
                field(&S::high, position("high", "the corner with the largest x, y and z").is_required())} +
      fields_of_part(&S::motion) +
      Fields<S>{field(&S::friction, friction_attribute()), field(&S::restitution, restitution_attribute()),
                field(&S::name, obstacle_name_attribute())};
  return fields;
}

void check_box(const Box& box) {
  if (!(box.low.array() < box.high.array()).all())
    box.source.fail("high", "the box has no inside: each number of high must be above that of low",
                    "low=\"0 0 0\" high=\"1 1 0.5\"");
  check_motion(box.motion, box.source);
}

Sphere::Sphere(const SphereSettings& settings)
    : start(settings.centre), radius(settings.radius), mass(settings.mass.value_or(0)),
      friction(settings.friction), restitution(settings.restitution), name(settings.name),
      source(settings.source), velocity(settings.velocity), next_velocity(settings.velocity) {
  check_settings(settings);
  motion.velocity = settings.velocity;
  motion.rotate = settings.rotate;
  motion.keys = settings.keys;
  check_motion(motion, settings.source);
  const std::string falling = "the sphere has a mass: it falls, and does not turn or follow keys";
  if (settings.mass && settings.rotate) settings.source.fail("rotate", falling, "leave out mass");
  if (settings.mass && follows_keys()) settings.keys.front().source.fail("", falling, "leave out mass");
  if (follows_keys()) centre = next_centre = motion.at(start, 0).place;
}

void Sphere::predict(double time, double step, const Vec3& gravity) {
  if (follows_keys()) {
    next_centre = motion.at(start, time).place;
    next_velocity = (next_centre - centre) / step;
    return;
  }
  next_velocity = falls() ? Vec3(velocity + step * gravity) : velocity;
  next_centre = falls() ? Vec3(centre + step * next_velocity) : Vec3(start + time * velocity);
}

void Sphere::store(Archive& archive) {
  const Vec3 prescribed = velocity;
  archive(centre, velocity, next_centre, next_velocity, contact_work, gravity_work);
  if (archive.reading())
    refuse_unless(falls() || follows_keys() || velocity == prescribed,
                  "a sphere moves as its preset does not say");
}

bool Sphere::can_be_there(double time) const {
  if (!follows_keys()) return true;
  const Vec3 there = motion.at(start, time).place;
  return (centre - there).norm() <= 1e-9 * (radius + there.norm());
}

void Sphere::commit(const Vec3& gravity, const Vec3& later) {
  if (falls()) gravity_work -= 0.5 * mass * (later - gravity).dot(centre + next_centre);
  centre = next_centre;
  velocity = next_velocity;
}

namespace {

Plane tangent(const Vec3& at, double reach) {
  const double length = at.norm();
  return {length > 0 ? Vec3(at / length) : Vec3(Vec3::UnitZ()), reach};
}

constexpr double on_a_side = 1e-9; // relative to the size of a box
constexpr double grazing = 0.02;   // relative to the radius: a path that crosses less deep is not stopped
constexpr double alike = 0.8;      // cosine between two normals above which the later one is used

// Where the path enters the sphere; `from` itself if that is inside.
Vec3 met(const Vec3& from, const Vec3& way, double reach) {
  const double c = from.squaredNorm() - reach * reach, b = from.dot(way), a = way.squaredNorm();
  if (c <= 0 || a == 0) return from;
  const double root = std::sqrt(std::max(0.0, b * b - a * c));
  return from + std::clamp((-b - root) / a, 0.0, 1.0) * way;
}

} // namespace

std::optional<Plane> Sphere::stop(const Vec3& from, const Vec3& to, double reach) {
  const double left = to.squaredNorm(), square = reach * reach;
  const Vec3 way = to - from;
  if (left < square) {
    const Vec3 entry = met(from, way, reach);
    const bool guides = 4 * left > square && entry.dot(to) > alike * entry.norm() * to.norm();
    return tangent(guides ? to : entry, reach);
  }
  const double length = way.squaredNorm(), passed = (1 - grazing) * (1 - grazing) * square;
  if (length < square - passed) return {}; // the chord is too short to be so deep
  const double share = -from.dot(way) / length;
  if (share <= 0 || share >= 1 || (from + share * way).squaredNorm() > passed) return {};
  return tangent(met(from, way, reach), reach);
}

// A point that touches a side may be a little below it, by round-off.
std::optional<Plane> Box::stop(const Vec3& from, const Vec3& to, double margin) const {
  // in, out: parameters along the path; least: depth [m] of `from` below the nearest side
  double in = -1, out = 1, least = 1e300;
  Plane entry, exit, nearest;
  for (int axis = 0; axis < 3; ++axis) {
    const double ends[2] = {low[axis] - margin, high[axis] + margin};
    for (int end = 0; end < 2; ++end) {
      const double sign = end == 0 ? -1 : 1;
      const double above = sign * (from[axis] - ends[end]), above_later = sign * (to[axis] - ends[end]);
      if (above >= 0 && above_later >= 0) return {};
      const double share = above / (above - above_later);
      const Plane side{Vec3(sign * Vec3::Unit(axis)), sign * ends[end]};
      if (above >= 0 && share > in) {
        in = share;
        entry = side;
      } else if (above < 0 && above_later > 0 && share < out) {
        out = share;
        exit = side;
      }
      if (above < 0 && -above < least) {
        least = -above;
        nearest = side;
      }
    }
  }
  if (in >= out) return {}; // the path misses the box at a corner
  if (in >= 0) return entry;
  const bool inside = ((to - low).array() > -margin).all() && ((high - to).array() > -margin).all();
  const bool touched = least <= std::max(margin, on_a_side * (high - low).norm()); // and then went through
  return inside || (touched && exit.normal != nearest.normal) ? std::optional(nearest) : std::nullopt;
}

Weights nearest_in_triangle(const TriangleCorners& x, const Vec3& point) {
  const Vec3 ab = x[1] - x[0], ac = x[2] - x[0], ap = point - x[0];
  const double d1 = ab.dot(ap), d2 = ac.dot(ap);
  if (d1 <= 0 && d2 <= 0) return {1, 0, 0};
  const Vec3 bp = point - x[1];
  const double d3 = ab.dot(bp), d4 = ac.dot(bp);
  if (d3 >= 0 && d4 <= d3) return {0, 1, 0};
  const double vc = d1 * d4 - d3 * d2;
  if (vc <= 0 && d1 >= 0 && d3 <= 0) {
    const double s = d1 > d3 ? d1 / (d1 - d3) : 0;
    return {1 - s, s, 0};
  }
  const Vec3 cp = point - x[2];
  const double d5 = ab.dot(cp), d6 = ac.dot(cp);
  if (d6 >= 0 && d5 <= d6) return {0, 0, 1};
  const double vb = d5 * d2 - d1 * d6;
  if (vb <= 0 && d2 >= 0 && d6 <= 0) {
    const double s = d2 > d6 ? d2 / (d2 - d6) : 0;
    return {1 - s, 0, s};
  }
  const double va = d3 * d6 - d5 * d4;
  if (va <= 0 && d4 - d3 >= 0 && d5 - d6 >= 0) {
    const double along = d4 - d3, all = along + (d5 - d6);
    const double s = all > 0 ? along / all : 0;
    return {0, 1 - s, s};
  }
  const double whole = va + vb + vc;
  return {va / whole, vb / whole, vc / whole};
}

namespace {

// The minimum of a convex function over [0, 1], by golden section search to 1/300: argument and value.
template <class F> std::pair<double, double> least(F&& f) {
  constexpr double golden = 0.6180339887498949;
  double low = 0, high = 1, a = 1 - golden, b = golden, fa = f(a), fb = f(b);
  for (int n = 0; n < 10; ++n) {
    if (fa < fb) {
      high = b;
      b = a;
      fb = fa;
      a = high - golden * (high - low);
      fa = f(a);
    } else {
      low = a;
      a = b;
      fa = fb;
      b = low + golden * (high - low);
      fb = f(b);
    }
  }
  return fa < fb ? std::pair(a, fa) : std::pair(b, fb);
}

} // namespace

Weights deepest_in_box(const TriangleCorners& x, const Box& box) {
  const Vec3 centre = 0.5 * (box.low + box.high), half = 0.5 * (box.high - box.low);
  const Vec3 from = x[0] - centre, side = x[1] - x[0], across = x[2] - x[1];
  const auto along_chord = [&](double s) { // chords are parallel to the side opposite corner 0
    return least([&](double t) { return ((from + s * side + s * t * across).cwiseAbs() - half).maxCoeff(); });
  };
  const double s = least([&](double at) { return along_chord(at).second; }).first, t = along_chord(s).first;
  return {1 - s, s * (1 - t), s * t};
}

} // namespace rend
