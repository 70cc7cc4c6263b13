#include "sim/base/check.h"
#include "sim/rules/rules.h"
#include "sim/topology/walk.h"

namespace rend {

// Uses `unsew` instead of the separation rules: an element may be sewn to itself, where no match is injective.
void remove_element(Edit& edit, Dart d) {
  const bool sheet = edit.map().dimension() == 2;
  for (Dart e : darts_of(edit.map(), sheet ? FaceOfVolume : Volume, d))
    if (const int i = sheet ? 2 : 3; !edit.map().is_free(i, e)) unsew(edit, i, e);
  CHECK(apply(sheet ? remove_isolated_face : remove_isolated_volume, edit, d).ok);
}

} // namespace rend
