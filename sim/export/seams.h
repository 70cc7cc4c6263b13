// For formats in which a place in a picture belongs to a point: a point of a skin whose corners lie in several
// places becomes as many points, one after the other, in the order in which faces come to it. They have its
// position and its `vertex`, by which they can be joined again.
#pragma once

#include "sim/export/skin.h"

namespace rend {

// The place of each point then. CHECK: the skin has texture coordinates.
std::vector<TexturePlace> split_at_seams(Skin& skin);

} // namespace rend
