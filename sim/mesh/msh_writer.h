// Gmsh's .msh 2.2, ASCII, which nearly every program reads. Groups are written as physical groups of points.
#pragma once

#include "sim/mesh/reader.h"

#include <string>

namespace rend {

// Writes rest positions; nodes and elements are numbered from 1. UserError (65), with `name` as its place, for
// faces of more than four sides and cells of shapes that Gmsh does not have.
std::string msh_text(const MeshBody& body, const std::string& name);

} // namespace rend
