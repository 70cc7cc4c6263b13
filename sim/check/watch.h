// Operations and measurements of cases on a scene.
#pragma once

#include "sim/check/case.h"

#include <cstdint>

namespace rend {

// Explicit ones that are stable where matter is not damped; or where all of it is, by `drag`.
std::vector<Scheme> explicit_schemes(bool drag = false);

double energy(const Scene& scene); // kinetic, elastic and gravitational [J]

// Adds random velocities of up to `speed` [m/s] along each axis, to free coordinates.
void shake(Body& body, double speed, std::uint64_t seed);

// Removes the rigid body motion, translation and rotation, from the velocities of the body.
void stop_as_a_whole(Body& body);

// Puts every vertex where `place` maps its rest position [m]; prescribed ones return at the next step.
void put(Body& body, const std::function<Vec3(const Vec3& rest, std::size_t slot)>& place);

double size_of(const Body& body);    // the longest side of the bounding box of its rest positions [m]
double least_side(const Body& body); // the shortest side that is not 0 [m]

// The distance from its rest shape: the mass-weighted root mean square of the difference after the best rigid
// motion (Kabsch 1976) [m].
double distortion(const Body& body);

// Of the centre of mass.
Vec3 mean_velocity(const Body& body); // [m/s]
Vec3 mean_way(const Body& body);      // [m], since it was at rest

double rms_speed(const Scene& scene); // [m/s], by mass

// The course of a run.
struct Course {
  bool stopped = false; // as unstable; reason in `why`
  std::string why;
  long steps = 0;
  double first_energy = 0, least_energy = 0, most_energy = 0; // [J], sampled every `every` steps
};
Course run(Scene& scene, long steps, long every = 1);

void go_to(Scene& scene, double time); // [s]: the first state at or after it

bool is_finite(const Scene& scene); // every number of its state

} // namespace rend
