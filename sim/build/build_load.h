// Forces from outside, from the preset of a body.
#pragma once

#include "sim/base/parameters.h"
#include "sim/body/body.h"

namespace rend {

const ElementType& load_type();

// The loads of a body that has its shape. UserError, with its place, for what cannot be built.
void build_loads(Body& body, const PresetNode& node);

} // namespace rend
