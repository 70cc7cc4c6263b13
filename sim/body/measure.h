// Quantities for display in colour, one per vertex slot.
//
// Springs are evaluated one by one, elements of a continuum as a whole (those of a mass-tensor body as the
// linear elements that they are).
#pragma once

#include "sim/body/body.h"

namespace rend {

// The largest elongation |l/l0 − 1| of a spring or principal strain of an element, in magnitude, at the vertex.
std::vector<double> vertex_strain(const Body& body);

// The largest elastic force of a spring or an element on the vertex [N].
std::vector<double> vertex_force(const Body& body);

// The largest eigenvalue of the mass-weighted average of its elements' σ (thesis 7.2) [Pa]; 0 if all are
// compressive, and without elements.
std::vector<double> vertex_stress(const Body& body);

} // namespace rend
