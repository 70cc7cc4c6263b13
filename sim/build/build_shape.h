// The shape of a body, from its preset: what it is made of cell by cell, where it is, and what it weighs.
#pragma once

#include "sim/base/parameters.h"
#include "sim/body/body.h"

namespace rend {

// The elements of a preset that say so, as children of <body>.
std::vector<ChildType> shape_types();

// Map, rest positions and mass. UserError, with its place, for what cannot be built.
void build_shape(Body& body, const PresetNode& node);

} // namespace rend
