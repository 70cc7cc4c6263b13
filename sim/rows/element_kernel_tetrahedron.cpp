#include "sim/rows/element_kernel.h"

namespace rend::lanes {

void tetrahedra(const KernelArguments& a) {
  at_width<run_elements<SimplexLanes<3>, false>>(a);
}

void tetrahedron_corners(const KernelArguments& a) {
  at_width<run_elements<SimplexLanes<3>, true>>(a);
}

} // namespace rend::lanes
