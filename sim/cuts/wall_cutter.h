// Divides the elements of a sheet of triangles or a solid of tetrahedra along walls, before anything moves,
// so that the pieces between the walls have smooth faces. Of an element that a wall goes through, an edge ab
// is crossed at
//
//   m = (1 − t) a + t b,   t = h_a / (h_a − h_b)      h: heights above the plane of the wall, at rest
//
// The end of the edge that is nearer moves onto the plane, the shortest way that it may go: anywhere inside;
// in the plane of the faces around it on a flat side or in a sheet, along a sharp edge, within the planes of
// walls on which it lies already; not otherwise. All other edges are divided at m, with all elements around
// them. No element may become smaller or thinner than a share of the element of the start of which it is a
// part (least_part.h), or turn over. Where it would, nothing is divided, and the wall bends to the end that
// is nearer, which comes as near to the plane as it may: there the wall deviates from its plane.
//
// Then no edge of these elements is crossed any more: each lies on one side of the wall. A division adds no
// matter and displaces none, nor does a move: flat borders stay as they are, and so does the volume.
#pragma once

#include "sim/cuts/start_element.h"
#include "sim/cuts/wall.h"
#include "sim/rules/apply.h"
#include "sim/topology/index_set.h"

#include <array>
#include <functional>
#include <optional>
#include <span>
#include <utility>
#include <vector>

namespace rend {

class WallCutter {
public:
  // Adds start_element.h to the map. CHECK: triangles alone, or tetrahedra alone.
  explicit WallCutter(EmbeddedMap& map);

  // `within`: elements of these darts alone; empty: all.
  void cut(const Wall& wall, const std::function<bool(Dart)>& within = {});

  // After all walls: vertices to which walls bend come nearer to their planes, where they may by now.
  void straighten();

private:
  struct Ball {
    Vec3 middle = Vec3::Zero();
    double radius = 0;
  };
  struct Crossing {   // of an edge
    double share = 0; // of it, from the nearer end
    Slot end = 0;     // that one
    Dart dart = {};   // of the edge, at that end
  };
  using Corners = std::array<Vec3, 4>; // [m], at rest; of a triangle the first three

  std::vector<Crossing> crossings() const;
  bool is_met(Dart element) const;
  std::vector<Vec3> section(Dart element) const;
  double height(Slot vertex) const;
  double height(Dart d) const { return height(map_.vertex(d)); }
  std::optional<Crossing> crossing_of(Dart d) const;

  void move_nearest();
  bool move(Dart d, double share = 1);
  std::optional<Vec3> place_on_plane(Dart d) const;
  std::vector<Vec3> held_across(Dart d) const;
  void divide_others();
  void bend(Dart d);
  bool divide(Dart d, double share);
  bool leaves_room(Dart d, double share) const;
  bool may_become(Dart element, const Corners& part) const;

  Corners corners(Dart element) const;
  std::vector<Dart> elements_at(Orbit cell, Dart d) const;
  void measure(Dart element);

  EmbeddedMap& map_;
  const GMap& g_;
  const std::size_t corners_; // of an element
  const Column<StartElement>* start_ = nullptr;
  RuleRunner division_;
  std::size_t born_;                     // node of its right graph
  double zero_ = 0;                      // [m], heights below it are 0
  std::vector<Ball> balls_;              // around each element, one per slot
  std::vector<std::vector<Vec3>> walls_; // normals of those on which each vertex lies, one list per slot

  const Wall* wall_ = nullptr; // that is being cut
  const std::function<bool(Dart)>* within_ = nullptr;
  IndexSet bent_;                                     // vertices to which it bends
  std::vector<std::pair<Dart, OrientedPlane>> bends_; // of all walls
};

} // namespace rend
