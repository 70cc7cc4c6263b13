// What others can touch of a body: its α3-free faces as triangles, each face a fan around the vertex of its
// first dart (as it is drawn), those of a solid counter-clockwise as seen from outside at rest. Listed anew
// after edits.
#pragma once

#include "sim/base/bytes.h"
#include "sim/embedding/embedded_map.h"

#include <array>
#include <vector>

namespace rend {

class ContactFaces {
public:
  explicit ContactFaces(EmbeddedMap& map);
  ~ContactFaces();
  ContactFaces(const ContactFaces&) = delete;
  ContactFaces& operator=(const ContactFaces&) = delete;

  bool update(); // after edits; false: nothing changed

  struct Triangle {
    std::array<Slot, 3> vertex;
    Slot face; // slot of <0,1>
  };
  const std::vector<Triangle>& triangles() const { return triangles_; } // by increasing face
  std::size_t bytes() const { return bytes_of(triangles_); }

private:
  void list();
  EmbeddedMap& map_;
  Changes changes_;
  std::vector<Triangle> triangles_; // by increasing face slot, a face's own one after another
};

} // namespace rend
