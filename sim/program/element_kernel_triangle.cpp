#include "sim/program/element_kernel.h"

namespace rend::lanes {

REND_CLONES void triangles(const KernelArguments& a) {
  run_elements<SimplexLanes<2>, false>(a);
}

REND_CLONES void triangle_corners(const KernelArguments& a) {
  run_elements<SimplexLanes<2>, true>(a);
}

} // namespace rend::lanes
