#include "sim/boundary/boundary.h"

#include "sim/base/check.h"

namespace rend {

Boundary::Boundary(EmbeddedMap& map, const BorderColumn* border) : map_(map), border_(border) {
  if (map.dimension() == 3) {
    solid_.emplace(map, border);
    return;
  }
  map.use(FaceOfVolume);
  sense_ = find_face_sense(map);
  map.subscribe(changes_);
}

Boundary::~Boundary() {
  map_.unsubscribe(changes_);
}

void Boundary::update() {
  if (solid_) {
    revision_ += solid_->update();
    return;
  }
  revision_ += changes_.any;
  if (changes_.any) changes_.clear();
  if (sheet_) sheet_->update();
}

Surface& Boundary::sheet() {
  CHECK(!solid_);
  if (!sheet_) sheet_.emplace(map_, border_);
  return *sheet_;
}

SolidSurface& Boundary::solid() {
  CHECK(solid_.has_value());
  return *solid_;
}

BoundaryFaces::Face Boundary::face_of_sheet(Dart first, std::vector<Slot>& vertices) const {
  const bool turned = is_turned(sense_, map_.slot(FaceOfVolume, first));
  vertices_of_face(map_, first, turned, vertices);
  return {
      .first = first, .turned = turned, .exposed = false, .sides = static_cast<std::uint32_t>(vertices.size())};
}

} // namespace rend
