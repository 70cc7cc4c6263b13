#include "render/picture/sheet_rim.h"

#include "sim/base/math.h"
#include "sim/expression/noise.h"

#include <algorithm>
#include <cmath>

namespace rend {
namespace {

constexpr int round_parts = 4;      // of half a circle
constexpr double torn_part = 1.5;   // length of the parts of a torn edge, in thicknesses
constexpr int most_torn_parts = 12; // of one edge
constexpr double grain = 0.8;       // length over which a torn edge varies, in thicknesses
constexpr double least_outward = 1; // of the sum of two unit vectors: below it they have no common direction
constexpr double longest_mitre = 2;

class Rim {
public:
  Rim(const SheetRim& rim, FrameBody& out)
      : rim_(rim), x_(rim.map.position().values()), rest_(rim.map.rest().values()), half_(rim.thickness / 2),
        out_(out), outward_(x_.size(), Vec3::Zero()) {
    for_each_edge([this](const BoundaryTriangle& triangle, std::size_t k) { note_outward(triangle, k); });
    for_each_edge([this](const BoundaryTriangle& triangle, std::size_t k) { add(triangle, k); });
  }

private:
  struct Place {          // at an edge
    Vec3 position, rest;  // [m]
    Vec3 normal, outward; // unit; at a corner of the sheet outward is longer
  };

  // Calls f(triangle, k), the edge opposite to its corner k.
  template <class F> void for_each_edge(F&& f) const {
    rim_.surface.for_each_triangle([&](const BoundaryTriangle& triangle) {
      for (std::size_t k = 0; k < 3; ++k)
        if (triangle.side[k] == LineKind::Border || triangle.side[k] == LineKind::Torn) f(triangle, k);
    });
  }

  Vec3 flat(const BoundaryTriangle& t) const {
    const Vec3 a = x_[t.vertex[0]];
    return (x_[t.vertex[1]].vec() - a).cross(x_[t.vertex[2]].vec() - a);
  }
  // Across the edge opposite to corner k, away from it; unit, or 0.
  Vec3 away(const BoundaryTriangle& t, std::size_t k) const {
    const Vec3 along = x_[t.vertex[(k + 2) % 3]].vec() - x_[t.vertex[(k + 1) % 3]].vec();
    return along.cross(flat(t)).stableNormalized();
  }
  void note_outward(const BoundaryTriangle& t, std::size_t k) {
    for (const std::size_t end : {(k + 1) % 3, (k + 2) % 3}) outward_[t.vertex[end]] += away(t, k);
  }

  void add(const BoundaryTriangle& t, std::size_t k) {
    const Place from = end_of(t, k, (k + 1) % 3), to = end_of(t, k, (k + 2) % 3);
    colour_ = rim_.colour(t, (k + 1) % 3, t.side[k] == LineKind::Torn);
    t.side[k] == LineKind::Torn ? add_torn(from, to) : add_round(from, to);
  }

  // Outward is that of both edges at the vertex where they have one, so that their rims meet.
  Place end_of(const BoundaryTriangle& t, std::size_t k, std::size_t end) const {
    const Slot v = t.vertex[end];
    Place at{x_[v], rest_[v], normal_on_side(rim_.normals[v], flat(t)), away(t, k)};
    const bool shared = outward_[v].norm() >= least_outward;
    if (shared) at.outward = outward_[v];
    at.outward -= at.outward.dot(at.normal) * at.normal;
    const double length = at.outward.norm();
    // Of the sum s of two unit vectors, 2 s / s² reaches as far as 1 across both edges: a mitre.
    if (length > 0) at.outward /= shared ? std::max(length * length / 2, length / longest_mitre) : length;
    return at;
  }

  void add_round(const Place& from, const Place& to) {
    const auto direction = [](const Place& end, int part) {
      const double angle = 180.0 * part / round_parts;
      return Vec3(cosine_of_degrees(angle) * end.normal + sine_of_degrees(angle) * end.outward);
    };
    for (int part = 0; part < round_parts; ++part) {
      const std::array<Vec3, 4> normal{direction(from, part), direction(from, part + 1),
                                       direction(to, part + 1), direction(to, part)};
      for (const std::size_t corner : {0U, 1U, 2U, 0U, 2U, 3U})
        put((corner < 2 ? from : to).position + half_ * normal[corner], normal[corner].stableNormalized());
    }
  }

  void add_torn(const Place& from, const Place& to) {
    const double length = (to.rest - from.rest).norm();
    const double wanted = std::ceil(length / (torn_part * rim_.thickness));
    const int parts = static_cast<int>(std::clamp(wanted, 1.0, double{most_torn_parts}));
    Place last = from;
    for (int part = 1; part <= parts; ++part) {
      const Place next = part == parts ? to : between(from, to, static_cast<double>(part) / parts);
      add_ridge(last, next);
      last = next;
    }
  }

  static Place between(const Place& a, const Place& b, double share) {
    const auto mean = [share](const Vec3& one, const Vec3& other) { return Vec3(one + share * (other - one)); };
    return {mean(a.position, b.position), mean(a.rest, b.rest), mean(a.normal, b.normal).stableNormalized(),
            mean(a.outward, b.outward)};
  }

  // Flat triangles: from the front to the ridge, and from there to the back.
  void add_ridge(const Place& from, const Place& to) {
    const std::array<Vec3, 2> ridge{ridge_at(from), ridge_at(to)};
    for (const double side : {1.0, -1.0}) {
      const Vec3 a = from.position + side * half_ * from.normal, b = to.position + side * half_ * to.normal;
      const auto around =
          side > 0 ? std::array{a, ridge[0], ridge[1], b} : std::array{ridge[0], a, b, ridge[1]};
      for (const std::size_t corner : {0U, 1U, 2U, 0U, 2U, 3U}) put(around[corner], Vec3::Zero());
    }
  }

  Vec3 ridge_at(const Place& at) const {
    const Vec3 p = at.rest / (grain * rim_.thickness);
    const double out = 0.2 + 1.2 * noise({p.x(), p.y(), p.z()});
    const double up = 0.8 * noise({p.x(), p.y(), p.z()}, 1) - 0.4;
    return at.position + half_ * (out * at.outward + up * at.normal);
  }

  void put(const Vec3& x, const Vec3& normal) {
    out_.corners.push_back({as_floats(x), as_floats(normal), {colour_[0], colour_[1], colour_[2], 255}, {}});
  }

  const SheetRim& rim_;
  const std::vector<Record>&x_, &rest_; // [m], one per vertex slot
  double half_;                         // of the thickness [m]
  FrameBody& out_;
  Colour colour_{};           // of the edge that is drawn
  std::vector<Vec3> outward_; // sums over the edges of the rim at a vertex, one per vertex slot
};

} // namespace

Vec3 normal_on_side(const Vec3& normal, const Vec3& flat) {
  const double side = normal.dot(flat);
  if (side == 0 && normal.isZero(0) && !flat.isZero(0)) return flat.normalized();
  return side < 0 ? Vec3(-normal) : normal;
}

void draw_rim(const SheetRim& rim, FrameBody& out) {
  Rim(rim, out);
}

} // namespace rend
