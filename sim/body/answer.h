// Answers: what a probe must measure at some time, known from elsewhere: a formula, a book, another program.
#pragma once

#include "sim/base/error.h"
#include "sim/body/probe.h"

#include <limits>

namespace rend {

struct Answer {
  std::size_t probe = 0; // of the body's probes
  std::string quantity;  // one of probe_quantities()
  double at =
      std::numeric_limits<double>::infinity(); // [s]: the first state from then on counts; infinite: the end
  double value = 0;                            // [m], [N] or [Pa]
  double tolerance = 0;                        // of the error
  std::string source;
  Place place; // in the preset

  bool asked = false;             // its time was reached
  std::optional<double> measured; // none where its vertices were deleted

  double
  error() const; // (measured − value) / |value|; where the value is 0, measured itself. NaN: not measured
  bool holds() const; // the error is there, and at most the tolerance
};

} // namespace rend
