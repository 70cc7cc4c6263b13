#include "sim/rows/element_kernel.h"

namespace rend::lanes {

void enhanced_hexahedra(const KernelArguments& a) {
  at_width<run_enhanced_elements<HexahedronLanes, false>>(a);
}

void enhanced_hexahedron_corners(const KernelArguments& a) {
  at_width<run_enhanced_elements<HexahedronLanes, true>>(a);
}

} // namespace rend::lanes
