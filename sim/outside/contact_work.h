// What contact takes, and what is done through it: entries of the energy account (sim/scene/energy_account.h).
#pragma once

#include "sim/base/archive.h"

namespace rend {

struct ContactWork {
  double impact = 0, friction = 0; // [J], lost: along normals, and across them
  double obstacles = 0;            // [J], done by what moves as prescribed: obstacles, and supports of vertices
  bool touched = false;            // there was an impulse or a force

  double lost() const { return impact + friction; } // [J]
  ContactWork& operator+=(const ContactWork& other) {
    impact += other.impact;
    friction += other.friction;
    obstacles += other.obstacles;
    touched = touched || other.touched;
    return *this;
  }
  void store(Archive& archive) {
    archive.unbounded(impact, friction, obstacles);
    archive(touched);
  }
};

} // namespace rend
