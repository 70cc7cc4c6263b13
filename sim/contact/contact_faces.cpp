#include "sim/contact/contact_faces.h"

#include "sim/mechanics/winding.h"
#include "sim/outside/patch.h"

namespace rend {

ContactFaces::ContactFaces(EmbeddedMap& map) : map_(map) {
  map.use(FaceOfVolume);
  list();
  map.subscribe(changes_);
}

ContactFaces::~ContactFaces() {
  map_.unsubscribe(changes_);
}

bool ContactFaces::update() {
  if (!changes_.any) return false;
  changes_.clear();
  list();
  return true;
}

void ContactFaces::list() {
  triangles_.clear();
  const CellIndex& faces = map_.cells(FaceOfVolume);
  const bool solid = map_.dimension() == 3;
  std::vector<Slot> ring;
  for (Slot face = 0; face < faces.slots(); ++face) {
    if (!faces.alive(face)) continue;
    const Dart d = faces.first_dart(face);
    if (!map_.map().is_free(3, d)) continue;
    vertices_of_face(map_, d, solid && !winds_outward(map_, d), ring);
    for (std::size_t k = 1; k + 1 < ring.size(); ++k)
      triangles_.push_back({{ring[0], ring[k], ring[k + 1]}, face});
  }
}

} // namespace rend
