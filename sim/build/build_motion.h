// What moves a body from outside, from its preset: fixed and driven vertices, and loads.
#pragma once

#include "sim/base/parameters.h"
#include "sim/body/body.h"

namespace rend {

// The elements of a preset that say so, as children of <body>.
std::vector<ChildType> motion_types();

// Constraints and loads, on a body that has its shape. UserError, with its place, for what cannot be built.
void build_motion(Body& body, const PresetNode& node);

} // namespace rend
