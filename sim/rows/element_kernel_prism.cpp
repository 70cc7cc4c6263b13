#include "sim/rows/element_kernel.h"

namespace rend::lanes {

void prisms(const KernelArguments& a, bool corners) {
  at_width<run_elements<PrismLanes>>(a, corners);
}

} // namespace rend::lanes
