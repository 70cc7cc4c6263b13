#include "sim/rows/element_kernel.h"

namespace rend::lanes {

void hexahedra(const KernelArguments& a) {
  at_width<run_elements<HexahedronLanes, false>>(a);
}

void hexahedron_corners(const KernelArguments& a) {
  at_width<run_elements<HexahedronLanes, true>>(a);
}

} // namespace rend::lanes
