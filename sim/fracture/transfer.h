// From the cell on which a criterion was exceeded to the cell on which a change acts: what lets every criterion
// go with every change (thesis 1.2: they are combined freely provided that "un lien identifiant le lieu de la
// transformation à partir du lieu où le critère est testé" is established).
//
//   from     border (separate)     element (delete)      vertex (split)           edge (delete)
//   edge     sheet: itself         pulls its ends        the end pulled more,     itself
//            solid: at an end,     together most         or else the other
//            across the edge
//   border   itself                pulls across it most  pulled across it most,   sheet: itself
//                                                        or else the next         solid: opened most
//   vertex   opened most by the    pulls most across     itself                   pulled most along
//            pull on the vertex    the plane                                      itself
//   element  its neighbour pulls   itself                pulled most along the    pulled most along
//            it there most                               element's largest        itself
//                                                        stress, or else the next
//
// One cell is chosen, so that a law breaks what is strained most and no more than that. (Acting on all cells
// around would crumble a body: an element that lets go of all neighbours is as good as deleted; and both
// elements at an edge are what delete-edge removes.) What is "most" is said by the forces f_e,c that an element
// e applies at its corners c, whatever these come from; with x_c the corners, n and u unit vectors:
//
//   a border b is opened      |(Σ_c f_1,c − Σ_c f_2,c)·n|, c on b: the value of the criterion atomic-border
//   ... at one vertex         the same of the corners there alone; n the border's, or the pull on the vertex
//   an edge a–b is pulled     |(f_e,a − f_e,b)·u| by one element, u along it; at one end Σ_e |f_e,a·u|
//   an element is pulled      along the eigenvector for the largest eigenvalue of −Σ_c (x_c − x̄) f_e,cᵀ:
//                             of its mean stress times its volume
//
// All of that is of the state and the map before the edit. Values are compared in steps of 1e-9 of the largest,
// so that rounding does not decide between equals; among equals the smallest dart is first.
#pragma once

#include "sim/fracture/criterion.h"

#include <span>
#include <string>
#include <vector>

namespace rend {

// Cells of one kind at which a change may act, the best first: it is made at the first where it is possible.
class Places {
public:
  // Darts of the cell, at least one; the cell is what grown() finds from them. Normal of the plane along which
  // a vertex would be split; 0 for other cells.
  void add(std::span<const Dart> darts, const Vec3& normal = Vec3::Zero());
  void clear();

  std::size_t count() const { return ends_.size(); }
  std::span<const Dart> darts(std::size_t place) const;
  const Vec3& normal(std::size_t place) const { return normals_[place]; }
  std::size_t bytes() const;

private:
  std::vector<Dart> darts_; // of all places, one after the other
  std::vector<std::size_t> ends_;
  std::vector<Vec3> normals_;
};

struct Transfer {
  Cell from, to;
  std::string what; // which cell, as a phrase that may name the {element} and the {border}
  // Appends the places of one candidate. `cell`: all darts of the candidate's cell, its smallest first. Needs
  // ForceView::corner. Null: the cell itself is the place, and no force is needed.
  void (*find)(const ForceView&, const Candidate&, std::span<const Dart> cell, Places&) = nullptr;
};

// There is one for every two kinds of cells and both dimensions.
const Transfer& transfer(Cell from, Cell to, int dimension);

// The phrase, in the words of a sheet (2) or a solid (3).
std::string told(const Transfer& transfer, int dimension);

// Overwrites `out` with the darts of the cells, in the map as it is now, that these darts belong to: without
// those that have been removed, in increasing order.
void grown(const GMap& map, Orbit orbit, std::span<const Dart> darts, std::vector<Dart>& out);

} // namespace rend
