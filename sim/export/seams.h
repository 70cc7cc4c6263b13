// For formats in which a place in a picture belongs to a point: a point whose corners lie in several places
// becomes as many points, one after the other, in the order in which faces or cells come to it. They have its
// position and all of its data, and can be joined again by `vertex`.
#pragma once

#include "sim/export/grid.h"
#include "sim/export/skin.h"

namespace rend {

// The place of each point then. CHECK: there are texture coordinates.
std::vector<TexturePlace> split_at_seams(Skin& skin);
std::vector<TexturePlace> split_at_seams(Grid& grid);

} // namespace rend
