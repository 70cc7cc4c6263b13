// Of which piece of its body an element is: pieces are connected sets of elements, made when the body is
// built (build/pieces.h), between which it is weak. A wall is a border between elements of different pieces
// that are connected there: an edge of a sheet, a face of a solid. What is made of an element is of its
// piece. Only bodies with pieces have this embedding.
#pragma once

#include "sim/embedding/embedded_map.h"

#include <span>

namespace rend {

struct PieceOfElement {
  using Value = std::uint32_t;
  static constexpr Value none = ~Value{0}; // of elements that a rule makes of nothing

  std::string name = "piece";
  Orbit orbit = FaceOfVolume;
  Orbit support = SingleDart; // what moves its corners does not change it
  Value birth(const EmbeddedMap&, Dart) const { return none; }
  Value split(const Value& whole) const { return whole; }
  Value merge(const Value& kept, const Value&) const { return kept; }
  Value inherit(const EmbeddedMap&, Dart, std::span<const Inherited<Value>> parents) const {
    return parents.front().value;
  }
  PieceOfElement on(const EmbeddedMap& map) const;
};
using PieceColumn = Column<PieceOfElement>;

// The embedding of this map; null: it has none.
const PieceColumn* find_pieces(const EmbeddedMap& map);

// Whether a wall is among the borders of these darts, all of which have slots.
bool is_at_wall(const EmbeddedMap& map, const PieceColumn& pieces, std::span<const Dart> darts);

// To a map that was made from another one: order[n] is the dart there of dart n here. A map without the
// embedding hands on nothing.
void hand_on_pieces(const EmbeddedMap& from, EmbeddedMap& to, std::span<const Dart> order);

} // namespace rend
