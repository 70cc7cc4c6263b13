// Selectors: which vertices an element of a preset is about, by their rest positions after `place`.
//
//   near="x y z"                 the closest vertex
//   box="x0 y0 z0 x1 y1 z1"      those within, or within 1e-9 of the body's size of it: grid lines are rounded
//   side="-x" ... "+z"           those at that end of the body, within 1e-9 of its size
//   group="name"                 those of a group that the body's mesh file names
//   all="yes"
#pragma once

#include "sim/base/parameters.h"
#include "sim/body/body.h"

namespace rend {

// The attributes of a selector, to be put into an element's list.
void add_selector(std::vector<AttributeType>& attributes);

// Increasing slots. UserError: no selector, several, or one that selects nothing.
std::vector<Slot> select_vertices(const Body& body, const PresetNode& node);

} // namespace rend
