#include "sim/contact/contact_faces.h"

#include "sim/boundary/boundary_triangle.h"

namespace rend {

ContactFaces::ContactFaces(EmbeddedMap& map, Boundary& boundary) : map_(&map), boundary_(&boundary) {
  map.use(FaceOfVolume);
  boundary_->update();
  list();
}

ContactFaces::ContactFaces(const ObstacleSurface& surface) {
  for (const auto& [a, b, c] : surface.triangles)
    triangles_.push_back({{a, b, c}, static_cast<Slot>(triangles_.size())});
}

bool ContactFaces::update() {
  if (!boundary_) return false;
  boundary_->update();
  if (boundary_->revision() == revision_) return false;
  list();
  return true;
}

void ContactFaces::list() {
  revision_ = boundary_->revision();
  triangles_.clear();
  const bool sheet = map_->dimension() == 2;
  boundary_->for_each_face([&](const BoundaryFaces::Face& face, std::span<const Slot> ring) {
    const Slot slot = map_->slot(FaceOfVolume, face.first);
    // The vertex of the smallest dart is the middle of the fan; of a turned face of a sheet it comes last.
    const std::size_t middle = sheet && face.turned ? ring.size() - 1 : 0;
    const auto at = [&](std::uint32_t corner) { return ring[(corner + middle) % ring.size()]; };
    for (std::uint32_t number = 0; number < fan_size(face.sides); ++number) {
      const auto [a, b, c] = fan_corners(number);
      triangles_.push_back({{at(a), at(b), at(c)}, slot});
    }
  });
}

} // namespace rend
