// What a body is made of, from its preset: interactions between its particles, and ambient viscosity.
#pragma once

#include "sim/base/parameters.h"
#include "sim/body/body.h"

namespace rend {

// The elements of a preset that say so, as children of <body>.
std::vector<ChildType> matter_types();

// Interactions and drag, on a body that has its shape. UserError, with its place, for what cannot be built.
void build_matter(Body& body, const PresetNode& node);

} // namespace rend
