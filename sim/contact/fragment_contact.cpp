#include "sim/contact/fragment_contact.h"

#include <algorithm>
#include <cmath>

namespace rend {
namespace {

constexpr double coincident = 1e-10; // relative to the thickness and the face's size

TriangleCorners mixed(const TriangleCorners& a, const TriangleCorners& b, double share) {
  TriangleCorners out;
  for (std::size_t k = 0; k < 3; ++k) out[k] = a[k] + share * (b[k] - a[k]);
  return out;
}

Vec3 at(const TriangleCorners& x, const Weights& w) {
  return w[0] * x[0] + w[1] * x[1] + w[2] * x[2];
}

bool over(const Weights& w) { // projects onto the face, not beside it
  return w[0] > 0 && w[1] > 0 && w[2] > 0;
}

// For a vertex at x and a face: the nearest point, and the contact normal towards the vertex.
struct Facing {
  Weights weight{};
  Vec3 normal = Vec3::Zero();
  double gap = 0; // [m], negative: below the face of a solid
};
std::optional<Facing> facing(const Vec3& x, const TriangleCorners& face, bool solid, double thickness) {
  Facing out;
  out.weight = nearest_in_triangle(face, x);
  const Vec3 way = x - at(face, out.weight);
  const double distance = way.norm();
  const Vec3 area = (face[1] - face[0]).cross(face[2] - face[0]);
  const double size = area.norm();
  const bool known = distance > coincident * (thickness + distance + (face[1] - face[0]).norm());
  if (solid && size > 0 && (over(out.weight) || !known)) {
    out.normal = area / size;
    out.gap = out.normal.dot(way);
    return out.gap > -std::max(thickness, ContactFragments::deepest * std::sqrt(size)) ? std::optional(out)
                                                                                       : std::nullopt;
  }
  if (!known || (solid && way.dot(area) < 0)) return {};
  out.normal = way / distance;
  out.gap = distance;
  return out;
}

} // namespace

std::optional<ContactConstraint> FragmentContact::touch(const ContactPairs::Bodies& bodies,
                                                        const ContactPair& pair) {
  const ContactBody &body = *bodies[pair.body], &other = *bodies[pair.face_body];
  const double thickness = ContactPairs::thickness(body, other);
  const auto& slots = other.faces->triangles()[pair.triangle].vertex;
  const Vec3 x0 = body.from(pair.vertex), x1 = body.position(pair.vertex);
  const TriangleCorners y0{other.from(slots[0]), other.from(slots[1]), other.from(slots[2])};
  const TriangleCorners y1{other.position(slots[0]), other.position(slots[1]), other.position(slots[2])};
  const bool solid = other.solid();
  auto start = facing(x0, y0, solid, thickness);
  if (!start) return {};
  const double before = start->gap, after = start->normal.dot(x1 - at(y1, start->weight));
  if (after >= thickness) return {};
  if (before < 0 && other.obstacle && !other.obstacle->lies_behind(x0, -before)) return {};
  if (before > thickness) { // a path that comes so close may still miss the face
    const double share = (before - thickness) / (before - after);
    const Vec3 there = x0 + share * (x1 - x0);
    const Vec3 side = start->normal;
    start = facing(there, mixed(y0, y1, share), solid, thickness);
    if (!start || start->gap > ContactFragments::beside * thickness || start->normal.dot(side) <= 0) return {};
  }
  const double kept = before < 0 ? 0 : pair.neighbours ? std::min(thickness, before) : thickness;
  if (start->normal.dot(x1 - at(y1, start->weight)) >= kept) return {}; // as most that are packed
  const ContactPoint vertex = ContactPoint::at(body, pair.vertex), face{&other, slots, start->weight};
  return contact_between(vertex, face, start->normal, kept);
}

void FragmentContact::detect(const ContactPairs::Bodies& bodies, ContactAnswer& answer) {
  for (const ContactPair& pair : pairs_.find(bodies))
    if (const auto found = touch(bodies, pair)) answer.add(*found);
}

} // namespace rend
