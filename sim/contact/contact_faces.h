// What others can touch of a body: the faces of its boundary as triangles, those of a solid counter-clockwise
// as seen from outside at rest. Listed anew after edits. Those of a mesh obstacle are its triangles.
//
// A face becomes the same triangles as where it is drawn and exported (boundary_triangle.h): what is seen is
// what is kept apart.
//
// Searches go through all triangles, so each is kept to 16 bytes, four to a cache line: what is read to draw
// one is not here.
#pragma once

#include "sim/base/bytes.h"
#include "sim/boundary/boundary.h"
#include "sim/outside/mesh_obstacle.h"

#include <array>
#include <vector>

namespace rend {

class ContactFaces {
public:
  ContactFaces(EmbeddedMap& map, Boundary& boundary); // the boundary of the map, which outlives this
  explicit ContactFaces(const ObstacleSurface& surface);

  bool update(); // after edits; false: nothing changed since this was last listed

  struct Triangle {
    std::array<Slot, 3> vertex;
    Slot face; // slot of <0,1>; of an obstacle the index of its triangle
  };
  static_assert(sizeof(Triangle) == 16);
  const std::vector<Triangle>& triangles() const { return triangles_; } // in the order of the boundary
  std::size_t bytes() const { return bytes_of(triangles_); }

private:
  void list();
  const EmbeddedMap* map_ = nullptr; // null: of an obstacle
  Boundary* boundary_ = nullptr;
  long revision_ = 0;               // of the boundary, when this was listed
  std::vector<Triangle> triangles_; // those of a face one after another
};

} // namespace rend
