#include "sim/program/element_kernel.h"

namespace rend::lanes {

namespace {
using Prism = TableLanes<ElementKind::Prism, 6, 6>;
}

REND_CLONES void prisms(const KernelArguments& a) {
  run_elements<Prism, false>(a);
}

REND_CLONES void prism_corners(const KernelArguments& a) {
  run_elements<Prism, true>(a);
}

} // namespace rend::lanes
