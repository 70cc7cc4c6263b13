// Delete-element: the element is separated from all neighbours, and its darts are removed (thesis 7.3.2, fig.
// 7.7).
#include "sim/fracture/change.h"

#include "sim/mechanics/mass.h"
#include "sim/topology/walk.h"

namespace rend {

void remove_element_of(Edit& edit, Dart d) {
  const int dimension = edit.map().dimension();
  const Orbit element = element_orbit(dimension);
  for (Dart e : darts_of(edit.map(), element, d)) unsew(edit, dimension, e);
  remove_orbit(edit, element, d);
}

ChangeType delete_element() {
  return {"delete-element", "the element is separated from all its neighbours and deleted", Cell::Elements,
          [](Edit& edit, const ForceView&, const FoundPlace&, std::span<const Dart> darts) {
            remove_element_of(edit, darts.front());
            return true;
          }};
}

} // namespace rend
