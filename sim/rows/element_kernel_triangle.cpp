#include "sim/rows/element_kernel.h"

namespace rend::lanes {

void triangles(const KernelArguments& a, bool corners) {
  at_width<run_elements<SimplexLanes<2>>>(a, corners);
}

} // namespace rend::lanes
