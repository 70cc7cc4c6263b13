#include "sim/mesh/dart_order.h"

#include "sim/topology/walk.h"

#include <algorithm>

namespace rend {

std::vector<Dart> darts_in_shape_order(const GMap& map, const CellShape& shape, Dart d) {
  std::vector<Dart> image(static_cast<std::size_t>(shape.darts));
  std::vector<std::size_t> reached{0};
  image[0] = d;
  for (std::size_t n = 0; n < reached.size(); ++n) {
    const std::size_t at = reached[n];
    const std::array<std::size_t, 3> links{at ^ 1u, shape.alpha1[at], shape.alpha2[at]};
    for (int i = 0; i < 3; ++i) {
      Dart& there = image[links[static_cast<std::size_t>(i)]];
      const Dart wanted = map.alpha(i, image[at]);
      if (!there) {
        there = wanted;
        reached.push_back(links[static_cast<std::size_t>(i)]);
      } else if (there != wanted) {
        return {};
      }
    }
  }
  std::vector<Dart> sorted = image; // a cell sewn to itself may give only some of its darts, repeated
  std::sort(sorted.begin(), sorted.end());
  return std::adjacent_find(sorted.begin(), sorted.end()) == sorted.end() ? image : std::vector<Dart>();
}

namespace {

bool right_handed(const MapMesh& mesh, Dart d) {
  const auto at = [&](const char* word) -> const Vec3& {
    return mesh.points[mesh.point[mesh.map.follow(d, std::string_view(word)).value]];
  };
  return (at("0") - at("")).cross(at("10") - at("")).dot(at("210") - at("")) > 0;
}

// Orders the darts of one volume, which are given in increasing order.
void order_cell(const MapMesh& mesh, std::vector<Dart>& darts) {
  for (const CellShape& shape : cell_shapes::all) {
    if (static_cast<std::size_t>(shape.darts) != darts.size()) continue;
    for (const Dart d : darts) {
      if (!right_handed(mesh, d)) continue;
      std::vector<Dart> image = darts_in_shape_order(mesh.map, shape, d);
      if (image.empty()) continue;
      darts = std::move(image);
      return;
    }
  }
}

} // namespace

std::vector<Dart> cell_order(const MapMesh& mesh) {
  std::vector<Dart> order, darts;
  std::vector<char> done(mesh.map.capacity(), 0);
  mesh.map.for_each_dart([&](Dart d) {
    if (done[d.value]) return;
    darts.clear();
    collect(mesh.map, Volume, d, darts);
    std::sort(darts.begin(), darts.end());
    for (const Dart e : darts) done[e.value] = 1;
    order_cell(mesh, darts);
    order.insert(order.end(), darts.begin(), darts.end());
  });
  return order;
}

MapMesh renumbered(const MapMesh& mesh, const std::vector<Dart>& order) {
  std::vector<std::uint32_t> number(mesh.map.capacity());
  for (std::uint32_t n = 0; n < order.size(); ++n) number[order[n].value] = n;
  MapMesh out{mesh.points, GMap(mesh.map.dimension()), {}};
  MapEdit edit(out.map);
  for (const Dart d : order) {
    edit.add_dart();
    out.point.push_back(mesh.point[d.value]);
  }
  for (std::uint32_t n = 0; n < order.size(); ++n)
    for (int i = 0; i < 4; ++i) {
      const std::uint32_t other = number[mesh.map.alpha(i, order[n]).value];
      if (n < other) edit.link(i, Dart{n}, Dart{other});
    }
  return out;
}

} // namespace rend
