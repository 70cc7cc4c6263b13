// Delete-edge: every element that contains the edge is deleted (thesis 7.3.4, after Norton et al. 1991). The
// alternative for edges, splitting one of the ends, is split-vertex with a criterion on edges.
#include "sim/fracture/change.h"

namespace rend {

ChangeType delete_edge() {
  return {"delete-edge",
          "every element at the edge is deleted (split-vertex splits one end of the edge instead)", Cell::Edges,
          [](Edit& edit, const ForceView&, const FoundPlace&, std::span<const Dart> darts) {
            for (Dart d : darts)
              if (edit.map().alive(d)) remove_element_of(edit, d);
            return true;
          }};
}

} // namespace rend
