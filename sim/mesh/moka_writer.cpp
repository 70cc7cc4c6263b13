#include "sim/mesh/moka.h"

#include <fmt/format.h>

namespace rend {

std::string moka_text(const EmbeddedMap& embedded) {
  const GMap& map = embedded.map();
  std::vector<std::uint32_t> number(map.capacity(), 0);
  std::uint32_t next = 0;
  map.for_each_dart([&](Dart d) { number[d.value] = next++; });
  const CellIndex& vertices = embedded.cells(Vertex);
  std::string text = "Moka file [ascii]\n64 7 0 0 0 0 0 0\n";
  map.for_each_dart([&](Dart d) {
    for (int i = 0; i < 4; ++i) text += fmt::format("{} ", number[map.alpha(i, d).value]);
    text += "0 0 0 0 ";
    const Vec3 x = embedded.rest_of(d);
    text +=
        vertices.first_dart(vertices.slot(d)) == d ? fmt::format("1 {} {} {}\n", x.x(), x.y(), x.z()) : "0\n";
  });
  return text;
}

bool is_solid_in_moka(const GMap& map) {
  if (map.dimension() == 3) return true;
  bool closed = true;
  map.for_each_dart([&](Dart d) { closed = closed && !map.is_free(2, d); });
  return closed;
}

} // namespace rend
