// Which obstacles a clip has touched: most often a sphere missed what it was meant to hit.
//
// Each body knows which obstacles have acted on it (WorkMeter::touched), and whether anything has: pieces and
// other bodies as well (ContactWork::touched).
#pragma once

#include "sim/scene/scene.h"

#include <optional>
#include <string>
#include <vector>

namespace rend {

struct ObstacleFigures {
  std::size_t obstacle = 0; // by its number in the world
  std::string kind;         // "floor", "sphere", "box" or "obstacle"
  std::size_t number = 0;   // of its kind, from 1
  std::string name;         // empty: none
  bool touched = false;     // by a body, since the start
};

// Those that some body collides with, in the order of floor, spheres, boxes, meshes. Empty: there are none,
// or there is no account of work (static).
std::vector<ObstacleFigures> obstacles_of(const Scene& scene);

// Of the bodies that collide with obstacles: whether none of them has touched anything so far. None:
// there are no such bodies or obstacles, or no account of work (static).
std::optional<bool> touched_nothing(const Scene& scene);

// "sphere 1 at (3, 0.5, -0.28) m, box 'table' at ...": the obstacles that nobody has touched, where they are
// now. Empty: there are none. Not the floor, which often is there for its shadow.
std::string untouched_in_words(const Scene& scene);

} // namespace rend
