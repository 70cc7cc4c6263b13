#include "sim/check/axioms.h"

#include "sim/topology/validate.h"

namespace rend {

std::string broken_axiom(const GMap& map) {
  const auto fault = validate(map);
  return fault ? fault->text() : std::string{};
}

} // namespace rend
