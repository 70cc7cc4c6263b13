#include "sim/program/element_kernel.h"

namespace rend::lanes {

REND_CLONES void tetrahedra(const KernelArguments& a) {
  run_elements<SimplexLanes<3>, false>(a);
}

REND_CLONES void tetrahedron_corners(const KernelArguments& a) {
  run_elements<SimplexLanes<3>, true>(a);
}

} // namespace rend::lanes
