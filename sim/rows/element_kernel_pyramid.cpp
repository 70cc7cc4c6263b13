#include "sim/rows/element_kernel.h"

namespace rend::lanes {

namespace {
using Pyramid = TableLanes<ElementKind::Pyramid, 5, 8>;
}

void pyramids(const KernelArguments& a) {
  at_width<run_elements<Pyramid, false>>(a);
}

void pyramid_corners(const KernelArguments& a) {
  at_width<run_elements<Pyramid, true>>(a);
}

} // namespace rend::lanes
