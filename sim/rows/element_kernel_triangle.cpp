#include "sim/rows/element_kernel.h"

namespace rend::lanes {

void triangles(const KernelArguments& a) {
  at_width<run_elements<SimplexLanes<2>, false>>(a);
}

void triangle_corners(const KernelArguments& a) {
  at_width<run_elements<SimplexLanes<2>, true>>(a);
}

} // namespace rend::lanes
