// An <obstacle>: a mesh from a file, placed as a body is, that stands still or moves as prescribed.
//
// A mesh of polygons that is closed all around, and a solid, have an inside; others are sheets. Of a closed
// surface faces need not agree in orientation: each part of it is turned outward, but for what lies in
// another part, which may be the wall of a hollow.
#pragma once

#include "sim/build/shape.h"
#include "sim/outside/mesh_obstacle.h"

namespace rend {

const ElementType& obstacle_type(); // <obstacle> in the parameter table

// UserError, with its place in the preset or in the mesh: there is no such file, it is no mesh whose faces
// have an area and meet at most in twos, or it is closed and encloses nothing.
MeshObstacle read_obstacle(const PresetNode& node);
MeshObstacle build_obstacle(const MeshObstacleSettings& settings, const Placement& place = {});

// The surface of a sheet or solid as triangles, those of a closed one counter-clockwise as seen from outside.
// `notes`: messages for the author of the preset.
ObstacleSurface obstacle_surface(EmbeddedMap& map, std::vector<std::string>& notes);

} // namespace rend
