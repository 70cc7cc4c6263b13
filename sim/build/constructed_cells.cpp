#include "sim/build/constructed_cells.h"

#include "sim/mesh/cell_shapes.h"
#include "sim/mesh/dart_order.h"
#include "sim/topology/orientation.h"
#include "sim/topology/walk.h"

#include <fmt/format.h>

namespace rend {
namespace {

bool is_standard(const GMap& map, Dart d) {
  const std::size_t darts = darts_of(map, Volume, d).size();
  for (const CellShape& shape : cell_shapes::all) {
    if (static_cast<std::size_t>(shape.darts) != darts) continue;
    for (Dart e : darts_of(map, Volume, d))
      if (!darts_in_shape_order(map, shape, e).empty()) return true;
  }
  return false;
}

std::string place_of(const MapMesh& mesh, Dart d) {
  const Vec3& x = mesh.points[mesh.point[d.value]];
  return fmt::format("({:.4g}, {:.4g}, {:.4g})", x.x(), x.y(), x.z());
}

bool is_open(const GMap& map, Dart d) {
  return map.is_free(0, d) || map.is_free(1, d) || (map.dimension() == 3 && map.is_free(2, d));
}

} // namespace

bool has_open_cells(const GMap& map) {
  bool open = false;
  map.for_each_dart([&](Dart d) { open = open || is_open(map, d); });
  return open;
}

void check_cells(const MapMesh& mesh, const SettingsSource& shape, const std::optional<OpenedBy>& opened) {
  const GMap& map = mesh.map;
  if (map.dart_count() == 0) shape.fail("", "its rules leave nothing of the body");
  map.for_each_dart([&](Dart d) {
    if (!is_open(map, d)) return;
    const char* what = map.is_free(0, d) || map.is_free(1, d) ? "a face" : "a volume";
    (opened ? opened->source : shape)
        .fail("",
              fmt::format("{} {} open, near {}",
                          opened ? opened->rule + " leaves" : std::string("its rules leave"), what,
                          place_of(mesh, d)),
              "where a link of the hook is free, as at a border, what it becomes is free as well");
  });
  const CellIndex elements(map, element_orbit(map.dimension()));
  for (Slot e = 0; e < elements.slots(); ++e) {
    const Dart d = elements.first_dart(e);
    if (map.dimension() == 2 ? sides_of_face(map, d) >= 3 : is_standard(map, d)) continue;
    shape.fail("",
               fmt::format("after its rules, {}, near {}",
                           map.dimension() == 2 ? "a face has fewer than three sides"
                                                : "a volume is none of the standard ones",
                           place_of(mesh, d)),
               "a sheet has faces, a solid tetrahedra, hexahedra, prisms and pyramids");
  }
}

std::vector<Dart> face_order(const GMap& map) {
  std::vector<Dart> order;
  std::vector<bool> done(map.capacity());
  const Sides sides = sides_of(map);
  map.for_each_dart([&](Dart d) {
    if (done[d.value]) return;
    for (Dart at = sides.of_dart[d.value] == 1 ? d : map.alpha(1, d); !done[at.value];
         at = map.alpha(1, order.back()))
      for (Dart e : {at, map.alpha(0, at)}) {
        order.push_back(e);
        done[e.value] = true;
      }
  });
  return order;
}

} // namespace rend
