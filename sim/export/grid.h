// The state of a scene as an unstructured grid: points, cells, and numbers on both, for those who look at it or
// reckon with it elsewhere. All bodies are in one grid, one after another in the order of the preset.
//
// A point is a vertex that is alive, so that a tear that parts a vertex makes two points of it. A cell is an
// element: hexahedra stay hexahedra. Corners stand as in sim/mesh/cell_shapes.h (Gmsh's order), so that at rest
// every solid cell has positive volume; the faces of a sheet with two sides all run the same way around, and
// keep it when they tear.
#pragma once

#include "sim/scene/scene.h"
#include "sim/topology/orientation.h"

#include <cstdint>
#include <string>
#include <variant>
#include <vector>

namespace rend {

enum class GridCell : std::uint8_t {
  Triangle,
  Quad,
  Polygon,
  Tetrahedron,
  Hexahedron,
  Prism,
  Pyramid,
  Polyhedron
};

// Numbers on the points or the cells of a grid.
struct GridArray {
  std::string name;
  int components = 1;
  std::variant<std::vector<double>, std::vector<std::int64_t>, std::vector<std::uint8_t>> values;
};

struct Grid {
  double time = 0;                   // [s]
  std::vector<double> points;        // [m], x y z of each
  std::vector<GridCell> kinds;       // one per cell
  std::vector<std::int64_t> corners; // points of all cells, one cell after another
  std::vector<std::int64_t> ends;    // one per cell: where its corners end in `corners`
  // Of polyhedra alone, one after another: how many faces; of each how many corners, and which, turning
  // counter-clockwise as seen from outside.
  std::vector<std::int64_t> faces;
  std::vector<std::int64_t> face_ends; // one per cell: where its faces end in `faces`; -1: no polyhedron

  // On points: position at rest [m], velocity [m/s], mass [kg], vertex (its slot in the body: what it is called
  // as long as it is not parted), body (counted from 0), prescribed (bits 1, 2, 4: along x, y, z).
  std::vector<GridArray> on_points;
  // On cells: element (its smallest dart, which nothing changes), body, fragment (counted through all bodies);
  // where a body has finite elements also its stress [Pa], xx xy xz yx .. zz, and von Mises' equivalent of it.
  // These are 0 in bodies without, and in an element so flat that it has no stress.
  std::vector<GridArray> on_cells;
};

// Makes grids of a scene's states, from its first one on.
class GridMaker {
public:
  explicit GridMaker(const Scene& scene);
  Grid grid() const; // of the present state

private:
  const Scene* scene_;
  std::vector<Sides> sides_; // of each body; of solids empty
};

} // namespace rend
