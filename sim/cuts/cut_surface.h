// The surface in which a vertex v of a solid of tetrahedra is cut. Inside the matter, and on a border without a
// crack front, it is the plane through v with normal n. At a crack front it is
//
//   ahead of the front    the plane, turned about the front so that it contains it
//   behind it             the middle of the crack's two faces, whose vertices are on the side of their face
//
// so that only the half of the plane that begins at the front is cut: a crack leaves no bridges between two of
// its vertices, and does not turn back along its wake.
//
// A front edge is a border edge around which there is matter over more than 300° at rest: the tip of a crack,
// or of a notch that the mesh has from the start. All else is of the state that is cut: N_A and N_B the outward
// normals of the two faces at a front edge from v along e, u_A and u_B the directions in them away from it,
//
//   m = Σ (N_B − N_A)    into the matter beside face A       w = Σ (u_A + u_B)    into the wake
//
// over the one or two front edges in a cycle of border faces around v. A point x is behind the front if the
// angle of x − v about m lies between those of the front edges, or of the one and its opposite, on the side of
// w.
#pragma once

#include "sim/cuts/crack_front.h"

#include <span>
#include <vector>

namespace rend {

class CutSurface {
public:
  // Positions: one per vertex slot. `v`: a dart of the vertex.
  CutSurface(const EmbeddedMap& map, const Record* position, Dart v, const CrackFront& front,
             const Vec3& normal);

  bool understood() const { return understood_; }     // false: more than two front edges in one cycle
  bool along_border() const { return along_border_; } // there is no front, and a border face lies in the plane

  // How far a point lies from it: above 0 on the side of its normal [m].
  double height(const Vec3& point) const;

  struct Side {
    double height; // [m]
    bool fixed;    // the vertex is on this side (or on the front, 0), and no cut bends to it
  };
  Side side_of(Slot vertex) const; // of another vertex of an element at v

private:
  using Cycle = CrackFront::Cycle;
  struct Front {
    Vec3 middle, wake, across; // m, w and m × w, unit vectors
    double from, to;           // angles from w to the ends of the wake, about m
  };

  void add_front(const Cycle& cycle);
  bool set_wake(Front& front, const Cycle& cycle) const;
  void turn_plane(const Cycle& cycle);
  void fix_faces(const Front& front, const Cycle& cycle, double sign);
  double angle_of(const Front& front, const Vec3& away) const;
  bool runs_along(const Cycle& cycle) const;
  void fix(Dart d, double side);

  Vec3 to(Dart d) const; // from v along the edge of d
  Vec3 outward_normal(Dart d) const;
  Vec3 away_from_edge(Dart d) const;
  const Front* front_before(const Vec3& away) const;

  const EmbeddedMap& map_;
  const GMap& g_;
  const Record* position_;
  Vec3 here_, normal_;
  std::vector<Front> fronts_;
  std::vector<std::pair<Slot, double>> fixed_; // 1, 0 or −1
  bool understood_ = true, along_border_ = false;
};

} // namespace rend
