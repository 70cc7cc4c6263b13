#include "sim/program/element_kernel.h"

namespace rend::lanes {

namespace {
using Pyramid = TableLanes<ElementKind::Pyramid, 5, 8>;
}

REND_CLONES void pyramids(const KernelArguments& a) {
  run_elements<Pyramid, false>(a);
}

REND_CLONES void pyramid_corners(const KernelArguments& a) {
  run_elements<Pyramid, true>(a);
}

} // namespace rend::lanes
