// Solids for tests of their surface: bodies of cells without mechanics, and the same cells as index lists.
#pragma once

#include "sim/body/body.h"
#include "sim/mesh/bar.h"
#include "sim/mesh/tube.h"

#include <cmath>
#include <memory>
#include <string>
#include <vector>

namespace rend::solids {

inline CellMesh bar(BarPattern pattern, int nx, int ny, int nz) {
  return bar_cells({pattern, nx, ny, nz, Vec3(nx, ny, nz)});
}

constexpr std::array<BarPattern, 4> all_patterns{BarPattern::Hexahedra, BarPattern::Tetrahedra,
                                                 BarPattern::Prisms, BarPattern::Mixed};

// A cube of cells mapped smoothly onto a ball of radius 1 (Nowell's map): the cube's surface becomes the
// sphere.
inline CellMesh ball(BarPattern pattern, int cells) {
  CellMesh mesh = bar(pattern, cells, cells, cells);
  for (Vec3& x : mesh.points) {
    const Vec3 c = x * (2.0 / cells) - Vec3::Ones(), s = c.cwiseProduct(c);
    for (int i = 0; i < 3; ++i) {
      const double a = s[(i + 1) % 3], b = s[(i + 2) % 3];
      x[i] = c[i] * std::sqrt(1 - a / 2 - b / 2 + a * b / 3);
    }
  }
  return mesh;
}

struct Named {
  std::string name;
  CellMesh mesh;
};

inline std::vector<Named> all() {
  return {
      {"hexahedra", bar(BarPattern::Hexahedra, 3, 2, 2)}, {"tetrahedra", bar(BarPattern::Tetrahedra, 2, 2, 2)},
      {"prisms", bar(BarPattern::Prisms, 3, 2, 2)},       {"mixed", bar(BarPattern::Mixed, 4, 2, 2)},
      {"tube", tube_cells({8, 4, Vec3(1, 1, 2), 0.2})},   {"ball", ball(BarPattern::Tetrahedra, 4)}};
}

// With a column that records initial borders, as for bodies that can tear.
inline std::unique_ptr<Body> body(std::unique_ptr<EmbeddedMap> map, bool tears = true) {
  auto made = std::make_unique<Body>();
  made->map = std::move(map);
  if (tears) made->border = &made->map->add(InitialBorder(3));
  return made;
}
inline std::unique_ptr<Body> body(const CellMesh& mesh, bool tears = true) {
  return body(solid_from(mesh), tears);
}

} // namespace rend::solids
