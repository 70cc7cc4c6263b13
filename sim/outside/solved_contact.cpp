#include "sim/outside/solved_contact.h"

#include "sim/integrate/rigid_motions.h"

#include <algorithm>
#include <cmath>

namespace rend {
namespace {

constexpr double penalty = 100;        // k relative to the stiffness of the vertex and its m/h²
constexpr double tolerance = 1e-9;     // relative to the size of the body: penetration that is left
constexpr double skin = 2 * tolerance; // planes stand off by that, so that contact after the step finds nothing
constexpr double touching = 1e-7;      // relative to the size: a vertex as near as that may press already
constexpr double creep = 1e-5;         // [1/s], times the size of the body: the speed of what sticks
constexpr double settled = 1e-3;       // relative change of the largest multiplier
constexpr int most_rounds = 12;

// The half-space outside a box that touches it at the point nearest to x; nullopt: x is inside.
std::optional<Plane> beside(const Box& box, const Vec3& x) {
  const Vec3 at = x.cwiseMax(box.low).cwiseMin(box.high), from = x - at;
  const double distance = from.norm();
  if (distance == 0) return {};
  return Plane{from / distance, from.dot(at) / distance};
}

} // namespace

double SolvedContact::VertexPlane::pressure(const Record* position) const {
  return std::max(0.0, multiplier - stiffness * gap(position));
}

Vec3 SolvedContact::VertexPlane::sliding(const Record* position) const {
  const Vec3 u = position[vertex].vec() - start;
  return u - plane.normal.dot(u) * plane.normal;
}

void SolvedContact::rebind(System& system, const std::vector<Record>& rest) {
  BlockMatrix matrix;
  matrix.reset(system.pattern());
  const std::vector<Record> still(rest.size());
  system.add_stiffness(rest.data(), still.data(), Tangent::SemiDefinite, 1, 0, matrix);
  stiffness_.resize(rest.size());
  for (std::size_t i = 0; i < rest.size(); ++i) stiffness_[i] = stiffness_of(matrix.diagonal(i));
  size_ = extent(rest, system.inverse_mass);
}

// `nearest(X)`: the plane of the obstacle as the preset puts it, for a vertex at X of its points; the
// obstacle goes its `way`. What is in the obstacle already is left to contact after the step.
template <class Nearest>
void SolvedContact::add_planes(const System& system, const StateView& now, std::size_t obstacle,
                               const RigidStep& way, const Nearest& nearest) {
  if (table_.excludes_obstacle(obstacle)) return;
  const double margin = settings_.thickness + skin * size_;
  for (std::size_t i = 0; i < system.vertices(); ++i) {
    if (system.inverse_mass[i] == 0) continue;
    const Vec3 x = now.position[i].vec(), X = way.from.back(x);
    std::optional<Plane> plane = nearest(X);
    if (!plane) continue;
    plane->offset += margin;
    const double gap = plane->normal.dot(X) - plane->offset;
    if (gap > reach_) continue;
    const double still = way_out(-gap, step_);
    plane->offset -= still;
    planes_.push_back({.vertex = static_cast<Slot>(i),
                       .obstacle = static_cast<std::uint32_t>(obstacle),
                       .plane = moved(way.to, *plane),
                       .from = x,
                       .start = way.to.of(X),
                       .friction = table_.obstacles[obstacle].friction,
                       .stiffness = penalty * (stiffness_[i] + 1 / (system.inverse_mass[i] * step_ * step_)),
                       .still = still});
  }
}

void SolvedContact::add_obstacles(const System& system, double end, const StateView& now) {
  const auto way = [&](const ObstacleMotion& motion, const Vec3& middle) {
    return motion.moves() ? RigidStep{motion.at(middle, end - step_), motion.at(middle, end), step_}
                          : RigidStep{};
  };
  for (std::size_t s = 0; s < world_.spheres.size(); ++s) {
    const Sphere& sphere = world_.spheres[s];
    if (sphere.falls()) continue;
    add_planes(system, now, world_.number_of_sphere(s), way(sphere.motion, sphere.start),
               [&](const Vec3& X) -> std::optional<Plane> {
                 const Vec3 from = X - sphere.start;
                 const double distance = from.norm();
                 if (distance < 0.5 * sphere.radius) return {};
                 return Plane{from / distance, from.dot(sphere.start) / distance + sphere.radius};
               });
  }
  for (std::size_t b = 0; b < world_.boxes.size(); ++b) {
    const Box& box = world_.boxes[b];
    add_planes(system, now, world_.number_of_box(b), way(box.motion, box.middle()),
               [&](const Vec3& X) { return beside(box, X); });
  }
}

// [m/s], of vertices and of what moves towards them.
double SolvedContact::fastest(const System& system, double end, const StateView& now) const {
  double most = 0;
  for (std::size_t i = 0; i < system.vertices(); ++i)
    if (system.inverse_mass[i] != 0) most = std::max(most, now.velocity[i].vec().norm());
  double obstacle = 0;
  const auto look = [&](const ObstacleMotion& motion, const Vec3& middle, double radius) {
    if (!motion.moves()) return;
    const Pose from = motion.at(middle, end - step_), to = motion.at(middle, end);
    const double turned = (to.turn - from.turn).norm() * radius;
    obstacle = std::max(obstacle, ((to.of(middle) - from.of(middle)).norm() + turned) / step_);
  };
  for (const Sphere& sphere : world_.spheres) look(sphere.motion, sphere.start, sphere.radius);
  for (const Box& box : world_.boxes) look(box.motion, box.middle(), (box.high - box.low).norm());
  return most + obstacle;
}

void SolvedContact::begin(const System& system, double end, double step, const StateView& now,
                          const Record* force) {
  step_ = step;
  rounds_ = 0;
  before_.swap(planes_);
  planes_.clear();
  reach_ = 4 * step * (fastest(system, end, now) + step * system.gravity.vec().norm()) + 0.01 * size_;
  if (settings_.floor && world_.floor)
    add_planes(system, now, 0, {}, [&](const Vec3&) {
      return std::optional<Plane>(Plane{Vec3::UnitZ(), world_.floor->z});
    });
  if (settings_.obstacles) add_obstacles(system, end, now);
  first_multipliers(system, now, force);
}

// Without a force, those of the planes before, which have the same order.
void SolvedContact::first_multipliers(const System& system, const StateView& now, const Record* force) {
  auto old = before_.cbegin();
  const auto precedes = [](const VertexPlane& a, const VertexPlane& b) {
    return a.obstacle != b.obstacle ? a.obstacle < b.obstacle : a.vertex < b.vertex;
  };
  for (VertexPlane& each : planes_) {
    const std::size_t i = each.vertex;
    if (force) {
      const bool touches = each.gap(now.position) <= touching * size_;
      const Double4 a = system.acceleration(i, load(force[i]), load(now.velocity[i]));
      const double pressed = -each.plane.normal.dot(Vec3(a[0], a[1], a[2])) / system.inverse_mass[i];
      each.multiplier = touches ? std::max(0.0, pressed) : 0;
    } else {
      while (old != before_.cend() && precedes(*old, each)) ++old;
      if (old != before_.cend() && !precedes(each, *old)) each.multiplier = old->multiplier;
    }
    each.bound = each.friction * each.multiplier;
  }
}

Vec3 SolvedContact::VertexPlane::force(const Record* position, double epsilon) const {
  Vec3 f = pressure(position) * plane.normal;
  if (bound == 0) return f;
  const Vec3 u = sliding(position);
  const double length = u.norm(), share = length / epsilon;
  return f - bound * (share < 1 ? (2 - share) / epsilon : 1 / length) * u;
}

// By the forces at the end of the step, along the way of the vertex and along that of the obstacle.
ContactWork SolvedContact::VertexPlane::work(const Record* position, double epsilon, double thickness) const {
  const Vec3 normal = pressure(position) * plane.normal, across = force(position, epsilon) - normal;
  const Vec3 relative = position[vertex].vec() - start;
  return {.impact = -normal.dot(relative),
          .friction = -across.dot(relative),
          .obstacles = (normal + across).dot(start - from),
          .touched = true,
          .gap = thickness + gap(position) - still,
          .overlap = std::max(0.0, still - gap(position))};
}

double SolvedContact::epsilon() const {
  return creep * size_ * step_;
}

void SolvedContact::add_forces(const Record* position, Record* force) const {
  for (const VertexPlane& each : planes_)
    force[each.vertex] = Record(force[each.vertex].vec() + each.force(position, epsilon()));
}

void SolvedContact::add_stiffness(const Record* position, double by_position, BlockMatrix& out) const {
  const double epsilon = this->epsilon();
  for (const VertexPlane& each : planes_) {
    const Vec3& n = each.plane.normal;
    Eigen::Matrix3d K = Eigen::Matrix3d::Zero();
    if (each.pressure(position) > 0) K += each.stiffness * n * n.transpose();
    if (each.bound > 0) {
      const Vec3 u = each.sliding(position);
      const double length = u.norm(), share = length / epsilon;
      const Eigen::Matrix3d across = Eigen::Matrix3d::Identity() - n * n.transpose();
      if (share >= 1)
        K += each.bound / length * (across - u * u.transpose() / (length * length));
      else
        K += each.bound / epsilon *
             ((2 - share) * across -
              (length > 0 ? share : 0) * u * u.transpose() / std::max(length * length, 1e-300));
    }
    Block3& block = out.at(out.pattern()->diagonal[each.vertex]);
    for (int r = 0; r < 3; ++r)
      for (int c = 0; c < 3; ++c) block(r, c) += by_position * K(r, c);
  }
}

double SolvedContact::potential(const Record* position) const {
  double sum = 0;
  for (const VertexPlane& each : planes_) {
    const double pressure = each.pressure(position);
    sum += (pressure * pressure - each.multiplier * each.multiplier) / (2 * each.stiffness);
  }
  return sum;
}

double SolvedContact::deepest(const Record* position) const {
  double depth = 0;
  for (const VertexPlane& each : planes_) depth = std::max(depth, -each.gap(position));
  return depth;
}

bool SolvedContact::tighten(const Record* position) {
  double largest = 0, changed = 0; // [N]
  for (VertexPlane& each : planes_) {
    const double pressure = each.pressure(position);
    largest = std::max(largest, pressure);
    changed = std::max(changed, std::abs(each.friction * pressure - each.bound));
    each.multiplier = pressure;
    each.bound = each.friction * pressure;
  }
  const bool open = deepest(position) > tolerance * size_ || changed > settled * largest;
  if (open && ++rounds_ <= most_rounds) return true;
  for (const VertexPlane& each : planes_) {
    if (each.multiplier == 0) continue;
    work_ += each.work(position, epsilon(), settings_.thickness);
    touched_.push_back(each.obstacle);
  }
  return false;
}

void SolvedContact::end() {
  planes_.clear();
  touched_.clear();
  work_ = {};
}

} // namespace rend
