// What contact takes, and what is done through it: entries of the energy account (sim/scene/energy_account.h);
// and how near things came in it.
#pragma once

#include "sim/base/archive.h"

#include <algorithm>
#include <limits>

namespace rend {

struct ContactWork {
  double impact = 0, friction = 0; // [J], lost: along normals, and across them
  double obstacles = 0;            // [J], done by what moves as prescribed: obstacles, and supports of vertices
  bool touched = false;            // there was an impulse or a force
  // [m], at the ends of steps: the smallest distance of what was in contact, negative inside, infinite if
  // nothing was; and the most by which it was less than the distance that contact keeps
  double gap = std::numeric_limits<double>::infinity(), overlap = 0;

  double lost() const { return impact + friction; } // [J]
  ContactWork& operator+=(const ContactWork& other) {
    impact += other.impact;
    friction += other.friction;
    obstacles += other.obstacles;
    touched = touched || other.touched;
    gap = std::min(gap, other.gap);
    overlap = std::max(overlap, other.overlap);
    return *this;
  }
  void store(Archive& archive) {
    archive.unbounded(impact, friction, obstacles, gap);
    archive(touched, overlap);
    refuse_unless(overlap >= 0, "contact keeps more distance than it should");
  }
};

} // namespace rend
