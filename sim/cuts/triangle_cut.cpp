#include "sim/cuts/triangle_cut.h"

#include "sim/base/math.h"
#include "sim/house_rules/house_rules.h"
#include "sim/mechanics/interaction.h"
#include "sim/topology/walk.h"

#include <algorithm>

namespace rend {
namespace {

constexpr double nearest_share = 0.25;       // of an edge, from its end
constexpr double tip_angle = 300 * pi / 180; // of the matter around it, at least
constexpr double least_cosine = 0.9;         // between an element's normals before and after a corner moves

// Of the triangle of d at rest, first the corner of d.
struct Corners {
  Vec3 a, b, c; // [m]
  Corners(const EmbeddedMap& map, Dart d)
      : a(map.rest_of(d)), b(map.rest_of(map.map().alpha(0, d))),
        c(map.rest_of(map.map().alpha(0, map.map().alpha(1, d)))) {}
  Corners(const Vec3& a_, const Vec3& b_, const Vec3& c_) : a(a_), b(b_), c(c_) {}

  Vec3 normal() const { return (b - a).cross(c - a); } // [m²], as long as twice the area
};

} // namespace

std::optional<CutWay> TriangleCut::through(Dart d, double t) const {
  const Dart other = map_.alpha(1, d), across = map_.alpha(1, map_.alpha(0, d));
  const Vec3 b = at(map_.alpha(0, d)), c = at(map_.alpha(0, other));
  const auto divided = [&](double share) {
    return CutWay{.across = across, .share = share, .to = b + share * (c - b)};
  };
  const bool room = leaves_room(across, t), near = std::min(t, 1 - t) < nearest_share;
  if (room && !near) return divided(t);
  const Dart edge = t < 0.5 ? d : other;
  const bool open = map_.is_free(2, edge);
  const Dart end = map_.alpha(0, edge), far = map_.alpha(0, t < 0.5 ? other : d);
  const Point to = between(end, far, std::min(t, 1 - t));
  if (!open && may_move(end, to)) return CutWay{.edge = edge, .moved = to, .to = to.position};
  if (const auto share = nearest_with_room(across, t)) return divided(*share);
  if (open) return {};
  return CutWay{.edge = edge, .to = at(end)};
}

// Closer to t than the end of the edge.
std::optional<double> TriangleCut::nearest_with_room(Dart across, double t) const {
  constexpr int steps = 64;
  const double inward = (t < 0.5 ? 1.0 : -1.0) / steps, away = std::min(t, 1 - t);
  for (int n = 0; n < steps * away; ++n)
    if (leaves_room(across, t + n * inward)) return t + n * inward;
  return {};
}

// At a share of the way from a to b, with the velocity of a.
Point TriangleCut::between(Dart a, Dart b, double share) const {
  const Vec3 rest = state_.map.rest_of(a);
  return {.position = at(a) + share * (at(b) - at(a)),
          .rest = rest + share * (state_.map.rest_of(b) - rest),
          .velocity = state_.velocity[state_.map.vertex(a)].vec()};
}

bool TriangleCut::may_move(Dart d, const Point& to) const {
  if (state_.rigid || std::ranges::binary_search(state_.held, state_.map.vertex(d))) return false;
  const std::vector<Dart> around = darts_of(map_, Vertex, d);
  return std::ranges::all_of(
      around, [&](Dart e) { return !map_.is_free(2, e) && !is_of_this_step(e) && keeps_shape(e, to); });
}

// The triangle of d was divided by another cut of the step: its parts have no slots yet, and nothing is known
// of their shape. Its corner stays where it is.
bool TriangleCut::is_of_this_step(Dart d) const {
  const CellIndex& vertices = state_.map.cells(Vertex);
  const auto is_new = [&](Dart e) { return vertices.find(e) == no_slot; };
  return is_new(d) || is_new(map_.alpha(0, d)) || is_new(map_.alpha(0, map_.alpha(1, d)));
}

const ElementSizes& TriangleCut::start_of(Dart d) const {
  return state_.start[state_.map.slot(FaceOfVolume, d)];
}

// The triangle of d, if the vertex of d moves.
bool TriangleCut::keeps_shape(Dart d, const Point& to) const {
  const Corners rest(state_.map, d), rest_then(to.rest, rest.b, rest.c);
  const Vec3 b = at(map_.alpha(0, d)), c = at(map_.alpha(0, map_.alpha(1, d)));
  const Vec3 normal = Corners(at(d), b, c).normal(), then = Corners(to.position, b, c).normal();
  return rest_then.normal().dot(rest.normal()) > 0 && may_be_part(to.rest, rest.b, rest.c, d) &&
         then.dot(normal) >= least_cosine * then.norm() * normal.norm();
}

bool TriangleCut::may_be_part(const Vec3& a, const Vec3& b, const Vec3& c, Dart whole) const {
  return ElementSizes(a, b, c).may_be_part(start_of(whole), state_.least);
}

// For the parts of the triangles on both sides of an edge that is divided at that share.
bool TriangleCut::leaves_room(Dart across, double share) const {
  for (Dart d : {across, map_.alpha(2, across)}) {
    const Corners whole(state_.map, d); // divided from a to b
    const Vec3 m = whole.a + share * (whole.b - whole.a);
    if (!may_be_part(whole.a, m, whole.c, d) || !may_be_part(m, whole.b, whole.c, d)) return false;
  }
  return true;
}

bool is_tip(const EmbeddedMap& map, std::span<const Dart> darts) {
  const GMap& g = map.map();
  if (std::ranges::none_of(darts, [&](Dart d) { return g.is_free(2, d); })) return false;
  double angle = 0; // of the matter
  for (Dart d : darts) {
    if (g.alpha(1, d) < d) continue;
    const Corners rest(map, d);
    const Vec3 one = rest.b - rest.a, other = rest.c - rest.a;
    angle += arc_tangent(one.cross(other).norm(), one.dot(other));
  }
  return angle > tip_angle;
}

EdgeDivision::EdgeDivision()
    : runner_(rule("divide-edge-of-triangles")),
      cut_edge_(static_cast<std::size_t>(runner_.rule().right.find("h"))) {}

Dart EdgeDivision::divided(Edit& edit, Dart across, double share) {
  runner_.context().wheres = {scalar_value(share)};
  if (!runner_.apply(edit, across)) return {};
  return runner_.darts()[cut_edge_]; // of the first instance, the hook's own side
}

} // namespace rend
