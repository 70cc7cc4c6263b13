#include "sim/contact/torn_sides.h"

#include <algorithm>
#include <cmath>
#include <map>

namespace rend {
namespace {

constexpr double opposite = 0.5;      // relative to the size of the sides: how far corners are from each other
constexpr double within_plane = 0.01; // relative to the thickness: how far off their plane those of a sheet are

using Corners = std::span<const std::array<Slot, 2>>;

// Of two sides at the start of the step.
struct Opposition {
  Vec3 normal;                  // from the other side to the one
  double size = 0;              // [m], of the smaller side
  std::optional<Vec3> off = {}; // normal of a sheet; none: of a solid
};

// From their outward vectors; none: they do not face each other.
std::optional<Opposition> opposition_of(const Vec3& one, const Vec3& other, double size) {
  if (!(one.dot(other) < 0)) return {};
  return Opposition{(other.normalized() - one.normalized()).normalized(), size};
}

std::optional<Opposition> opposition_of_faces(const ContactBody& body, Corners corners) {
  const auto area = [&](std::size_t side) {
    const Vec3 first = body.from(corners[0][side]);
    Vec3 sum = Vec3::Zero();
    for (std::size_t k = 1; k + 1 < corners.size(); ++k)
      sum += (body.from(corners[k][side]) - first).cross(body.from(corners[k + 1][side]) - first);
    return sum;
  };
  const Vec3 one = area(0), other = -area(1); // outward: it is seen from its back
  return opposition_of(one, other, std::sqrt(std::min(one.norm(), other.norm())));
}

std::optional<Opposition> opposition_of_edges(const ContactBody& body, Corners ends,
                                              const std::array<Slot, 2>& inside) {
  const auto along = [&](std::size_t side) {
    return Vec3(body.from(ends[1][side]) - body.from(ends[0][side]));
  };
  const auto outward = [&](std::size_t side) {
    const Vec3 way = along(side), in = body.from(inside[side]) - body.from(ends[0][side]);
    return Vec3(way.dot(in) * way - way.squaredNorm() * in);
  };
  if (!(along(0).dot(along(1)) > 0)) return {};
  auto found = opposition_of(outward(0), outward(1), std::min(along(0).norm(), along(1).norm()));
  if (found) found->off = found->normal.cross(along(0) + along(1)).normalized();
  return found;
}

std::optional<ContactConstraint> touch_at(const ContactBody& body, const std::array<Slot, 2>& corner,
                                          const Opposition& sides) {
  const auto [a, b] = corner;
  const double thickness = body.settings().thickness;
  const Vec3& normal = sides.normal;
  const Vec3 off = body.from(a) - body.from(b);
  const double gap = normal.dot(off), most = opposite * sides.size;
  if (gap < -most || (off - gap * normal).squaredNorm() > most * most) return {};
  if (sides.off && std::abs(sides.off->dot(off)) > within_plane * thickness) return {};
  const double kept = sides.off ? 0 : std::clamp(gap, 0.0, thickness);
  if (normal.dot(body.position(a).vec() - body.position(b).vec()) >= kept) return {}; // as most
  return contact_between(ContactPoint::at(body, a), ContactPoint::at(body, b), normal, kept);
}

} // namespace

// A side waits under the places of its corners for the one that lies there as well.
class TornSides::Pairing {
public:
  Pairing(const ContactBody& body, OfBody& of) : rest_(body.body->map->rest()), of_(of) {}
  // `inside`: of an edge, a vertex of its face.
  void add(std::span<const Slot> corners, std::optional<Slot> inside = {}) {
    Side side{{}, inside};
    std::vector<AtRest> places;
    for (const Slot v : corners) {
      places.push_back({rest_[v].x, rest_[v].y, rest_[v].z});
      side.ring.emplace_back(places.back(), v);
    }
    std::sort(places.begin(), places.end());
    const auto [at, first] = waiting_.try_emplace(std::move(places), side);
    if (first) return;
    join(at->second, side);
    waiting_.erase(at);
  }

private:
  using AtRest = std::array<double, 3>; // [m], at rest
  struct Side {
    std::vector<std::pair<AtRest, Slot>> ring;
    std::optional<Slot> inside;
  };
  void join(const Side& one, Side& other) {
    std::sort(other.ring.begin(), other.ring.end());
    std::vector<Corner> corners;
    for (const auto& [place, v] : one.ring)
      corners.push_back(
          {v, std::lower_bound(other.ring.begin(), other.ring.end(), std::pair(place, Slot{0}))->second});
    if (std::ranges::all_of(corners, [](const Corner& corner) { return corner[0] == corner[1]; })) return;
    of_.begin.push_back(static_cast<std::uint32_t>(of_.corners.size()));
    of_.corners.insert(of_.corners.end(), corners.begin(), corners.end());
    if (one.inside) of_.inside.push_back({*one.inside, *other.inside});
  }

  const VertexColumn& rest_;
  OfBody& of_;
  std::map<std::vector<AtRest>, Side> waiting_;
};

TornSides::OfBody TornSides::list(const ContactBody& body) {
  OfBody of;
  if (!body.faces || !body.settings().fragments || (body.solid() && !body.body->border)) return of;
  Body& own = *body.body;
  Pairing pairing(body, of);
  if (body.solid()) {
    own.boundary().for_each_face([&](const BoundaryFaces::Face& face, std::span<const Slot> vertices) {
      if (face.exposed) pairing.add(vertices);
    });
  } else {
    const GMap& map = own.map->map();
    const CellIndex& vertex = own.map->cells(Vertex);
    map.for_each_dart([&](Dart d) {
      const Dart e = map.alpha(0, d), beyond = map.alpha(0, map.alpha(1, d));
      if (d < e && map.is_free(2, d))
        pairing.add(std::array{vertex.slot(d), vertex.slot(e)}, vertex.slot(beyond));
    });
  }
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
      const auto sides = of.inside.empty() ? opposition_of_faces(body, corners)
                                           : opposition_of_edges(body, corners, of.inside[n]);
      if (!sides) continue;
      for (const Corner& corner : corners)
        if (corner[0] != corner[1])
          if (const auto found = touch_at(body, corner, *sides)) answer.add(*found);
    }
  }
}

std::size_t TornSides::pairs() const {
  std::size_t sum = 0;
  for (const OfBody& of : of_) sum += of.begin.empty() ? 0 : of.begin.size() - 1;
  return sum;
}

std::size_t TornSides::bytes() const {
  std::size_t sum = 0;
  for (const OfBody& of : of_) sum += bytes_of(of.corners) + bytes_of(of.begin) + bytes_of(of.inside);
  return sum;
}

} // namespace rend
