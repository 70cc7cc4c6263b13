#include "sim/mesh/fault.h"

#include <fmt/format.h>

namespace rend {

MeshFault::MeshFault(const std::string& kind, std::size_t number, const std::string& what_is_wrong)
    : std::invalid_argument(fmt::format("{} {}: {}", kind, number, what_is_wrong)), element(number),
      flaw(what_is_wrong) {}

} // namespace rend
