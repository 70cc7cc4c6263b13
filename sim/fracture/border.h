// The border between two elements: an edge of a sheet with both its faces, a face of a solid with both its
// volumes; and the direction a tear would open it in.
//
// Faces have three, four or more sides. Unit u of the pattern is a face of u + 3 sides, so that each owner has
// one row, and its key says how many of the fields count.
#pragma once

#include "sim/rows/binder.h"

namespace rend {

class Borders {
public:
  enum class Carry {
    Vertices, // fields 0 .. n − 1: the n vertices of the border
    Corners,  // fields 2k and 2k + 1: corners of its k-th vertex in the two elements; then the vertices
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
  Dart dart(std::size_t key) const { // the smallest
    return map_->cells(binder_.pattern().owner).first_dart(binder_.owner_of(key));
  }

  void rebind(const Changes& changes) { binder_.rebind(changes); }
  void reserve_for_separations() { binder_.reserve_for_separations(); }
  std::size_t bytes() const { return binder_.rows().bytes(); }

private:
  const EmbeddedMap* map_;
  std::size_t first_vertex_ = 0; // field
  Binder binder_;
};

// What a body lacks for criteria on borders: faces with so many sides that no row holds them. Empty: nothing.
std::string lacking_for_borders(const EmbeddedMap& map);

// The unit vector n. Of a sheet, along AB × (n1 + n2), in the sheet and across the edge of d; n1, n2 are the
// unit normals of its faces, made to agree across it (so that it works on a Möbius band); where they cancel, n1
// alone counts. Of a solid, the mean normal of the face of d. Zero where there is no direction.
Vec3 across_border(const EmbeddedMap& map, const Record* position, Dart d);

} // namespace rend
