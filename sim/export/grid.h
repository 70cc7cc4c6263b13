// The state of a scene as an unstructured grid: points, cells, and data on both, for visualisation or
// computation in other programs. All bodies are in one grid, in the order of the preset.
//
// A point is a vertex of the map, so that a vertex split by a tear becomes two points. A cell is an element:
// hexahedra stay hexahedra. Obstacles are further bodies of quads and triangles (obstacle_skin.h). Corners
// are in the order of sim/mesh/cell_shapes.h (Gmsh's order), so that at rest every solid cell has positive
// volume; the faces of an orientable sheet all have the same orientation, and keep it when they tear.
//
// Pictures lie on the cells of sheets. A solid has none here: its corners belong to volumes, and one where
// the faces of a volume meet would lie in several places of a picture. (A skin has it.)
#pragma once

#include "sim/export/skin_picture.h"
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

// Data on the points or the cells of a grid.
struct GridArray {
  std::string name;
  int components = 1;
  std::variant<std::vector<double>, std::vector<std::int64_t>, std::vector<std::uint8_t>> values;
};

struct Grid {
  double time = 0;                   // [s]
  std::vector<double> points;        // [m], x y z of each
  std::vector<GridCell> kinds;       // one per cell
  std::vector<std::int64_t> corners; // points of all cells, cell by cell
  std::vector<std::int64_t> ends;    // one per cell: one past its last entry in `corners`
  // Only for polyhedra, one after another: the number of faces; for each face its number of corners, and the
  // corners, counter-clockwise as seen from outside.
  std::vector<std::int64_t> faces;
  std::vector<std::int64_t> face_ends; // one per cell: one past its last entry in `faces`; -1: not a polyhedron

  // The place in the picture of each entry of `corners`; in cells without a picture its middle. Empty: no
  // sheet has one.
  std::vector<TexturePlace> texture;

  // On points: position at rest (of obstacles: at time 0) [m], velocity [m/s], mass [kg], vertex (its slot in
  // the body: constant until it is split), body (from 0), prescribed (bits 1, 2, 4: along x, y, z). Obstacles
  // have no mass.
  std::vector<GridArray> on_points;
  // On cells: element (its smallest dart, which never changes), body, fragment (numbered over all bodies);
  // with finite elements also the stress [Pa], xx xy xz yx .. zz, and its von Mises equivalent. These are 0
  // in bodies without, and in an element so flat that its stress is undefined. Quads of obstacles are element
  // 0 of fragment -1.
  std::vector<GridArray> on_cells;
};

// Makes grids of a scene's states, starting with the first.
class GridMaker {
public:
  explicit GridMaker(const Scene& scene, SkinPictures pictures = {});
  Grid grid() const; // of the current state

private:
  const SkinPicture* picture_of(std::size_t body) const; // null: it has none here

  const Scene* scene_;
  SkinPictures pictures_;
  std::vector<Sides> sides_; // of each body; empty for solids
  bool textured_ = false;    // whether a sheet has a picture
};

} // namespace rend
