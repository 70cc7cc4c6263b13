// What holds between a body and each thing that it may touch.
//
//   an obstacle    of a <contact> that names it; else the obstacle's own; else of the body's <contact>
//   another body   of a <contact> of either that names the other; else the larger of both
//   its fragments  of its <contact>
//
// It is found once, when all bodies are there (sim/contact/contact_names.h).
#pragma once

#include <vector>

namespace rend {

struct ContactTerms {
  double friction = 0, restitution = 0; // coefficients
  bool excluded = false;                // they pass through each other
};

struct ContactTable {
  std::vector<ContactTerms> obstacles; // by their numbers in the world
  std::vector<ContactTerms> bodies;    // one per body of the scene; of itself: between its fragments

  bool excludes_obstacle(std::size_t number) const {
    return number < obstacles.size() && obstacles[number].excluded;
  }
  bool excludes_body(std::size_t number) const { return number < bodies.size() && bodies[number].excluded; }
};

} // namespace rend
