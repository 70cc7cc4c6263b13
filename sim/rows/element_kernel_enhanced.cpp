#include "sim/rows/element_kernel.h"

namespace rend::lanes {

void enhanced_hexahedra(const KernelArguments& a, bool corners) {
  at_width<run_enhanced_elements<HexahedronLanes>>(a, corners);
}

} // namespace rend::lanes
