#include "sim/fracture/element_scan.h"

namespace rend {

ElementScan::ElementScan(const CriterionRequest& request, Of quantity)
    : continuum_(request.map, request.interactions), quantity_(quantity) {
  request.map.use(element_orbit(request.map.dimension()));
}

std::string lacking_for_stress(const CriterionRequest& request) {
  if (!Continuum(request.map, request.interactions).empty()) return {};
  return "looks at the elements of a continuum, and this body has no <elasticity>";
}

} // namespace rend
