// The norms |f| of the forces on all vertices.
#pragma once

#include "sim/base/record.h"

#include <cstddef>

namespace rend {

// Writes `count` norms; returns the largest.
double norms(const Record* force, std::size_t count, double* norm);

} // namespace rend
