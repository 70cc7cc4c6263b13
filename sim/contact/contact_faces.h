// What others can touch of a body: the faces of its boundary as triangles, those of a solid counter-clockwise
// as seen from outside at rest. Listed anew after edits.
//
// A face becomes a fan around the vertex of its smallest dart, or, where it is walked the other way around,
// around the vertex before that: the diagonals of a quad differ, and the course of a contact with them.
#pragma once

#include "sim/base/bytes.h"
#include "sim/boundary/boundary.h"

#include <array>
#include <vector>

namespace rend {

class ContactFaces {
public:
  ContactFaces(EmbeddedMap& map, Boundary& boundary); // the boundary of the map, which outlives this

  bool update(); // after edits; false: nothing changed since this was last listed

  struct Triangle {
    std::array<Slot, 3> vertex;
    Slot face; // slot of <0,1>
  };
  const std::vector<Triangle>& triangles() const { return triangles_; } // in the order of the boundary
  std::size_t bytes() const { return bytes_of(triangles_); }

private:
  void list();
  const EmbeddedMap& map_;
  Boundary& boundary_;
  long revision_ = 0;               // of the boundary, when this was listed
  std::vector<Triangle> triangles_; // those of a face one after another
};

} // namespace rend
