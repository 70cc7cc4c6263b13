#include "sim/rows/element_kernel.h"

namespace rend::lanes {

void quads(const KernelArguments& a) {
  at_width<run_elements<QuadLanes, false>>(a);
}

void quad_corners(const KernelArguments& a) {
  at_width<run_elements<QuadLanes, true>>(a);
}

} // namespace rend::lanes
