#include "sim/rows/element_kernel.h"

namespace rend {
namespace {

using namespace lanes;
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
  return {[](const ForceLaw& law) { return dynamic_cast<const ElementLaw*>(&law) != nullptr; },
          [](const KernelArguments& a) { kernel_of_kind(a, false)(a); },
          [](const KernelArguments& a) { kernel_of_kind(a, true)(a); }};
}

} // namespace rend
