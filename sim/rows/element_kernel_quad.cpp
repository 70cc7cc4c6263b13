#include "sim/rows/element_kernel.h"

namespace rend::lanes {

void quads(const KernelArguments& a, bool corners) {
  at_width<run_elements<QuadLanes>>(a, corners);
}

} // namespace rend::lanes
