#include "sim/program/element_kernel.h"

namespace rend::lanes {

REND_CLONES void hexahedra(const KernelArguments& a) {
  run_elements<HexahedronLanes, false>(a);
}

REND_CLONES void hexahedron_corners(const KernelArguments& a) {
  run_elements<HexahedronLanes, true>(a);
}

} // namespace rend::lanes
