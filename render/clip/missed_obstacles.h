// Whether a clip ended without any contact: most often a sphere missed what it was meant to hit.
//
// A body knows whether contact has acted on it (ContactWork::touched): the floor, pieces and other bodies
// count as well, so that where anything was touched, nothing is known of a single sphere.
#pragma once

#include "sim/scene/scene.h"

#include <optional>
#include <string>

namespace rend {

// Of the bodies that collide with spheres and boxes: whether none of them has touched anything so far. None:
// there are no such bodies or obstacles, or no account of work (static).
std::optional<bool> touched_nothing(const Scene& scene);

// "sphere 1 at (3, 0.5, -0.28) m, box 1 at ...": where they are now.
std::string obstacles_in_words(const Scene& scene);

} // namespace rend
