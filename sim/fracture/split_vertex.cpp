// Split-vertex: the elements around a vertex are divided by a plane through it (thesis 7.3.3, after O'Brien &
// Hodgins 1999), without cutting any of them:
//
//   side of element e = [(c_e − x)·n ≥ 0],   c_e the mean of its corners
//
// and every border at the vertex between elements of different sides is separated.
#include "sim/fracture/split_vertex.h"

#include "sim/mechanics/mass.h"
#include "sim/topology/walk.h"

#include <algorithm>

namespace rend {
namespace {

Vec3 centre_of_element(const EmbeddedMap& map, const Record* position, Dart d) {
  const CellIndex& corners = map.cells(corner_orbit(map.dimension()));
  const std::vector<Slot> slots = corners_of(map, darts_of(map.map(), element_orbit(map.dimension()), d));
  Vec3 sum = Vec3::Zero();
  for (Slot c : slots) sum += position[map.vertex(corners.first_dart(c))].vec();
  return sum / static_cast<double>(slots.size());
}

// For every corner at a vertex: whether its element lies on the positive side.
class CornerSides {
public:
  CornerSides(const EmbeddedMap& map, std::span<const Dart> darts, const Record* position, const Vec3& normal)
      : map_(map), corner_(corner_orbit(map.dimension())), slots_(corners_of(map, darts)) {
    const Vec3 here = position[map.vertex(darts.front())];
    for (Slot c : slots_) {
      const Dart d = map.cells(corner_).first_dart(c);
      above_.push_back((centre_of_element(map, position, d) - here).dot(normal) >= 0);
    }
  }
  bool above(Dart d) const {
    const auto at = std::lower_bound(slots_.begin(), slots_.end(), map_.slot(corner_, d));
    return above_[static_cast<std::size_t>(at - slots_.begin())];
  }

private:
  const EmbeddedMap& map_;
  Orbit corner_;
  std::vector<Slot> slots_;
  std::vector<bool> above_;
};

// Whether a border at the vertex parts elements of different sides. d: one of the vertex's darts there.
bool is_across(const GMap& map, const CornerSides& sides, Dart d) {
  const int link = map.dimension();
  return !map.is_free(link, d) && sides.above(d) != sides.above(map.alpha(link, d));
}

// `darts`: of the vertex.
bool split(Edit& edit, const ForceView& view, std::span<const Dart> darts, const Vec3& normal) {
  const CornerSides sides(view.map, darts, view.position, normal);
  bool any = false;
  for (Dart d : darts) {
    if (!is_across(edit.map(), sides, d)) continue;
    unsew(edit, edit.map().dimension(), d);
    any = true;
  }
  return any;
}

} // namespace

bool can_be_split(const ForceView& view, const FoundPlace& found, std::span<const Dart> darts) {
  const CornerSides sides(view.map, darts, view.position, found.normal);
  return std::any_of(darts.begin(), darts.end(), [&](Dart d) { return is_across(view.map.map(), sides, d); });
}

ChangeType split_vertex() {
  return {.name = "split-vertex",
          .what = "the elements at the vertex are separated into two groups, on either side of the plane "
                  "across the force",
          .cell = Cell::Vertices,
          .apply = [](Edit& edit, const ForceView& view, const FoundPlace& found,
                      std::span<const Dart> darts) { return split(edit, view, darts, found.normal); },
          .keeps_matter = true};
}

} // namespace rend
