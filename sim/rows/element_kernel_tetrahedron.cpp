#include "sim/rows/element_kernel.h"

namespace rend::lanes {

void tetrahedra(const KernelArguments& a, bool corners) {
  at_width<run_elements<SimplexLanes<3>>>(a, corners);
}

} // namespace rend::lanes
