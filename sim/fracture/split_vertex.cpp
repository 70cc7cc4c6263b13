// Split-vertex: the elements around a vertex are divided by a plane through it (thesis 7.3.3, after O'Brien &
// Hodgins 1999), without cutting any of them:
//
//   side of element e = [(c_e − x)·n ≥ 0],   c_e the mean of its corners
//
// and every border at the vertex between elements of different sides is separated. For an edge, one end is
// split by the plane normal to the edge: the end A with the larger forces of the edge's elements along it, Σ_e
// |f_e,A · u|.
#include "sim/fracture/change.h"

#include "sim/base/check.h"
#include "sim/mechanics/mass.h"
#include "sim/topology/walk.h"

#include <algorithm>
#include <utility>

namespace rend {
namespace {

// The slots of the corners of the darts, without repetition, in increasing order: those before the edit, which
// does not change them.
std::vector<Slot> corners_of(const EmbeddedMap& map, std::span<const Dart> darts) {
  const Orbit corner = corner_orbit(map.dimension());
  std::vector<Slot> slots;
  for (Dart d : darts) slots.push_back(map.slot(corner, d));
  std::sort(slots.begin(), slots.end());
  slots.erase(std::unique(slots.begin(), slots.end()), slots.end());
  return slots;
}

Vec3 centre_of_element(const EmbeddedMap& map, const Record* position, Dart d) {
  const CellIndex& corners = map.cells(corner_orbit(map.dimension()));
  const std::vector<Slot> slots = corners_of(map, darts_of(map.map(), element_orbit(map.dimension()), d));
  Vec3 sum = Vec3::Zero();
  for (Slot c : slots) sum += position[map.vertex(corners.first_dart(c))].vec();
  return sum / static_cast<double>(slots.size());
}

// For every corner at a vertex: whether its element lies on the positive side.
class Sides {
public:
  Sides(const EmbeddedMap& map, std::span<const Dart> darts, const Record* position, const Vec3& normal)
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

// `darts`: of the vertex.
bool split(Edit& edit, const ForceView& view, std::span<const Dart> darts, const Vec3& normal) {
  const GMap& map = edit.map();
  const int link = map.dimension();
  const Sides sides(view.map, darts, view.position, normal);
  bool any = false;
  for (Dart d : darts) {
    if (map.is_free(link, d) || sides.above(d) == sides.above(map.alpha(link, d))) continue;
    unsew(edit, link, d);
    any = true;
  }
  return any;
}

double pull_at(const ForceView& view, std::span<const Dart> end, const Vec3& along) {
  double sum = 0;
  for (Slot c : corners_of(view.map, end)) sum += std::abs(view.corner[c].vec().dot(along));
  return sum;
}

// All darts of the vertices of these darts, in the current map.
std::vector<Dart> vertices_of(const GMap& map, std::span<const Dart> end) {
  std::vector<Dart> all;
  for (Dart d : end) collect(map, Vertex, d, all);
  std::sort(all.begin(), all.end());
  all.erase(std::unique(all.begin(), all.end()), all.end());
  return all;
}

bool split_an_end(Edit& edit, const ForceView& view, std::span<const Dart> edge) {
  CHECK(view.corner);
  std::vector<Dart> first, second; // darts of the edge at each end
  const Slot here = view.map.vertex(edge.front());
  for (Dart d : edge) (view.map.vertex(d) == here ? first : second).push_back(d);
  if (second.empty()) return false; // a loop
  Vec3 along = view.position[view.map.vertex(second.front())].vec() - view.position[here].vec();
  const double length = along.norm();
  if (!(length > 0)) return false;
  along /= length;
  if (pull_at(view, second, along) > pull_at(view, first, along)) std::swap(first, second);
  return split(edit, view, vertices_of(edit.map(), first), along) ||
         split(edit, view, vertices_of(edit.map(), second), along);
}

} // namespace

ChangeType split_vertex() {
  return {"split-vertex",
          "the elements at the vertex part where the plane across the force runs between them; of an edge, "
          "that end "
          "is split which is pulled more, or else the other",
          Cell::Vertices,
          [](Cell cell, int) { return cell == Cell::Vertices || cell == Cell::Edges; },
          [](Cell cell) { return cell == Cell::Edges; },
          [](Edit& edit, const ForceView& view, Cell cell, const Candidate& candidate,
             std::span<const Dart> darts) {
            return cell == Cell::Edges ? split_an_end(edit, view, darts)
                                       : split(edit, view, darts, candidate.normal);
          }};
}

} // namespace rend
