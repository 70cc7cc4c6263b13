// The surface of a sheet: triangles of its faces, with the edges of cells marked, and normals. (For solids:
// solid_surface.h.)
//
// Rows are bound like those of the program (packed_rows.h), with the face slot as key, rebuilt only where the
// map changed, and equal byte for byte to a full rebuild. Positions and normals are read from the state when a
// picture is made.
//
// The fan of a face (boundary_triangle.h) is around the vertex of its smallest dart, and goes as its front is
// walked. A vertex normal is the sum over its element corners of (even end − v) × (odd end − v), where the
// darts around the vertex are alternately even and odd from its smallest dart on: the corners are then oriented
// consistently without an orientation of the whole, on a Möbius band as well.
#pragma once

#include "sim/boundary/boundary_triangle.h"
#include "sim/boundary/face_sense.h"
#include "sim/embedding/initial_border.h"
#include "sim/rows/packed_rows.h"

namespace rend {

class Surface {
public:
  Surface(EmbeddedMap& map, const BorderColumn* border); // CHECK: a sheet. border: null if the body cannot tear
  ~Surface();
  Surface(const Surface&) = delete;
  Surface& operator=(const Surface&) = delete;

  void update(); // after edits; does nothing if there were none

  std::size_t triangles() const { return triangles_.live_count(); }

  // Calls f(BoundaryTriangle) in the order of rows.
  template <class F> void for_each_triangle(F&& f) const {
    const EmbeddedMap& map = map_;
    const CellIndex& faces = map.cells(FaceOfVolume);
    triangles_.for_each([&](std::size_t key, std::size_t row) {
      const std::array<Slot, 3> vertex{triangles_.index(0)[row], triangles_.index(1)[row],
                                       triangles_.index(2)[row]};
      const std::uint32_t sides = triangles_.index(3)[row];
      const Slot face = triangles_.index(4)[row];
      f(BoundaryTriangle{.vertex = vertex,
                         .normal = vertex,
                         .side = {static_cast<LineKind>(sides & 3), static_cast<LineKind>(sides >> 2 & 3),
                                  static_cast<LineKind>(sides >> 4 & 3)},
                         .first = faces.first_dart(face),
                         .number = static_cast<std::uint32_t>(key - face * fan_),
                         .turned = is_turned(sense_, face),
                         .exposed = false});
    });
  }

  // Normals of the current state, unit or 0, one per vertex slot. Their sign is arbitrary at each vertex:
  // within a triangle they must be flipped to its side.
  void normals(std::vector<Vec3>& out) const;

  std::size_t bytes() const { return triangles_.bytes() + corners_.bytes(); }
  bool same_as(const Surface& other) const {
    return triangles_.same_as(other.triangles_) && corners_.same_as(other.corners_);
  }

private:
  void rebuild();
  void collect_sides(Slot face);
  void write_face(Slot face);
  void write_corners(Slot vertex);
  LineKind line_kind_of(Dart d) const;
  std::size_t most_sides() const;

  EmbeddedMap& map_;
  const BorderColumn* border_;
  const Column<FaceSense>* sense_; // null: fronts are walked from smallest darts
  std::size_t fan_ = 0;            // triangles reserved per face: those of the face with the most sides
  std::size_t full_ = 0;           // number of faces that need all of them
  PackedRows triangles_;           // key: face slot × fan_ + n; vertices, sides, face
  PackedRows corners_;             // key: corner slot; vertex, even end, odd end
  Changes changes_;
  std::vector<Dart> sides_; // scratch: of one face, the darts that start its sides
};

} // namespace rend
