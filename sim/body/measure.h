// Quantities to be shown in colour, one per vertex slot.
//
// Springs count by themselves, elements of a continuum as a whole (those of a mass-tensor body as linear ones,
// which is what they are).
#pragma once

#include "sim/body/body.h"

namespace rend {

// The largest, of what is there, of the elongation ratio |l/l0 − 1| of a spring and the greatest principal
// strain of an element, by size.
std::vector<double> vertex_strain(const Body& body);

// The largest elastic force that a spring or an element puts on the vertex [N].
std::vector<double> vertex_force(const Body& body);

// The largest eigenvalue of the mean of its elements' σ, weighed by their masses (thesis 7.2) [Pa]; 0 under
// compression alone, and without elements.
std::vector<double> vertex_stress(const Body& body);

} // namespace rend
