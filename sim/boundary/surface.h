// The surface of a sheet: triangles of its faces, with the edges of cells marked, and normals. (For solids:
// solid_surface.h.)
//
// Rows are bound like those of the program (packed_rows.h), with the face slot as key, rebuilt only where the
// map changed, and equal byte for byte to a full rebuild. Positions and normals are read from the state when a
// picture is made.
//
// A face becomes a fan around its first dart's vertex; only its own sides are drawn as lines, so that a quad
// shows as a quad. A vertex normal is the sum over its element corners of (even end − v) × (odd end − v), where
// the darts around the vertex are alternately even and odd from its smallest dart on: the corners are then
// oriented consistently without an orientation of the whole, on a Möbius band as well.
#pragma once

#include "sim/boundary/face_sense.h"
#include "sim/embedding/initial_border.h"
#include "sim/boundary/line_kind.h"
#include "sim/rows/packed_rows.h"

namespace rend {

class Surface {
public:
  Surface(EmbeddedMap& map, const BorderColumn* border); // CHECK: a sheet. border: null if the body cannot tear
  ~Surface();
  Surface(const Surface&) = delete;
  Surface& operator=(const Surface&) = delete;

  void update(); // after edits; does nothing if there were none

  struct Triangle {
    std::array<Slot, 3> vertex;
    std::array<LineKind, 3> side; // opposite to vertex k
    Slot face;                    // slot of <0,1>
  };
  std::size_t triangles() const { return triangles_.live_count(); }

  // Calls f(Triangle) in the order of rows.
  template <class F> void for_each_triangle(F&& f) const {
    triangles_.for_each([&](std::size_t, std::size_t row) {
      const std::uint32_t sides = triangles_.index(3)[row];
      f(Triangle{{triangles_.index(0)[row], triangles_.index(1)[row], triangles_.index(2)[row]},
                 {static_cast<LineKind>(sides & 3), static_cast<LineKind>(sides >> 2 & 3),
                  static_cast<LineKind>(sides >> 4 & 3)},
                 triangles_.index(4)[row]});
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
};

} // namespace rend
