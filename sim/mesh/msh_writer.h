// Gmsh's .msh 2.2, ASCII, which about everything reads. Groups are written as physical groups of points.
#pragma once

#include "sim/mesh/reader.h"

#include <string>

namespace rend {

// Rest positions; nodes and elements are numbered from 1. UserError (65), with `name` as its place, for faces
// of more than four sides and cells of other shapes than Gmsh's.
std::string msh_text(const MeshBody& body, const std::string& name);

} // namespace rend
