#include "sim/cuts/wall_cutter.h"

#include "sim/base/check.h"
#include "sim/house_rules/house_rules.h"
#include "sim/topology/walk.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string_view>
#include <tuple>
#include <utility>

namespace rend {
namespace {

constexpr double same_plane = 1e-9;    // sine of the angle between normals
constexpr double least_descent = 0.25; // cosine of the angle between a move and the normal of the wall
constexpr LeastPart part_of_wall{.size = 1.0 / 40};

// From a dart of a tetrahedron to each of its edges; the first three are those of its face.
constexpr std::array<std::string_view, 6> to_edges{"", "1", "01", "21", "201", "1201"};
constexpr std::array<std::string_view, 4> to_corners{"", "0", "10", "210"};

const Rule& division_of(const EmbeddedMap& map) {
  return rule(map.dimension() == 2 ? "divide-edge-of-triangles" : "divide-edge-of-tetrahedra");
}

Vec3 normal_of_face(const EmbeddedMap& map, Dart d) { // a unit vector
  const Vec3 a = map.rest_of(d), b = map.rest_of(map.map().alpha(0, d)),
             c = map.rest_of(map.map().follow(d, std::string_view("10")));
  return (b - a).cross(c - a).normalized();
}

// Without what the unit vectors of an orthonormal list span.
Vec3 rejected(Vec3 v, std::span<const Vec3> basis) {
  for (const Vec3& b : basis) v -= v.dot(b) * b;
  return v;
}

} // namespace

WallCutter::WallCutter(EmbeddedMap& map)
    : map_(map), g_(map.map()), corners_(map.dimension() == 2 ? 3 : 4), division_(division_of(map)),
      born_(static_cast<std::size_t>(division_.rule().right.find("g"))) {
  add_start_elements(map_);
  start_ = find_start_elements(map_);
  const CellIndex& elements = map_.cells(start_->orbit());
  Vec3 low = Vec3::Constant(std::numeric_limits<double>::infinity()), high = -low;
  for (Slot e = 0; e < elements.slots(); ++e) {
    if (!elements.alive(e)) continue;
    measure(elements.first_dart(e));
    low = low.cwiseMin(balls_[e].middle);
    high = high.cwiseMax(balls_[e].middle);
  }
  zero_ = 1e-10 * (high - low).norm();
}

void WallCutter::cut(const Wall& wall, const std::function<bool(Dart)>& within) {
  wall_ = &wall;
  within_ = &within;
  bent_.clear();
  walls_.resize(map_.cells(Vertex).slots());
  move_nearest();
  divide_others();
}

double WallCutter::height(Slot vertex) const {
  if (bent_.contains(vertex)) return 0;
  const double height = wall_->plane.height(map_.rest()[vertex]);
  return std::abs(height) < zero_ ? 0 : height;
}

// None: the edge of d is not crossed.
std::optional<WallCutter::Crossing> WallCutter::crossing_of(Dart d) const {
  const Dart there = g_.alpha(0, d);
  const double a = height(d), b = height(there);
  if (!(a * b < 0)) return {};
  const double share = a / (a - b);
  if (share <= 0.5) return Crossing{share, map_.vertex(d), d};
  return Crossing{1 - share, map_.vertex(there), there};
}

// Those of the elements that the wall goes through, one dart an edge, in order of their shares.
std::vector<WallCutter::Crossing> WallCutter::crossings() const {
  std::vector<Crossing> all;
  const CellIndex& elements = map_.cells(start_->orbit());
  for (Slot e = 0; e < elements.slots(); ++e) {
    if (!elements.alive(e) || std::abs(wall_->plane.height(balls_[e].middle)) > balls_[e].radius) continue;
    const auto beyond = [&](const OrientedPlane& bound) {
      return bound.height(balls_[e].middle) > balls_[e].radius;
    };
    const Dart d = elements.first_dart(e);
    if (std::ranges::any_of(wall_->bounds, beyond) || (*within_ && !(*within_)(d)) || !is_met(d)) continue;
    for (std::size_t n = 0; n < (corners_ == 3 ? 3 : 6); ++n)
      if (const auto crossing = crossing_of(g_.follow(d, to_edges[n]))) all.push_back(*crossing);
  }
  const auto key = [&](const Crossing& c) {
    return std::tuple(c.share, c.end, map_.vertex(g_.alpha(0, c.dart)), c.dart);
  };
  std::ranges::sort(all, {}, key);
  const auto same_edge = [&](const Crossing& a, const Crossing& b) {
    return a.end == b.end && map_.vertex(g_.alpha(0, a.dart)) == map_.vertex(g_.alpha(0, b.dart));
  };
  all.erase(std::ranges::unique(all, same_edge).begin(), all.end());
  return all;
}

bool WallCutter::is_met(Dart element) const {
  std::vector<Vec3> polygon = section(element);
  for (const OrientedPlane& bound : wall_->bounds) {
    if (polygon.empty()) return false;
    polygon = clipped(polygon, bound, zero_);
  }
  return !polygon.empty();
}

// The polygon in which the plane of the wall crosses the element; empty: the element lies on one side.
std::vector<Vec3> WallCutter::section(Dart element) const {
  const Corners x = corners(element);
  std::vector<std::pair<Vec3, double>> above, below;
  std::vector<Vec3> polygon;
  for (std::size_t n = 0; n < corners_; ++n) {
    const double h = height(g_.follow(element, to_corners[n]));
    if (h == 0) polygon.push_back(x[n]);
    if (h != 0) (h > 0 ? above : below).push_back({x[n], h});
  }
  if (above.empty() || below.empty()) return {};
  const auto cross = [&](const auto& a, const auto& b) {
    polygon.push_back(a.first + a.second / (a.second - b.second) * (b.first - a.first));
  };
  for (std::size_t n = 0; n < above.size(); ++n)
    for (std::size_t m = 0; m < below.size(); ++m) // of two and two: around
      cross(above[n], below[n == 0 ? m : below.size() - 1 - m]);
  return polygon;
}

// The nearest first: each removes crossings.
void WallCutter::move_nearest() {
  for (const Crossing& found : crossings()) {
    const auto still = crossing_of(found.dart);
    if (still) move(still->dart);
  }
}

// The vertex of d, that share of its way to the plane.
bool WallCutter::move(Dart d, double share) {
  const std::optional<Vec3> on = place_on_plane(d);
  if (!on) return false;
  const Vec3 to = (1 - share) * map_.rest_of(d) + share * *on;
  const std::vector<Dart> around = elements_at(Vertex, d);
  for (Dart e : around) {
    Corners part = corners(e);
    for (std::size_t n = 0; n < corners_; ++n)
      if (map_.vertex(g_.follow(e, to_corners[n])) == map_.vertex(d)) part[n] = to;
    if (!may_become(e, part)) return false;
  }
  map_.edit([&](Edit& edit) { edit.move(d, {to, to, Vec3::Zero()}); });
  for (Dart e : around) measure(e);
  if (share == 1) walls_[map_.vertex(d)].push_back(wall_->plane.normal);
  return true;
}

// The nearest to which the vertex of d may go. None: it may not, or would have to go far.
std::optional<Vec3> WallCutter::place_on_plane(Dart d) const {
  std::vector<Vec3> basis;
  for (const Vec3& normal : held_across(d)) {
    const Vec3 across = rejected(rejected(normal, basis), basis);
    if (across.norm() < same_plane) continue;
    if (basis.size() == 2) return {};
    basis.push_back(across.normalized());
  }
  const Vec3 way = rejected(wall_->plane.normal, basis);
  if (way.norm() < least_descent) return {};
  return map_.rest_of(d) - height(d) / way.squaredNorm() * way;
}

// Unit vectors along which the vertex of d may not move.
std::vector<Vec3> WallCutter::held_across(Dart d) const {
  std::vector<Vec3> held = walls_[map_.vertex(d)];
  std::erase(held, wall_->plane.normal); // to which it is bent
  for (Dart e : darts_of(g_, Vertex, d)) {
    if (g_.dimension() == 3 && !g_.is_free(3, e)) continue;
    const Vec3 normal = normal_of_face(map_, e);
    held.push_back(normal);
    if (g_.dimension() == 2 && g_.is_free(2, e))
      held.push_back((map_.rest_of(g_.alpha(0, e)) - map_.rest_of(e)).cross(normal).normalized());
  }
  return held;
}

// Which edges remain, and of what elements, changes as others are divided: old edges keep their darts.
void WallCutter::divide_others() {
  for (const Crossing& found : crossings()) {
    const auto still = crossing_of(found.dart);
    if (!still) continue;
    if (leaves_room(still->dart, still->share) && divide(still->dart, still->share)) continue;
    if (!move(still->dart) && !move(g_.alpha(0, still->dart))) bend(still->dart);
  }
}

// To the vertex of d, which comes as near to the plane as it may.
void WallCutter::bend(Dart d) {
  for (const double share : {0.75, 0.5, 0.25})
    if (move(d, share)) break;
  bent_.insert(map_.vertex(d));
  walls_[map_.vertex(d)].push_back(wall_->plane.normal);
  bends_.push_back({d, wall_->plane});
}

void WallCutter::straighten() {
  bent_.clear();
  for (const auto& [d, plane] : bends_) {
    const Wall wall{plane};
    wall_ = &wall;
    if (height(d) == 0) continue;
    for (const double share : {1.0, 0.75, 0.5, 0.25})
      if (move(d, share)) break;
  }
  wall_ = nullptr;
}

// For the parts of all elements at the edge of d.
bool WallCutter::leaves_room(Dart d, double share) const {
  const Slot a = map_.vertex(d), b = map_.vertex(g_.alpha(0, d));
  const Vec3 m = (1 - share) * map_.rest()[a].vec() + share * map_.rest()[b].vec();
  for (Dart e : elements_at(Edge, d)) {
    for (Slot end : {a, b}) {
      Corners part = corners(e);
      for (std::size_t n = 0; n < corners_; ++n)
        if (map_.vertex(g_.follow(e, to_corners[n])) == end) part[n] = m;
      if (!may_become(e, part)) return false;
    }
  }
  return true;
}

bool WallCutter::divide(Dart d, double share) {
  const std::vector<Vec3> one = walls_[map_.vertex(d)], other = walls_[map_.vertex(g_.alpha(0, d))];
  Dart born;
  map_.edit([&](Edit& edit) {
    division_.context().wheres = {scalar_value(share)};
    if (division_.apply(edit, d)) born = division_.darts()[born_];
  });
  if (born == Dart{}) return false;
  walls_.resize(map_.cells(Vertex).slots());
  std::vector<Vec3>& walls = walls_[map_.vertex(born)];
  walls = {wall_->plane.normal};
  for (const Vec3& normal : one) // on both
    if (std::ranges::any_of(other, [&](const Vec3& n) { return (n - normal).norm() < same_plane; }))
      walls.push_back(normal);
  bent_.insert(map_.vertex(born)); // whatever its last bits are
  for (Dart e : elements_at(Vertex, born)) measure(e);
  return true;
}

// Whether the element may take these corners, at rest.
bool WallCutter::may_become(Dart element, const Corners& part) const {
  const Corners now = corners(element);
  const auto normal = [](const Corners& x) -> Vec3 { return (x[1] - x[0]).cross(x[2] - x[0]); };
  const ElementSizes& start = (*start_)[map_.slot(start_->orbit(), element)];
  if (corners_ == 3)
    return normal(now).dot(normal(part)) > 0 &&
           ElementSizes(part[0], part[1], part[2]).may_be_part(start, part_of_wall);
  return normal(now).dot(now[3] - now[0]) * normal(part).dot(part[3] - part[0]) > 0 &&
         ElementSizes(part[0], part[1], part[2], part[3]).may_be_part(start, part_of_wall);
}

WallCutter::Corners WallCutter::corners(Dart element) const {
  Corners x{};
  for (std::size_t n = 0; n < corners_; ++n) x[n] = map_.rest_of(g_.follow(element, to_corners[n]));
  return x;
}

// A dart of each, in the order of slots.
std::vector<Dart> WallCutter::elements_at(Orbit cell, Dart d) const {
  const CellIndex& elements = map_.cells(start_->orbit());
  std::vector<Slot> slots;
  for (Dart e : darts_of(g_, cell, d)) slots.push_back(elements.slot(e));
  std::ranges::sort(slots);
  slots.erase(std::ranges::unique(slots).begin(), slots.end());
  std::vector<Dart> darts;
  for (Slot e : slots) darts.push_back(elements.first_dart(e));
  return darts;
}

void WallCutter::measure(Dart element) {
  const Corners x = corners(element);
  const auto own = std::span(x).first(corners_);
  Ball ball;
  for (const Vec3& corner : own) ball.middle += corner / static_cast<double>(corners_);
  for (const Vec3& corner : own) ball.radius = std::max(ball.radius, (corner - ball.middle).norm());
  const Slot e = map_.slot(start_->orbit(), element);
  if (e >= balls_.size()) balls_.resize(e + 1);
  balls_[e] = ball;
}

} // namespace rend
