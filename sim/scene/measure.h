// Quantities to be shown in colour, one per vertex slot.
#pragma once

#include "sim/scene/body.h"

namespace rend {

std::vector<double>
vertex_strain(const Body& body); // the largest elongation ratio |l/l0 − 1| of the springs there
std::vector<double> vertex_force(const Body& body); // the largest elastic force between two particles there [N]

} // namespace rend
