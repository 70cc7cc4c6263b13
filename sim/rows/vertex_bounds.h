// A bound of the highest eigenfrequency of a body, until something is separated: for bodies whose elements laws
// divide, where it limits the parts of a step.
//
// The corners of a vertex v are one then. With D_c the diagonals that bound the stiffness of units at corners
// (frequency.h),
//
//   ω² ≤ max over v of  Σ D_c / M_v,   M_v = Σ m_c        over the corners c of v
//
// which is less than the bound by corners where a small element meets large ones, as cuts leave them. The D_c
// of a unit follow from weights of its corners, and any weights give a bound. First these are the masses m_c.
// Then, where the bound is high, shares of the masses of the vertices,
//
//   w_c = M_v D_c / Σ D,
//
// so that small elements have more of it: no eigenvalue of a unit with these weights exceeds the bound before
// (its matrix is at most diag D, and D_c/w_c = Σ D/M_v), nor does what they give at any vertex.
//
// With the masses m_c, units of elements are evaluated when an edit has touched their element, other ones each
// time. Equal maps have equal bounds, whatever happened before.
#pragma once

#include "sim/rows/frequency.h"

#include <memory>
#include <vector>

namespace rend {

class VertexBounds {
public:
  // These outlive it. drag: null if there is none.
  VertexBounds(EmbeddedMap& map, const std::vector<std::unique_ptr<Interaction>>& interactions,
               const MassColumn& mass, const DragColumn* drag);
  ~VertexBounds();
  VertexBounds(const VertexBounds&) = delete;
  VertexBounds& operator=(const VertexBounds&) = delete;

  // Of the map as it is. Rounds: how often the masses are shared anew.
  FrequencyBounds bounds(int rounds = 4);

private:
  // The units of an interaction that elements own, those of an owner slot one after another; `stride` corners
  // each.
  struct Units {
    const Interaction* interaction;
    std::size_t stride;
    std::vector<char> known;                // per owner slot
    std::vector<Slot> corner;               // per corner; no_slot: the unit is not present
    std::vector<double> stiffness, damping; // per corner [N/m], [N·s/m]
  };
  struct Sums {
    double mass = 0, stiffness = 0, damping = 0, drag = 0; // [kg], [N/m], [N·s/m], [N·s/m]
  };

  void forget_changed();
  void find_unknown(Units& units);
  void find(Units& units, Slot owner);
  void evaluate(Units& units, Slot owner, std::size_t unit, const double* mass); // of its corners [kg]
  // vertex_of: one per corner slot. Sums: one per vertex slot.
  std::vector<Sums> sums_at_vertices(const std::vector<Slot>& vertex_of, const CornerBounds& others) const;
  void share_masses(const std::vector<Slot>& vertex_of, const std::vector<Sums>& at, double above);

  EmbeddedMap& map_;
  const CellIndex& corners_;
  const MassColumn& mass_;
  const DragColumn* drag_;
  std::vector<Units> of_elements_;
  std::vector<const Interaction*> others_;
  Changes changes_;
};

} // namespace rend
