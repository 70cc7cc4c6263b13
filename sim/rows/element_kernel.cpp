#include "sim/rows/element_kernel.h"

namespace rend {
namespace {

using namespace lanes;
void (*kernel_of_kind(const KernelArguments& a, bool corners))(const KernelArguments&) {
  const auto& law = static_cast<const ElementLaw&>(a.law);
  if (law.formulation() == Formulation::Enhanced)
    return corners ? &enhanced_hexahedron_corners : &enhanced_hexahedra;
  switch (law.shape().kind) {
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
  return {[](const ForceLaw& law) { // enhanced quads have none: they run by the plain kernel
            const auto* element = dynamic_cast<const ElementLaw*>(&law);
            return element && (element->formulation() == Formulation::Plain ||
                               element->shape().kind == ElementKind::Hexahedron);
          },
          [](const KernelArguments& a) { kernel_of_kind(a, false)(a); },
          [](const KernelArguments& a) { kernel_of_kind(a, true)(a); }};
}

} // namespace rend
