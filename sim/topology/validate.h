// The axioms of a generalized map, checked one by one.
#pragma once

#include "sim/topology/gmap.h"

#include <optional>
#include <string>

namespace rend {

struct BrokenAxiom {
  Dart dart;
  std::string axiom; // "α1 is an involution: α1(α1(7)) = 9"
  std::string text() const;
};

// The first axiom that does not hold, in order of darts; empty if the map is valid.
std::optional<BrokenAxiom> validate(const GMap& map);

} // namespace rend
