#include "sim/contact/torn_sides.h"

#include <algorithm>
#include <cmath>
#include <map>

namespace rend {
namespace {

constexpr double opposite = 0.5; // relative to the size of the faces: how far corners are from each other

using Corners = std::span<const std::array<Slot, 2>>;

struct Opposition {
  Vec3 normal;     // from the other face to the one
  double size = 0; // [m], of the smaller face
};

// At the start of the step; none: they do not face each other.
std::optional<Opposition> opposition_of(const ContactBody& body, Corners corners) {
  const auto area = [&](std::size_t side) {
    const Vec3 first = body.from(corners[0][side]);
    Vec3 sum = Vec3::Zero();
    for (std::size_t k = 1; k + 1 < corners.size(); ++k)
      sum += (body.from(corners[k][side]) - first).cross(body.from(corners[k + 1][side]) - first);
    return sum;
  };
  const Vec3 one = area(0), other = -area(1); // outward: it is seen from its back
  if (!(one.dot(other) < 0)) return {};
  return Opposition{(other.normalized() - one.normalized()).normalized(),
                    std::sqrt(std::min(one.norm(), other.norm()))};
}

std::optional<ContactConstraint> touch_at(const ContactBody& body, const std::array<Slot, 2>& corner,
                                          const Opposition& faces) {
  const auto [a, b] = corner;
  const Vec3& normal = faces.normal;
  const Vec3 off = body.from(a) - body.from(b);
  const double gap = normal.dot(off), most = opposite * faces.size;
  if (gap < -most || (off - gap * normal).squaredNorm() > most * most) return {};
  const double kept = std::clamp(gap, 0.0, body.settings().thickness);
  if (normal.dot(body.position(a).vec() - body.position(b).vec()) >= kept) return {}; // as most
  return contact_between(ContactPoint::at(body, a), ContactPoint::at(body, b), normal, kept);
}

} // namespace

// A face waits under the places of its corners for the one that lies there as well.
TornSides::OfBody TornSides::list(const ContactBody& body) {
  OfBody of;
  if (!body.faces || !body.settings().fragments || !body.solid()) return of;
  const auto& rest = body.body->map->rest();
  using AtRest = std::array<double, 3>; // [m], at rest
  using Ring = std::vector<std::pair<AtRest, Slot>>;
  std::map<std::vector<AtRest>, Ring> waiting;
  body.body->boundary().for_each_face([&](const BoundaryFaces::Face& face, std::span<const Slot> vertices) {
    if (!face.exposed) return;
    Ring ring;
    std::vector<AtRest> places;
    for (const Slot v : vertices) {
      places.push_back({rest[v].x, rest[v].y, rest[v].z});
      ring.emplace_back(places.back(), v);
    }
    std::sort(places.begin(), places.end());
    const auto [at, first] = waiting.try_emplace(std::move(places), ring);
    if (first) return;
    const std::size_t begin = of.corners.size();
    std::sort(ring.begin(), ring.end());
    for (const auto& [place, v] : at->second)
      of.corners.push_back({v, std::lower_bound(ring.begin(), ring.end(), std::pair(place, Slot{0}))->second});
    waiting.erase(at);
    if (std::all_of(of.corners.begin() + static_cast<std::ptrdiff_t>(begin), of.corners.end(),
                    [](const Corner& corner) { return corner[0] == corner[1]; }))
      of.corners.resize(begin);
    else
      of.begin.push_back(static_cast<std::uint32_t>(begin));
  });
  if (!of.begin.empty()) of.begin.push_back(static_cast<std::uint32_t>(of.corners.size()));
  return of;
}

void TornSides::update(const ContactBodies& bodies) {
  of_.resize(bodies.size());
  for (std::size_t b = 0; b < bodies.size(); ++b)
    if (!listed_ || bodies[b]->changed) of_[b] = list(*bodies[b]);
  listed_ = true;
}

void TornSides::detect(const ContactBodies& bodies, ContactAnswer& answer) {
  update(bodies);
  for (std::size_t b = 0; b < bodies.size(); ++b) {
    const ContactBody& body = *bodies[b];
    const OfBody& of = of_[b];
    for (std::size_t n = 0; n + 1 < of.begin.size(); ++n) {
      const Corners corners = Corners(of.corners).subspan(of.begin[n], of.begin[n + 1] - of.begin[n]);
      const auto faces = opposition_of(body, corners);
      if (!faces) continue;
      for (const Corner& corner : corners)
        if (corner[0] != corner[1])
          if (const auto found = touch_at(body, corner, *faces)) answer.add(*found);
    }
  }
}

std::size_t TornSides::faces() const {
  std::size_t sum = 0;
  for (const OfBody& of : of_) sum += of.begin.empty() ? 0 : of.begin.size() - 1;
  return sum;
}

std::size_t TornSides::bytes() const {
  std::size_t sum = 0;
  for (const OfBody& of : of_) sum += bytes_of(of.corners) + bytes_of(of.begin);
  return sum;
}

} // namespace rend
