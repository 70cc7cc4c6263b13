#include "sim/rows/element_kernel.h"

namespace rend {
namespace {

using namespace lanes;
void run(const KernelArguments& a, bool corners) {
  const auto& law = static_cast<const ElementLaw&>(a.law);
  if (law.formulation() == Formulation::Enhanced) return enhanced_hexahedra(a, corners);
  switch (law.shape().kind) {
  case ElementKind::Triangle:
    return triangles(a, corners);
  case ElementKind::Quad:
    return quads(a, corners);
  case ElementKind::Tetrahedron:
    return tetrahedra(a, corners);
  case ElementKind::Hexahedron:
    return hexahedra(a, corners);
  case ElementKind::Prism:
    return prisms(a, corners);
  case ElementKind::Pyramid:
    return pyramids(a, corners);
  }
}

} // namespace

Kernel element_kernel() {
  return {[](const ForceLaw& law) { // enhanced quads have none: they run by the plain kernel
            const auto* element = dynamic_cast<const ElementLaw*>(&law);
            return element && (element->formulation() == Formulation::Plain ||
                               element->shape().kind == ElementKind::Hexahedron);
          },
          [](const KernelArguments& a) { run(a, false); }, [](const KernelArguments& a) { run(a, true); }};
}

} // namespace rend
