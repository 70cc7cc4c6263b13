#include "sim/mechanics/law.h"

#include "sim/base/check.h"

namespace rend {

void Law::fold(double*, const double*, bool) const {
  CHECK_NOTE(false, name() + " does not fold");
}

} // namespace rend
