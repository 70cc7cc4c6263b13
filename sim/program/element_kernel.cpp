#include "sim/program/element_kernel.h"

namespace rend {
namespace {

using namespace lanes;
using Prism = TableLanes<ElementKind::Prism, 6, 6>;
using Pyramid = TableLanes<ElementKind::Pyramid, 5, 8>;

REND_CLONES void triangles(const KernelArguments& a) {
  run_elements<SimplexLanes<2>, false>(a);
}
REND_CLONES void quads(const KernelArguments& a) {
  run_elements<QuadLanes, false>(a);
}
REND_CLONES void tetrahedra(const KernelArguments& a) {
  run_elements<SimplexLanes<3>, false>(a);
}
REND_CLONES void hexahedra(const KernelArguments& a) {
  run_elements<HexahedronLanes, false>(a);
}
REND_CLONES void prisms(const KernelArguments& a) {
  run_elements<Prism, false>(a);
}
REND_CLONES void pyramids(const KernelArguments& a) {
  run_elements<Pyramid, false>(a);
}
REND_CLONES void triangle_corners(const KernelArguments& a) {
  run_elements<SimplexLanes<2>, true>(a);
}
REND_CLONES void quad_corners(const KernelArguments& a) {
  run_elements<QuadLanes, true>(a);
}
REND_CLONES void tetrahedron_corners(const KernelArguments& a) {
  run_elements<SimplexLanes<3>, true>(a);
}
REND_CLONES void hexahedron_corners(const KernelArguments& a) {
  run_elements<HexahedronLanes, true>(a);
}
REND_CLONES void prism_corners(const KernelArguments& a) {
  run_elements<Prism, true>(a);
}
REND_CLONES void pyramid_corners(const KernelArguments& a) {
  run_elements<Pyramid, true>(a);
}

void (*kernel_of_kind(const KernelArguments& a, bool corners))(const KernelArguments&) {
  switch (static_cast<const ElementLaw&>(a.law).shape().kind) {
  case ElementKind::Triangle:
    return corners ? &triangle_corners : &triangles;
  case ElementKind::Quad:
    return corners ? &quad_corners : &quads;
  case ElementKind::Tetrahedron:
    return corners ? &tetrahedron_corners : &tetrahedra;
  case ElementKind::Hexahedron:
    return corners ? &hexahedron_corners : &hexahedra;
  case ElementKind::Prism:
    return corners ? &prism_corners : &prisms;
  case ElementKind::Pyramid:
    return corners ? &pyramid_corners : &pyramids;
  }
  return nullptr;
}

} // namespace

Kernel element_kernel() {
  return {[](const Law& law) { return dynamic_cast<const ElementLaw*>(&law) != nullptr; },
          [](const KernelArguments& a) { kernel_of_kind(a, false)(a); },
          [](const KernelArguments& a) { kernel_of_kind(a, true)(a); }};
}

} // namespace rend
