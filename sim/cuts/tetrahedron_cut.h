// How a cut leaves a vertex v of a solid of tetrahedra through the elements around it, without slivers. Each
// other vertex of these elements lies on one side of the surface of the cut (cut_surface.h) or on it. An edge
// bc between two of them on different sides is to be divided where the surface crosses it, at
//
//   m = (1 − t) b + t c,   t = s_b / (s_b − s_c)      s: heights above the surface
//
// with all tetrahedra around it. Where m lies within a quarter of the edge from one of its ends, or a part
// would be too small or thin (start_element.h), that end counts as lying on the surface, and moves to m within
// the matter: its rest position is that of m, its position where m is; it keeps its velocity, and the elements
// around it their masses. It stays where it is, and the cut bends to it, if it is held, or an element around it
// would become too small or thin. On a border it moves along edges of the border alone, in the planes of all
// faces there: a flat side stays flat, a sharp edge where it is. Vertices on the surface remove crossings and
// add none, so that this comes to an end before anything is divided.
//
// A vertex whose side is fixed takes no part in that; the edge is divided a quarter away from it at least.
#pragma once

#include "sim/cuts/cut_state.h"
#include "sim/cuts/cut_surface.h"
#include "sim/topology/index_set.h"

#include <array>
#include <functional>
#include <optional>
#include <span>
#include <vector>

namespace rend {

struct TetrahedronCutPlan {
  struct Division {
    Dart across; // of the edge, at the end from which the share counts
    double share;
  };
  struct Move {
    Dart dart; // of the vertex
    Point to;
  };
  std::vector<Division> divisions;
  std::vector<Move> moves;
  std::vector<std::pair<Slot, int>> sides; // −1, 0 or 1, of all other vertices of elements at v, by their slots

  int side_of(Slot vertex) const; // CHECK: it is one of them
};

class TetrahedronCut {
public:
  // Whether elements with these darts have changed in this edit.
  using Changed = std::function<bool(std::span<const Dart>)>;

  // `darts`: of v.
  TetrahedronCut(const CutState& state, Changed changed, std::span<const Dart> darts,
                 const CutSurface& surface);

  // None: there is no way that leaves no part too small or thin.
  std::optional<TetrahedronCutPlan> plan();

private:
  struct Corner { // another vertex of an element at v
    Dart dart;    // of it
    Slot slot;
    CutSurface::Side side;
    bool may_move = true;
    std::optional<Point> moved = {};
  };
  struct LinkEdge {
    std::size_t b, c; // corners
    Dart across;      // at b
  };
  struct Tetrahedron {
    std::array<std::uint32_t, 4> point;
    std::size_t whole; // of which it is a part
  };
  struct Crossing {
    const LinkEdge* edge;
    std::optional<std::size_t> end; // to which it may bend: the nearer one, if that is free
    double share, from_end;
  };

  bool crosses(const LinkEdge& edge) const;
  double share_of(const LinkEdge& edge) const;
  std::optional<std::size_t> free_end(const LinkEdge& edge, double share) const;
  bool bend_nearest(double below, const std::function<bool(const LinkEdge&)>& among);
  void bend(const LinkEdge& edge, std::size_t end, double share);
  bool may_move(const Corner& corner, Slot towards, const Vec3& to) const; // to: at rest
  bool keeps_border(std::span<const Dart> darts, Slot towards, const Vec3& to) const;
  bool give_way_in(std::size_t whole);

  // What the plan makes of the elements.
  std::optional<std::size_t> element_without_room();
  void collect_elements();
  void add_element(Dart d);
  std::uint32_t point_of(Dart d);
  void divide_elements();
  bool has_room(const Tetrahedron& part) const;

  CutState state_;
  Changed changed_;
  const GMap& map_;
  std::vector<Dart> darts_;
  std::vector<Corner> corners_;
  std::vector<LinkEdge> edges_;
  IndexMap corner_of_; // vertex slot → index in corners_

  std::vector<Dart> elements_; // a dart of each that is divided or has a corner that moves
  std::vector<Tetrahedron> wholes_, parts_;
  std::vector<Vec3> rest_, now_;           // of their points [m]
  std::vector<Vec3> rest_were_, now_were_; // before the moves
  IndexMap point_of_, element_of_;         // vertex slot → point; element slot → 0
};

} // namespace rend
