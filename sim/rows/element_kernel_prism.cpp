#include "sim/rows/element_kernel.h"

namespace rend::lanes {

namespace {
using Prism = TableLanes<ElementKind::Prism, 6, 6>;
}

void prisms(const KernelArguments& a) {
  at_width<run_elements<Prism, false>>(a);
}

void prism_corners(const KernelArguments& a) {
  at_width<run_elements<Prism, true>>(a);
}

} // namespace rend::lanes
