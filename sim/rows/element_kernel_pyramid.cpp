#include "sim/rows/element_kernel.h"

namespace rend::lanes {

void pyramids(const KernelArguments& a, bool corners) {
  at_width<run_elements<PyramidLanes>>(a, corners);
}

} // namespace rend::lanes
