#include "sim/rows/element_kernel.h"

namespace rend::lanes {

void prisms(const KernelArguments& a) {
  at_width<run_elements<PrismLanes, false>>(a);
}

void prism_corners(const KernelArguments& a) {
  at_width<run_elements<PrismLanes, true>>(a);
}

} // namespace rend::lanes
