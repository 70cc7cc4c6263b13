#include "sim/rows/element_kernel.h"

namespace rend::lanes {

void pyramids(const KernelArguments& a) {
  at_width<run_elements<PyramidLanes, false>>(a);
}

void pyramid_corners(const KernelArguments& a) {
  at_width<run_elements<PyramidLanes, true>>(a);
}

} // namespace rend::lanes
