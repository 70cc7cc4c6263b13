// The atomic criterion on elements of a continuum (thesis 7.1): the largest eigenvalue of σ = C B u, in world
// axes.
#include "sim/fracture/element_scan.h"

namespace rend {

CriterionType atomic_element() {
  return {.name = "atomic-element",
          .what = "the largest principal stress of each element",
          .unit = "Pa",
          .cell = [](std::string_view) { return Cell::Elements; },
          .lacking = [](const CriterionRequest& request) { return lacking_for_stress(request); },
          .make = [](const CriterionRequest& request) -> std::unique_ptr<Criterion> {
            return largest_of_elements(request, ElementScan::Quantity::Stress);
          },
          .takes_compression = true};
}

} // namespace rend
