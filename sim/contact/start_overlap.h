// What starts inside something: found before the first step, and refused, or moved out where
// <contact overlap="push"> asks for it.
//
// Contact keeps out what comes in. What starts inside has no side from which it came, and what pushes it out
// works on it, and throws it into the air. So a body may touch, but not lie deeper than 1e-9 of its size in the
// floor, a sphere, a box, a mesh, or another body that it is in contact with. The distances that contact keeps
// do not count: what starts nearer stays as near.
//
// A depth is that of the deepest point that is found:
//
//   floor, sphere, box   of the vertices, and of the nearest or deepest point of each face
//   a solid, closed mesh of the vertices in it, and of the middle of each part of an edge that lies in it: its
//                        distance from the surface
//   a sheet, open mesh   of the edges that go through it: what sticks out on the shorter side
//
// Not tested: vertices that are prescribed in all directions, which give way to nothing, and fragments of one
// body against each other.
//
// With "push", a body is translated as a whole, rest positions as well, until it keeps its distance: along the
// way out of its deepest point, again for what is then deepest. Two bodies share the way by their masses, so
// that their centre of mass stays. Nothing is strained and nothing gets a velocity: the energy grows by the
// weight lifted, and by nothing else. A body with prescribed vertices cannot be moved, and is refused.
#pragma once

#include "sim/body/body.h"
#include "sim/outside/world.h"

namespace rend {

struct StartOverlap {
  std::size_t body = 0;             // that is in contact ...
  std::string with;                 // ... with this: World::called(), or "body 'b'"
  std::optional<std::size_t> other; // the other body
  double depth = 0;                 // [m]
  Vec3 at = Vec3::Zero();           // [m], the deepest point
  Vec3 way = Vec3::UnitZ();         // unit: the way out, of `body`
};

// The deepest one of each body with each thing, in the order of bodies, and of floor, spheres, boxes,
// meshes, bodies.
// Looks at the current positions, and puts what is prescribed where it is at time 0.
std::vector<StartOverlap> start_overlaps(const World& world, const std::vector<std::unique_ptr<Body>>& bodies);

// Refuses them, or moves bodies out of them, and says so in their notes: to be called before bodies are
// prepared. UserError (BadInput) with the place of the <contact>.
void clear_start(const World& world, const std::vector<std::unique_ptr<Body>>& bodies);

} // namespace rend
