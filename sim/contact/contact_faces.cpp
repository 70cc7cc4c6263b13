#include "sim/contact/contact_faces.h"

namespace rend {

ContactFaces::ContactFaces(EmbeddedMap& map, Boundary& boundary) : map_(map), boundary_(boundary) {
  map.use(FaceOfVolume);
  boundary_.update();
  list();
}

bool ContactFaces::update() {
  boundary_.update();
  if (boundary_.revision() == revision_) return false;
  list();
  return true;
}

void ContactFaces::list() {
  revision_ = boundary_.revision();
  triangles_.clear();
  boundary_.for_each_face([&](const BoundaryFaces::Face& face, std::span<const Slot> ring) {
    const Slot slot = map_.slot(FaceOfVolume, face.first);
    const std::size_t n = ring.size(), start = face.turned ? 1 : 0;
    for (std::size_t k = 1; k + 1 < n; ++k)
      triangles_.push_back({{ring[start], ring[(start + k) % n], ring[(start + k + 1) % n]}, slot});
  });
}

} // namespace rend
