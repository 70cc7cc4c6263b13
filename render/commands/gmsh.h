// Fills a closed surface with tetrahedra by Gmsh (Geuzaine and Remacle 2009), an external program (Debian:
// gmsh; GPL 2+). It is found in PATH and started without a shell, and never linked.
//
// It works in a folder of its own, which is removed in any case, and keeps the triangles of the surface. What
// it writes is checked before it is used: every tetrahedron has a positive volume, the boundary is the
// surface, and the volumes sum up to that within it.
#pragma once

#include "sim/mesh/closed_surface.h"

#include <functional>
#include <optional>

namespace rend {

struct FillSettings {
  double size = 0;            // [m], length of edges within, about
  double most_seconds = 600;  // [s]
  std::function<bool()> stop; // asked again and again
};

// nullopt: stop() was true. UserError: Usage if Gmsh is not installed, OutOfBudget if it took too long,
// ReadWrite, with its messages, if it fails or what it wrote does not fill the surface.
std::optional<MeshFile> filled_by_gmsh(const ClosedSurface& surface, const FillSettings& settings);

} // namespace rend
