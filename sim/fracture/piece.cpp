#include "sim/fracture/piece.h"

#include <algorithm>

namespace rend {

PieceOfElement PieceOfElement::on(const EmbeddedMap& map) const {
  PieceOfElement there = *this;
  there.orbit = element_orbit(map.dimension());
  return there;
}

const PieceColumn* find_pieces(const EmbeddedMap& map) {
  return find_column<PieceOfElement>(map);
}

bool is_at_wall(const EmbeddedMap& map, const PieceColumn& pieces, std::span<const Dart> darts) {
  const GMap& g = map.map();
  const int link = g.dimension();
  const auto piece = [&](Dart d) { return pieces[map.slot(pieces.orbit(), d)]; };
  return std::ranges::any_of(darts, [&](Dart d) {
    if (g.is_free(link, d)) return false;
    const std::uint32_t one = piece(d), other = piece(g.alpha(link, d));
    return one != other && one != PieceOfElement::none && other != PieceOfElement::none;
  });
}

void hand_on_pieces(const EmbeddedMap& from, EmbeddedMap& to, std::span<const Dart> order) {
  const PieceColumn* old = find_pieces(from);
  if (!old) return;
  PieceColumn& pieces = to.add(PieceOfElement{}.on(to));
  const CellIndex& elements = to.cells(pieces.orbit());
  for (Slot e = 0; e < elements.slots(); ++e)
    if (elements.alive(e)) pieces[e] = (*old)[from.slot(old->orbit(), order[elements.first_dart(e).value])];
}

} // namespace rend
