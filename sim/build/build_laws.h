// Where a body tears, from its preset.
#pragma once

#include "sim/base/parameters.h"
#include "sim/body/body.h"

namespace rend {

// The elements of a preset that say so, as children of <body>.
std::vector<ChildType> law_types();

// Laws of tearing, on a body that has its interactions. UserError, with its place, for what cannot be built.
void build_laws(Body& body, const PresetNode& node);

} // namespace rend
