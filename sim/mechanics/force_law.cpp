#include "sim/mechanics/force_law.h"

#include "sim/base/check.h"

namespace rend {

void ForceLaw::fold(double*, const double*, bool) const {
  CHECK_NOTE(false, name() + " does not fold");
}

} // namespace rend
