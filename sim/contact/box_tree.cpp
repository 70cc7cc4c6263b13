#include "sim/contact/box_tree.h"

namespace rend {
namespace {

constexpr std::uint32_t leaf = 4; // boxes in a leaf, at most

// The lowest 21 bits of a number, each followed by two zeros.
std::uint64_t spread(std::uint64_t bits) {
  bits = (bits | bits << 32U) & 0x1f00000000ffffU;
  bits = (bits | bits << 16U) & 0x1f0000ff0000ffU;
  bits = (bits | bits << 8U) & 0x100f00f00f00f00fU;
  bits = (bits | bits << 4U) & 0x10c30c30c30c30c3U;
  return (bits | bits << 2U) & 0x1249249249249249U;
}

// How far along the curve a point lies, from 0 to 1 in each direction.
std::uint64_t along_curve(const Vec3& at) {
  std::uint64_t place = 0;
  for (int axis = 0; axis < 3; ++axis) {
    constexpr double cells = (1U << 21U) - 1;
    const double cell = std::min(std::max(cells * at[axis], 0.0), cells); // 0 if it is not a number
    place |= spread(static_cast<std::uint64_t>(cell)) << static_cast<unsigned>(axis);
  }
  return place;
}

} // namespace

BoxTree::BoxTree(const std::vector<Box>& boxes) {
  if (boxes.empty()) return;
  Box all;
  for (const Box& box : boxes) all.extend(box);
  const Vec3 size = all.sizes().cwiseMax(1e-300);
  struct Place {
    std::uint64_t along;
    std::uint32_t index;
    bool operator<(const Place& other) const {
      return along != other.along ? along < other.along : index < other.index;
    }
  };
  std::vector<Place> places;
  places.reserve(boxes.size());
  for (const Box& box : boxes)
    places.push_back({along_curve((box.center() - all.min()).cwiseQuotient(size)),
                      static_cast<std::uint32_t>(places.size())});
  std::sort(places.begin(), places.end());
  index_.reserve(places.size());
  boxes_.reserve(places.size());
  nodes_.reserve(places.size());
  for (const Place& place : places) {
    index_.push_back(place.index);
    boxes_.push_back(boxes[place.index]);
  }
  add(0, static_cast<std::uint32_t>(places.size()));
}

void BoxTree::add(std::uint32_t begin, std::uint32_t end) {
  const std::size_t here = nodes_.size();
  nodes_.emplace_back();
  Box box;
  if (end - begin <= leaf) {
    for (std::uint32_t k = begin; k < end; ++k) box.extend(boxes_[k]);
    nodes_[here].begin = begin;
    nodes_[here].end = end;
  } else {
    const std::uint32_t middle = begin + (end - begin) / 2;
    for (const auto& [from, to] : {std::pair(begin, middle), std::pair(middle, end)}) {
      const std::size_t child = nodes_.size();
      add(from, to);
      box.extend(nodes_[child].box);
    }
  }
  nodes_[here].box = box;
  nodes_[here].next = static_cast<std::uint32_t>(nodes_.size());
}

} // namespace rend
