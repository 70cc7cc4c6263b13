// What is measured on a body, and what should come out.
#pragma once

#include "sim/build/body_settings.h"

namespace rend {

// Probes and answers, on a body that has its shape, constraints and loads. UserError, with its place, for what
// cannot be built.
void build_probes(Body& body, const BodySettings& settings);

} // namespace rend
