// Separate: two elements are separated at their common border. In a sheet α2 is unsewn along an edge (thesis
// fig. 7.5), in a solid α3 along a face.
#include "sim/fracture/change.h"

namespace rend {

ChangeType separate() {
  return {
      .name = "separate",
      .what = "the two elements on either side of the border are separated",
      .cell = Cell::Borders,
      .apply = [](Edit& edit, const ForceView&, const FoundPlace&,
                  std::span<const Dart> darts) { return unsew(edit, edit.map().dimension(), darts.front()); },
      .keeps_matter = true};
}

} // namespace rend
