#include "sim/rows/element_kernel.h"

namespace rend::lanes {

void hexahedra(const KernelArguments& a, bool corners) {
  at_width<run_elements<HexahedronLanes>>(a, corners);
}

} // namespace rend::lanes
