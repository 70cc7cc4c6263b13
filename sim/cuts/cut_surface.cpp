#include "sim/cuts/cut_surface.h"

#include "sim/base/math.h"
#include "sim/embedding/initial_border.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace rend {
namespace {

// Of the normal of a border face along that of the plane. Nothing pulls at a border, so that tension runs along
// it: what runs across is due to coarse elements, and on a torn face it is what has not gone yet.
constexpr double most_along = 0.5, most_along_torn = 0.15;

// Without the part along a unit vector.
Vec3 without(const Vec3& x, const Vec3& axis) {
  return x - x.dot(axis) * axis;
}

} // namespace

CutSurface::CutSurface(const EmbeddedMap& map, const Record* position, Dart v, const CrackFront& front,
                       const Vec3& normal)
    : map_(map), g_(map.map()), position_(position), here_(position[map.vertex(v)].vec()), normal_(normal) {
  for (const Cycle& cycle : front.cycles()) add_front(cycle);
  along_border_ = !front.passes() &&
                  std::ranges::any_of(front.cycles(), [&](const Cycle& cycle) { return runs_along(cycle); });
}

double CutSurface::height(const Vec3& point) const {
  const Vec3 away = point - here_;
  const Front* behind = front_before(away);
  return away.dot(behind ? behind->middle : normal_);
}

CutSurface::Side CutSurface::side_of(Slot vertex) const {
  const Vec3 away = position_[vertex].vec() - here_;
  const double ahead = away.dot(normal_), least = 1e-3 * away.norm();
  // As far as it seems from ahead, so that edges that lead there are divided in the plane.
  const auto beside = [&](double sign) { return sign * std::max(sign * ahead, least); };
  for (const auto& [slot, sign] : fixed_)
    if (slot == vertex) return {sign == 0 ? 0 : beside(sign), true};
  if (const Front* behind = front_before(away)) return {beside(away.dot(behind->middle) >= 0 ? 1 : -1), true};
  return {std::abs(ahead) < 1e-9 * away.norm() ? 0 : ahead, false};
}

// Null: the point is ahead of all fronts.
const CutSurface::Front* CutSurface::front_before(const Vec3& away) const {
  for (const Front& front : fronts_) {
    const double angle = angle_of(front, away);
    if (front.from < angle && angle < front.to) return &front;
  }
  return nullptr;
}

double CutSurface::angle_of(const Front& front, const Vec3& away) const {
  return arc_tangent(away.dot(front.across), away.dot(front.wake));
}

void CutSurface::add_front(const Cycle& cycle) {
  understood_ = understood_ && cycle.fronts.size() <= 2;
  if (cycle.fronts.empty() || !understood_) return;
  Front front{};
  const bool has_wake = set_wake(front, cycle);
  if (fronts_.empty()) {
    turn_plane(cycle);
    if (front.middle.dot(normal_) < 0) normal_ = -normal_;
  }
  double sign = 1;
  if (front.middle.dot(normal_) < 0) {
    sign = -1;
    front.middle = -front.middle;
    front.across = -front.across;
    front.from = -std::exchange(front.to, -front.from);
  }
  fix_faces(front, cycle, sign);
  if (has_wake) fronts_.push_back(front);
}

// False: the front edges belong to two cracks that meet here, and nothing is behind them.
bool CutSurface::set_wake(Front& front, const Cycle& cycle) const {
  Vec3 middle = Vec3::Zero(), wake = Vec3::Zero();
  for (std::size_t n : cycle.fronts) {
    const auto& [before, after, angle] = cycle.edges[n];
    const double sense = n == cycle.fronts.front() ? 1 : -1; // face A comes after the first, before the second
    middle += sense * (outward_normal(before) - outward_normal(after));
    wake += away_from_edge(before) + away_from_edge(after);
  }
  front.middle = middle.normalized();
  wake = without(wake, front.middle);
  front.wake = wake.normalized();
  front.across = front.middle.cross(front.wake);
  const auto angle = [&](std::size_t n) { return angle_of(front, to(cycle.edges[n].after)); };
  const double one = angle(cycle.fronts.front()), opposite = one > 0 ? one - pi : one + pi,
               other = cycle.fronts.size() == 2 ? angle(cycle.fronts[1]) : opposite;
  front.from = std::min(one, other);
  front.to = std::max(one, other);
  return wake.norm() > 0.5 && front.from < 0 && front.to > 0;
}

// Until it contains the front, if that is possible.
void CutSurface::turn_plane(const Cycle& cycle) {
  Vec3 along = to(cycle.edges[cycle.fronts.front()].after).normalized();
  if (cycle.fronts.size() == 2) along -= to(cycle.edges[cycle.fronts[1]].after).normalized();
  if (along.norm() < 0.5) return;
  const Vec3 turned = without(normal_, along.normalized());
  if (turned.norm() > 0.1) normal_ = turned.normalized();
}

// The vertices of the crack's faces A and B, and those of the front.
void CutSurface::fix_faces(const Front& front, const Cycle& cycle, double sign) {
  const std::size_t count = cycle.edges.size(), first = cycle.fronts.front();
  const auto after = [&](std::size_t n) { return cycle.edges[n % count].after; };
  for (std::size_t n : cycle.fronts) fix(after(n), 0);
  if (cycle.fronts.size() == 2) {
    for (std::size_t n = first + 1; n < first + count; ++n)
      if (n != cycle.fronts[1]) fix(after(n), n < cycle.fronts[1] ? sign : -sign);
    return;
  }
  const auto behind = [&](std::size_t n) {
    const double angle = angle_of(front, to(after(n)));
    return front.from < angle && angle < front.to;
  };
  std::size_t n = first + 1, last = first + count - 1;
  for (; n <= last && behind(n); ++n) fix(after(n), sign);
  for (; last >= n && behind(last); --last) fix(after(last), -sign);
}

void CutSurface::fix(Dart d, double side) {
  fixed_.push_back({map_.vertex(g_.alpha(0, d)), side});
}

bool CutSurface::runs_along(const Cycle& cycle) const {
  const BorderColumn* initial = find_initial_border(map_);
  return std::ranges::any_of(cycle.edges, [&](const CrackFront::BorderEdge& edge) {
    const bool torn = initial && (*initial)[map_.slot(initial->orbit(), edge.after)] == 0;
    return std::abs(outward_normal(edge.after).dot(normal_)) > (torn ? most_along_torn : most_along);
  });
}

Vec3 CutSurface::to(Dart d) const {
  return position_[map_.vertex(g_.alpha(0, d))].vec() - here_;
}

// Of the face of d, out of its element.
Vec3 CutSurface::outward_normal(Dart d) const {
  const Vec3 normal = to(d).cross(to(g_.alpha(1, d))).normalized();
  return normal.dot(to(g_.alpha(1, g_.alpha(2, d)))) > 0 ? Vec3(-normal) : normal;
}

// In the face of d, a unit vector away from the edge of d.
Vec3 CutSurface::away_from_edge(Dart d) const {
  return without(to(g_.alpha(1, d)), to(d).normalized()).normalized();
}

} // namespace rend
