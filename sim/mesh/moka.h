// The text format of the Moka modeller, the thesis's C++ engine: a generalized map, dart by dart.
//
//   Moka file [ascii]
//   64 7 0 0 0 0 0 0                      eight mask numbers
//   1 5 0 24   0 0 0 0   1 0.5 0 2        α0 α1 α2 α3 as dart numbers, from 0; four mark words; then 0, or 1
//   ...                                   and the point, if this dart carries that of its vertex
//
// A map with an α3-sewn dart is a solid. Otherwise it is a solid if it is closed (no dart is α2-free: it bounds
// a volume), else a sheet.
#pragma once

#include "sim/embedding/embedded_map.h"

#include <string>

namespace rend {

// Writes rest positions. Darts are numbered without gaps, and the smallest dart of each vertex carries its
// point.
std::string moka_text(const EmbeddedMap& map);

// Whether its file is read as a solid: also that of a sheet without a border, since the format cannot tell a
// hollow sheet from the volume within it.
bool is_solid_in_moka(const GMap& map);

} // namespace rend
