#include "sim/mesh/surface_crossing.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <tuple>
#include <vector>

namespace rend {
namespace {

using Corners = std::array<Vec3, 3>;
using Triangle = std::array<std::uint32_t, 3>;

constexpr double round_off = 1e-12; // relative to the cube of a length
constexpr double coordinate_round_off = 1e-14;

struct Extent {
  Vec3 low, high;
};

// The sides on which points are, measured by products of three lengths.
class CrossingSides {
public:
  // `reach` [m]: of the coordinates, which are rounded.
  CrossingSides(double length, double reach)
      : least_((round_off * length + coordinate_round_off * reach) * length * length) {}
  // Six times the volume of a tetrahedron; 0 within round-off.
  double volume(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) const {
    const double exact = (b - a).dot((c - a).cross(d - a));
    return std::abs(exact) <= least_ ? 0 : exact;
  }

private:
  double least_;
};

bool one_sign(double a, double b, double c) {
  return (a >= 0 && b >= 0 && c >= 0) || (a <= 0 && b <= 0 && c <= 0);
}

// The point at which the segment p q meets the triangle, if p and q are not both in its plane.
std::optional<Vec3> pierced(const Vec3& p, const Vec3& q, const Corners& t, const CrossingSides& sides) {
  const double from = sides.volume(p, t[0], t[1], t[2]), to = sides.volume(q, t[0], t[1], t[2]);
  if (from * to > 0 || (from == 0 && to == 0)) return {};
  if (!one_sign(sides.volume(p, q, t[0], t[1]), sides.volume(p, q, t[1], t[2]), sides.volume(p, q, t[2], t[0])))
    return {};
  return p + from / (from - to) * (q - p);
}

// In a plane, coordinates along two axes that it is not perpendicular to.
struct Flat {
  int x, y;
  double turn(const Vec3& a, const Vec3& b, const Vec3& c) const {
    return (b[x] - a[x]) * (c[y] - a[y]) - (b[y] - a[y]) * (c[x] - a[x]);
  }
};

// Whether a line along a side of `a` has all of `b` on its far side, or on it: then they overlap nowhere.
bool parted(const Corners& a, const Corners& b, const Flat& plane, double least) {
  for (std::size_t n = 0; n < 3; ++n) {
    const Vec3 &from = a[n], &to = a[(n + 1) % 3];
    const double inside = plane.turn(from, to, a[(n + 2) % 3]) < 0 ? -1 : 1;
    if (std::all_of(b.begin(), b.end(),
                    [&](const Vec3& x) { return inside * plane.turn(from, to, x) <= least; }))
      return true;
  }
  return false;
}

// The middle of two triangles in one plane that overlap in an area.
std::optional<Vec3> overlap(const Corners& a, const Corners& b, double length, const CrossingSides& sides) {
  for (const Vec3& x : b)
    if (sides.volume(x, a[0], a[1], a[2]) != 0) return {};
  int normal = 0;
  (a[1] - a[0]).cross(a[2] - a[0]).cwiseAbs().maxCoeff(&normal);
  const Flat plane{(normal + 1) % 3, (normal + 2) % 3};
  const double least = round_off * length * length;
  if (parted(a, b, plane, least) || parted(b, a, plane, least)) return {};
  return (a[0] + a[1] + a[2] + b[0] + b[1] + b[2]) / 6;
}

class Crossing {
public:
  explicit Crossing(const ClosedSurface& surface) : surface_(surface) {
    for (const Triangle& t : surface.triangles) {
      const Corners x = corners(t);
      extents_.push_back({x[0].cwiseMin(x[1]).cwiseMin(x[2]), x[0].cwiseMax(x[1]).cwiseMax(x[2])});
      reach_ = std::max(
          {reach_, extents_.back().low.cwiseAbs().maxCoeff(), extents_.back().high.cwiseAbs().maxCoeff()});
    }
  }

  std::optional<Vec3> find() const {
    std::vector<std::uint32_t> order(extents_.size());
    std::iota(order.begin(), order.end(), 0U);
    std::stable_sort(order.begin(), order.end(),
                     [&](auto a, auto b) { return extents_[a].low.x() < extents_[b].low.x(); });
    for (std::size_t n = 0; n < order.size(); ++n)
      for (std::size_t m = n + 1; m < order.size(); ++m) {
        const Extent &a = extents_[order[n]], &b = extents_[order[m]];
        if (b.low.x() > a.high.x()) break;
        if ((a.low.array() > b.high.array()).any() || (b.low.array() > a.high.array()).any()) continue;
        if (const auto at = of_pair(surface_.triangles[order[n]], surface_.triangles[order[m]])) return at;
      }
    return {};
  }

private:
  Corners corners(const Triangle& t) const {
    return {surface_.points[t[0]], surface_.points[t[1]], surface_.points[t[2]]};
  }

  std::optional<Vec3> of_pair(const Triangle& one, const Triangle& other) const {
    const Corners a = corners(one), b = corners(other);
    double length = 0;
    for (const Corners& t : {a, b})
      for (std::size_t n = 0; n < 3; ++n) length = std::max(length, (t[n] - t[(n + 1) % 3]).norm());
    const CrossingSides sides(length, reach_);
    if (const auto at = overlap(a, b, length, sides)) return at;
    const auto is_in = [](const Triangle& t, std::uint32_t p) {
      return std::find(t.begin(), t.end(), p) != t.end();
    };
    for (const auto& [edges, triangle, x] : {std::tuple(&one, &other, &b), std::tuple(&other, &one, &a)})
      for (std::size_t n = 0; n < 3; ++n) {
        const std::uint32_t p = (*edges)[n], q = (*edges)[(n + 1) % 3];
        if (is_in(*triangle, p) || is_in(*triangle, q)) continue; // they meet there in any case
        if (const auto at = pierced(surface_.points[p], surface_.points[q], *x, sides)) return at;
      }
    return {};
  }

  const ClosedSurface& surface_;
  std::vector<Extent> extents_;
  double reach_ = 0; // [m], of the coordinates
};

} // namespace

std::optional<Vec3> crossing_of(const ClosedSurface& surface) {
  return Crossing(surface).find();
}

} // namespace rend
