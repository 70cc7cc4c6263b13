// Fills a closed surface with tetrahedra by Gmsh (Geuzaine and Remacle 2009), an external program (Debian:
// gmsh; GPL 2+). It is found in PATH and started without a shell, and never linked.
//
// It works in a folder of its own, which is removed in any case, and keeps the triangles of the surface. What
// it writes is checked before it is used: every tetrahedron has a positive volume, the boundary is the
// surface, and the volumes sum up to that within it.
#pragma once

#include "render/console/time_limit.h"
#include "sim/mesh/closed_surface.h"

#include <functional>
#include <optional>
#include <string>

namespace rend {

struct FillSettings {
  std::string file;           // of the surface, for messages
  double size = 0;            // [m], length of edges within, about
  const TimeLimit& limit;     // of all that fills it
  std::function<bool()> stop; // asked again and again
};

// nullopt: stop() was true. UserError: Usage if Gmsh is not installed, OutOfBudget if it took too long,
// CannotCreate where there is no temporary folder; if it fails, or what it wrote does not fill the surface,
// BadInput where the surface crosses itself, else ReadWrite, with its messages.
std::optional<MeshFile> filled_by_gmsh(const ClosedSurface& surface, const FillSettings& settings);

} // namespace rend
