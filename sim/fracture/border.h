// The border between two elements: an edge of a sheet with both its faces, a face of a solid with both its
// volumes; and the direction in which a tear would open it.
//
// Faces have three, four or more sides. Unit u of the pattern is a face of u + 3 sides, so that each owner has
// one row, whose key determines how many of the index columns are used.
#pragma once

#include "sim/rows/binder.h"

namespace rend {

class Borders {
public:
  enum class Carry {
    Vertices, // columns 0 .. n − 1: the n vertices of the border
    Corners,  // columns 2k and 2k + 1: corners of its k-th vertex in the two elements; then the vertices
  };
  // CHECK: no face has too many sides (lacking_for_borders).
  Borders(EmbeddedMap& map, Carry carry);

  const PackedRows& rows() const { return binder_.rows(); }
  const std::uint32_t* vertex(std::size_t k) const { // one per row
    return rows().index(static_cast<int>(first_vertex_ + k));
  }
  const std::uint32_t* corner(std::size_t k, std::size_t element) const {
    return rows().index(static_cast<int>(2 * k + element));
  }
  bool of_sheet() const { return binder_.pattern().owner == EdgeOfVolume; }
  std::size_t vertices(std::size_t key) const {
    return of_sheet() ? 2 : key % binder_.pattern().units.size() + 3;
  }
  Dart dart(std::size_t key) const { // its smallest dart
    return map_->cells(binder_.pattern().owner).first_dart(binder_.owner_of(key));
  }

  void rebind(const Changes& changes) { binder_.rebind(changes); }
  void reserve_for_separations() { binder_.reserve_for_separations(); }
  std::size_t bytes() const { return binder_.rows().bytes(); }

private:
  const EmbeddedMap* map_;
  std::size_t first_vertex_ = 0; // column
  Binder binder_;
};

// Why the body cannot have criteria on borders: faces with more sides than a row can hold. Empty: it can.
std::string lacking_for_borders(const EmbeddedMap& map);

// The unit vector n. For a sheet, along AB × (n1 + n2), in the sheet and normal to the edge of d; n1, n2 are
// the unit normals of its faces, oriented consistently across the edge (also on a Möbius band); if their sum
// vanishes, n1 alone is used. For a solid, the mean normal of the face of d. Zero if there is no direction.
Vec3 across_border(const EmbeddedMap& map, const Record* position, Dart d);

} // namespace rend
