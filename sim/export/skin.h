// What is seen of a scene, as polygons on shared points: for programs that draw surfaces and know no volumes.
//
// The faces are those that are drawn: all faces of a sheet, the α3-free ones of a solid, whole (a quad is a
// quad), each from the corner that pictures fan it from. Those of a solid turn counter-clockwise seen from
// outside, as they do at rest; those of a sheet with two sides all run the same way around, that of its
// smallest dart, and keep it when they tear. A point is a vertex of the map: two faces share it where the
// surface hangs together there, and a tear that parts it makes two points of it. Vertices inside of a solid are
// left out.
#pragma once

#include "sim/scene/scene.h"
#include "sim/topology/orientation.h"

#include <cstdint>
#include <string>
#include <vector>

namespace rend {

struct SkinOfBody {
  std::string name;
  bool tears = false;                        // may tear: it has laws
  std::size_t points_end = 0, faces_end = 0; // in the arrays of the skin; the next body begins there

  bool operator==(const SkinOfBody&) const = default;
};

// Points of a body stand in the order of its vertex slots, faces by fragment and then by their smallest darts.
struct Skin {
  double time = 0; // [s]
  std::vector<SkinOfBody> bodies;

  std::vector<double> points;   // [m], x y z of each
  std::vector<double> velocity; // [m/s], x y z of each
  std::vector<double>
      largest_stress; // [Pa], one per point: what look by="stress" shows; empty: no body has elements
  std::vector<std::int32_t> vertex;        // one per point: its slot in the body
  std::vector<std::int32_t> body_of_point; // counted from 0

  std::vector<std::int32_t> corners; // points of all faces, one face after another
  std::vector<std::int64_t> ends;    // one per face: where its corners end in `corners`
  std::vector<std::int32_t> body_of_face;
  std::vector<std::int32_t> fragment; // one per face, counted through all bodies by their smallest darts
  std::vector<std::uint32_t> element; // one per face: the smallest dart of the cell that it belongs to
  std::vector<std::uint8_t>
      bare; // one per face, 1: laid bare by fracture; empty: no body may tear, or none is a solid
  std::vector<double>
      equivalent; // [Pa], one per face: von Mises' stress of its cell; empty: no body has elements
};

// Makes skins of a scene's states, from its first one on. Which arrays are empty is settled by the first state.
class SkinMaker {
public:
  explicit SkinMaker(const Scene& scene);
  Skin skin() const; // of the present state

  // Which of those that a skin may lack it has.
  struct Arrays {
    bool stress = false, bare = false;
  };

private:
  const Scene* scene_;
  std::vector<Sides> sides_; // of each body; of solids empty
  Arrays arrays_;
};

} // namespace rend
