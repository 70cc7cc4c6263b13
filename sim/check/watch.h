// What cases do to a scene and measure on it.
#pragma once

#include "sim/check/case.h"

#include <cstdint>

namespace rend {

double energy(const Scene& scene); // kinetic, elastic and of gravity [J]

// Adds velocities of up to `speed` [m/s] along each axis, of free coordinates.
void shake(Body& body, double speed, std::uint64_t seed);

// Takes the motion of the body as a whole, its drift and its turn, out of its velocities.
void stop_as_a_whole(Body& body);

// Puts every vertex where `place` has it from its rest position [m]; prescribed ones go back at the next step.
void put(Body& body, const std::function<Vec3(const Vec3& rest, std::size_t slot)>& place);

double size_of(const Body& body);    // the longest side of the box around its rest positions [m]
double least_side(const Body& body); // the shortest that is not 0 [m]

// How far it is from its shape at rest: the root mean square, weighed by mass, of what is left after the rigid
// motion that brings it closest (Kabsch 1976) [m].
double distortion(const Body& body);

// What a run went through.
struct Course {
  bool stopped = false; // as unstable; `why` says how
  std::string why;
  long steps = 0;
  double first_energy = 0, least_energy = 0, most_energy = 0; // [J], looked at every `every` steps
};
Course run(Scene& scene, long steps, long every = 1);

bool is_finite(const Scene& scene); // every number of its state

} // namespace rend
