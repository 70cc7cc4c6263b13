// Split-vertex: the elements around a vertex are divided by a plane through it (thesis 7.3.3, after O'Brien &
// Hodgins 1999), without cutting any of them:
//
//   side of element e = [(c_e − x)·n ≥ 0],   c_e the mean of its corners
//
// and every border at the vertex between elements of different sides is separated.
#include "sim/fracture/split_vertex.h"

#include "sim/base/check.h"
#include "sim/fracture/piece.h"
#include "sim/mechanics/mass.h"
#include "sim/topology/walk.h"

#include <algorithm>
#include <map>

namespace rend {
namespace {

Vec3 centre_of_element(const EmbeddedMap& map, const Record* position, Dart d) {
  const CellIndex& corners = map.cells(corner_orbit(map.dimension()));
  const std::vector<Slot> slots = corners_of(map, darts_of(map.map(), element_orbit(map.dimension()), d));
  Vec3 sum = Vec3::Zero();
  for (Slot c : slots) sum += position[map.vertex(corners.first_dart(c))].vec();
  return sum / static_cast<double>(slots.size());
}

// For every corner at a vertex: whether its element lies on the positive side; where pieces are given, of
// elements of one piece all do, or none.
class CornerSides {
public:
  CornerSides(const EmbeddedMap& map, std::span<const Dart> darts, const Record* position, const Vec3& normal,
              const PieceColumn* pieces = nullptr)
      : map_(map), corner_(corner_orbit(map.dimension())), slots_(corners_of(map, darts)) {
    const Vec3 here = position[map.vertex(darts.front())];
    for (Slot c : slots_) {
      const Dart d = map.cells(corner_).first_dart(c);
      heights_.push_back((centre_of_element(map, position, d) - here).dot(normal));
    }
    if (pieces) by_pieces(*pieces);
    for (const double height : heights_) above_.push_back(height >= 0);
  }
  bool above(Dart d) const {
    const auto at = std::lower_bound(slots_.begin(), slots_.end(), map_.slot(corner_, d));
    return above_[static_cast<std::size_t>(at - slots_.begin())];
  }

private:
  // The mean of each piece takes the place of the heights of its elements.
  void by_pieces(const PieceColumn& pieces) {
    std::map<std::uint32_t, std::pair<double, int>> sums;
    const auto sum_of_corner = [&](std::size_t n) -> std::pair<double, int>& {
      return sums[pieces[map_.slot(pieces.orbit(), map_.cells(corner_).first_dart(slots_[n]))]];
    };
    for (std::size_t n = 0; n < slots_.size(); ++n) {
      auto& [sum, count] = sum_of_corner(n);
      sum += heights_[n];
      ++count;
    }
    for (std::size_t n = 0; n < slots_.size(); ++n)
      heights_[n] = sum_of_corner(n).first / sum_of_corner(n).second;
    const auto [low, high] = std::ranges::minmax(heights_);
    const double plane = low < 0 && high >= 0 ? 0 : (low + high) / 2;
    for (double& height : heights_) height -= plane;
  }

  const EmbeddedMap& map_;
  Orbit corner_;
  std::vector<Slot> slots_;
  std::vector<double> heights_; // [m], of the middle of each element above the plane
  std::vector<bool> above_;
};

// Whether a border at the vertex parts elements of different sides. d: one of the vertex's darts there.
bool is_across(const GMap& map, const CornerSides& sides, Dart d) {
  const int link = map.dimension();
  return !map.is_free(link, d) && sides.above(d) != sides.above(map.alpha(link, d));
}

// `darts`: of the vertex.
bool split(Edit& edit, const CornerSides& sides, std::span<const Dart> darts) {
  bool any = false;
  for (Dart d : darts) {
    if (!is_across(edit.map(), sides, d)) continue;
    unsew(edit, edit.map().dimension(), d);
    any = true;
  }
  return any;
}

// Elements with these darts that were made or divided in this edit have no place of before.
bool has_new_elements(const Edit& edit, std::span<const Dart> darts) {
  const Orbit element = element_orbit(edit.map().dimension());
  return std::ranges::any_of(darts, [&](Dart d) {
    return std::ranges::any_of(darts_of(edit.map(), element, d), [&](Dart e) { return edit.is_new(e); });
  });
}

} // namespace

bool can_be_split(const ForceView& view, const FoundPlace& found, std::span<const Dart> darts) {
  const CornerSides sides(view.map, darts, view.position, found.normal);
  return std::any_of(darts.begin(), darts.end(), [&](Dart d) { return is_across(view.map.map(), sides, d); });
}

bool part_pieces(Edit& edit, const ForceView& view, const FoundPlace& found, std::span<const Dart> darts) {
  if (has_new_elements(edit, darts)) return false;
  const PieceColumn* const pieces = find_pieces(view.map);
  CHECK(pieces);
  return split(edit, CornerSides(view.map, darts, view.position, found.normal, pieces), darts);
}

bool parts_pieces(const Edit& edit, const ForceView& view, std::span<const Dart> darts) {
  const PieceColumn* const pieces = find_pieces(view.map);
  return pieces && !has_new_elements(edit, darts) && is_at_wall(view.map, *pieces, darts);
}

ChangeType split_vertex() {
  return {.name = "split-vertex",
          .what = "the elements at the vertex are separated into two groups, on either side of the plane "
                  "across the force",
          .cell = Cell::Vertices,
          .apply =
              [](Edit& edit, const ForceView& view, const FoundPlace& found, std::span<const Dart> darts) {
                return split(edit, CornerSides(view.map, darts, view.position, found.normal), darts);
              },
          .keeps_matter = true};
}

} // namespace rend
