// Whether a step resolves the relative motion of neighbours.
//
// Two connected particles that move relative to each other by many times their rest length within one step have
// passed through everything between them without any force acting. Explosions exceed this bound long before
// numbers overflow, and so does an element that collapses at a speed that its forces could never stop. An
// element that is flattened or inverted at resolved speeds is not reported: it recovers.
#pragma once

#include "sim/body/body.h"

#include <optional>

namespace rend {

constexpr double most_rest_lengths = 64; // relative motion per step

struct Neighbours {
  std::string joined; // the interaction that connects them
  Slot a = 0, b = 0;
  double rate = 0; // [1/s], relative speed / rest length
};

// The neighbours with the fastest relative motion in terms of their rest lengths. The first interaction of the
// body defines neighbours.
std::optional<Neighbours> fastest_neighbours(const Body& body,
                                             const Record* velocity); // [m/s], one per vertex slot

// The smallest rest length of neighbours [m]; infinite: there are none. Separations do not change it.
double least_rest_length(const Body& body);

} // namespace rend
