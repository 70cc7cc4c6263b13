#include "sim/program/element_kernel.h"

namespace rend::lanes {

REND_CLONES void quads(const KernelArguments& a) {
  run_elements<QuadLanes, false>(a);
}

REND_CLONES void quad_corners(const KernelArguments& a) {
  run_elements<QuadLanes, true>(a);
}

} // namespace rend::lanes
