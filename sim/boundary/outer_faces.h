// One pass over a map for the faces that lie outside: all faces of a sheet, the α3-free ones of a solid. It is
// for what asks once, or once after each change (patches of loads, wind); a Boundary is brought up to date from
// the places that changed.
#pragma once

#include "sim/embedding/embedded_map.h"

#include <vector>

namespace rend {

// Calls f(slot, its smallest dart) for each of them, by slots of FaceOfVolume, which must be in use.
template <class F> void for_each_outer_face(const EmbeddedMap& map, F&& f) {
  const CellIndex& faces = map.cells(FaceOfVolume);
  for (Slot face = 0; face < faces.slots(); ++face)
    if (faces.alive(face) && map.map().is_free(3, faces.first_dart(face))) f(face, faces.first_dart(face));
}

// The vertices of the face of d, in the order of the walk d → α0 d; reversed if `turned`.
void vertices_of_face(const EmbeddedMap& map, Dart d, bool turned, std::vector<Slot>& out);

} // namespace rend
