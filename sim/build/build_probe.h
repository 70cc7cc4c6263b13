// What is measured on a body, and what should come out, from its preset.
#pragma once

#include "sim/base/parameters.h"
#include "sim/body/body.h"

namespace rend {

// The elements of a preset that say so, as children of <body>.
std::vector<ChildType> probe_types();

// Probes and answers, on a body that has its shape, constraints and loads. UserError, with its place, for what
// cannot be built.
void build_probes(Body& body, const PresetNode& node);

} // namespace rend
