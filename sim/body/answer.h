// Reference values for probes: what a probe must measure at some time, known from a formula, a book or another
// program.
#pragma once

#include "sim/body/probe.h"

#include <limits>

namespace rend {

struct AnswerSettings {
  std::string probe = {};                              // its name
  std::string quantity = {};                           // one of probe_quantities()
  double at = std::numeric_limits<double>::infinity(); // [s]: the first state from then on; infinite: the end
  double value = 0;                                    // [m], [N] or [Pa]
  double tolerance = 0.01;                             // of the error
  std::string known_from = {};                         // a formula, a book ...
  SettingsSource source = {};
};
template <> const Fields<AnswerSettings>& fields_of();

struct Answer : AnswerSettings {
  explicit Answer(const AnswerSettings& settings) : AnswerSettings(settings) {}

  std::size_t number = 0; // of the probe, in the body's

  bool asked = false;             // its time was reached
  std::optional<double> measured; // nullopt if its vertices were deleted

  double error() const; // (measured − value) / |value|; if the value is 0, measured itself. NaN: not measured
  bool holds() const;   // it was measured, and the error is at most the tolerance
};

} // namespace rend
