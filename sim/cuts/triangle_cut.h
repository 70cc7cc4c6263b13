// How a cut leaves a vertex v of a sheet of triangles through the edge bc opposite to it, at
//
//   m = (1 − t) b + t c
//
// without slivers. Where m lies within a quarter of the edge from one of its ends, or a part would be too small
// or thin, the cut runs along the edge to that end, which moves to m, within the matter: its rest position is
// that of m, its position where m is; it keeps its velocity, and the elements around it their masses. An end on
// a border or one that is held stays where it is, and so does one around which an element would become too
// small or thin, or tilt. Then the edge is divided at m, or at the nearest place that leaves no part too small
// or thin, if there is one closer to m than the end; or else the cut bends to that end.
//
// A part of a triangle of the start (start_element.h) is too small below a share of its area, too thin below a
// share of the sine of its least angle (least_part.h).
#pragma once

#include "sim/cuts/cut_state.h"
#include "sim/rules/apply.h"

#include <optional>

namespace rend {

// Through the edge opposite to a vertex.
struct CutWay {
  Dart edge = {};                  // at the vertex, along which it is cut; none: after the division
  Dart across = {};                // of the edge that is divided, at the end from which the share counts
  double share = 0;                // 0: nothing is divided
  std::optional<Point> moved = {}; // where the other end of the edge moves; none: it stays
  Vec3 to = Vec3::Zero();          // where it leads [m]
};

class TriangleCut {
public:
  explicit TriangleCut(const CutState& state) : state_(state), map_(state.map.map()) {}

  // In the triangle of d from the vertex of d, with the edge of d at b. None: it can only bend to where the
  // sheet is open already.
  std::optional<CutWay> through(Dart d, double t) const;
  // Whether the vertex of d may become that point of the matter.
  bool may_move(Dart d, const Point& to) const;
  // Whether the elements at an edge may be divided at that share of it, counted from the dart.
  bool leaves_room(Dart across, double share) const;

private:
  Vec3 at(Dart d) const { return state_.position[state_.map.vertex(d)].vec(); }
  Point between(Dart a, Dart b, double share) const;
  const ElementSizes& start_of(Dart d) const;
  bool is_of_this_step(Dart d) const;
  bool keeps_shape(Dart d, const Point& to) const;
  bool may_be_part(const Vec3& a, const Vec3& b, const Vec3& c, Dart whole) const; // [m], at rest
  std::optional<double> nearest_with_room(Dart across, double t) const;

  CutState state_;
  const GMap& map_;
};

// Whether a crack, or a notch of less than 60°, ends at the vertex with these darts.
bool is_tip(const EmbeddedMap& map, std::span<const Dart> darts);

// Divides edges of triangles.
class EdgeDivision {
public:
  EdgeDivision();
  RuleRunner& runner() { return runner_; }
  // The edge from the opposite vertex in the triangle of `across` to the vertex that is born, at the latter;
  // none: the edge could not be divided, and nothing changed.
  Dart divided(Edit& edit, Dart across, double share);

private:
  RuleRunner runner_;
  std::size_t cut_edge_; // the node of its right graph on that edge
};

} // namespace rend
