// Whether a step resolves how neighbours move against each other.
//
// Two that are joined and move against each other by many times their distance at rest within one step have
// passed through whatever is between them: no force of the step saw it. What explodes passes this bound long
// before its numbers overflow, and an element that collapses by a speed that its forces could never stop passes
// it, too. One that was flattened or turned inside out within what forces resolve is left alone: it recovers.
#pragma once

#include "sim/body/body.h"

#include <optional>

namespace rend {

constexpr double most_rest_lengths = 64; // of their distance at rest, in a step

struct Neighbours {
  std::string joined; // by what: the name of the interaction
  Slot a = 0, b = 0;
  double rate = 0; // rest lengths a second
};

// Those that move fastest against each other, in their rest lengths. The first kind of interaction says who is
// one.
std::optional<Neighbours> fastest_neighbours(const Body& body,
                                             const Record* velocity); // [m/s], one per vertex slot

// The least distance at rest of neighbours [m]; infinite: there are none. A separation leaves it as it is.
double least_rest_length(const Body& body);

} // namespace rend
