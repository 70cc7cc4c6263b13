// How a cut goes through the elements around a vertex: one way for each kind of element. What all have in
// common, the plane and what waits for the next step, is in sim/fracture/cut.cpp.
#pragma once

#include "sim/cuts/cut_state.h"
#include "sim/cuts/touched_darts.h"
#include "sim/rules/apply.h"

#include <memory>
#include <span>

namespace rend {

struct CutRefusal { // by which refusals are counted
  static constexpr const char* nothing_crosses =
      "the plane crosses no element at the vertex that leads into the body";
  static constexpr const char* waits = "another cut of the same step has changed an element at the vertex";
  static constexpr const char* beside_tip = "a crack ends beside the vertex, and goes on from there";
  static constexpr const char* full = "the body has four times as many elements as at the start";
  static constexpr const char* divides_none =
      "the elements at the edge that the plane crosses cannot be divided";
  static constexpr const char* no_room = "a cut would leave a part that is too small or thin";
  static constexpr const char* fronts_meet = "more than two crack fronts meet at the vertex";
};

// In the state before the edit. No element that is cut has changed in the edit.
struct CutPlace {
  const EmbeddedMap& map;
  const Record *position, *velocity; // [m], [m/s], one per vertex slot
  std::span<const Slot> held;        // vertices that do not move, increasing
  std::span<const Dart> darts;       // of the vertex
  Vec3 normal = Vec3::Zero();        // of the plane
  Vec3 ahead = Vec3::Zero();         // where a crack in a sheet goes on, a unit vector; 0: away from its flanks
};

class Cutter {
public:
  virtual ~Cutter() = default;

  // The darts of the elements at a vertex that a cut there divides or parts, and of those beyond them whose
  // change makes it wait.
  virtual std::span<const Dart> around(const GMap& map, std::span<const Dart> darts) = 0;
  // Null: it is cut; otherwise why it is not, and nothing changed. `touched`: by the edit; takes the elements
  // whose corners move.
  virtual const char* cut(Edit& edit, const CutPlace& place, TouchedDarts& touched) = 0;
  virtual RuleRunner& runner() = 0; // that divides elements

  void let_move(bool may) { may_move_ = may; } // whether vertices may move
  void leave(const LeastPart& least) { least_ = least; }

protected:
  CutState state_at(const CutPlace& place, const Column<StartElement>& start) const {
    return {place.map, start, place.position, place.velocity, place.held, !may_move_, least_};
  }

private:
  bool may_move_ = true;
  LeastPart least_;
};

// CHECK: the map knows its elements of the start.
std::unique_ptr<Cutter> sheet_cutter(const EmbeddedMap& map); // of triangles
std::unique_ptr<Cutter> solid_cutter(const EmbeddedMap& map); // of tetrahedra

} // namespace rend
