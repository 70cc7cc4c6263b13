#include "sim/boundary/boundary_faces.h"

namespace rend {

void BoundaryFaces::resize(std::size_t darts) {
  const std::size_t blocks = (darts + block_size - 1) / block_size;
  if (blocks > blocks_.size()) blocks_.resize(blocks);
}

BoundaryFaces::Place BoundaryFaces::place_of(const Block& block, Dart first) const {
  Place place{0, 0};
  while (place.face < block.faces.size() && block.faces[place.face].first < first)
    place.corner += block.faces[place.face++].sides;
  return place;
}

void BoundaryFaces::set(const Face& face, std::span<const Corner> corners) {
  erase(face.first);
  Block& block = blocks_[face.first.value / block_size];
  const Place place = place_of(block, face.first);
  block.faces.insert(block.faces.begin() + static_cast<std::ptrdiff_t>(place.face), face);
  block.corners.insert(block.corners.begin() + static_cast<std::ptrdiff_t>(place.corner), corners.begin(),
                       corners.end());
  ++faces_;
  corners_ += corners.size();
}

bool BoundaryFaces::erase(Dart first) {
  if (first.value / block_size >= blocks_.size()) return false;
  Block& block = blocks_[first.value / block_size];
  const Place place = place_of(block, first);
  if (place.face == block.faces.size() || block.faces[place.face].first != first) return false;
  const std::size_t sides = block.faces[place.face].sides;
  const auto begin = block.corners.begin() + static_cast<std::ptrdiff_t>(place.corner);
  block.corners.erase(begin, begin + static_cast<std::ptrdiff_t>(sides));
  block.faces.erase(block.faces.begin() + static_cast<std::ptrdiff_t>(place.face));
  --faces_;
  corners_ -= sides;
  return true;
}

BoundaryFaces::Found BoundaryFaces::find(Dart first) {
  Block& block = blocks_[first.value / block_size];
  const Place place = place_of(block, first);
  if (place.face == block.faces.size() || block.faces[place.face].first != first) return {};
  const Face& face = block.faces[place.face];
  return {&face, {block.corners.data() + place.corner, face.sides}};
}

std::size_t BoundaryFaces::bytes() const {
  std::size_t total = blocks_.size() * sizeof(Block);
  for (const Block& block : blocks_)
    total += block.faces.size() * sizeof(Face) + block.corners.size() * sizeof(Corner);
  return total;
}

} // namespace rend
