// The visible surface of a scene, as polygons on shared points: for programs that draw surfaces and have no
// volumes.
//
// The faces are all faces of a sheet, and the α3-free ones of a solid, not triangulated (a quad is a quad),
// each starting at the corner from which pictures triangulate it. Those of a solid are counter-clockwise as
// seen from outside at rest; those of an orientable sheet all have the orientation of its smallest dart, and
// keep it when they tear. A point is a vertex of the map: two faces share it if the surface is connected there,
// and a vertex split by a tear becomes two points. Vertices inside a solid are left out.
#pragma once

#include "sim/export/skin_picture.h"
#include "sim/scene/scene.h"
#include "sim/topology/orientation.h"

#include <cstdint>
#include <string>
#include <vector>

namespace rend {

inline void append(std::vector<double>& to, const Vec3& v) {
  to.insert(to.end(), {v.x(), v.y(), v.z()});
}

struct SkinOfBody {
  std::string name;
  bool tears = false;                        // can tear: it has laws
  std::size_t points_end = 0, faces_end = 0; // one past its last entries in the arrays of the skin

  bool operator==(const SkinOfBody&) const = default;
};

// Points of a body are in the order of its vertex slots, faces by fragment and then by their smallest darts.
struct Skin {
  double time = 0; // [s]
  std::vector<SkinOfBody> bodies;

  std::vector<double> points;   // [m], x y z of each
  std::vector<double> velocity; // [m/s], x y z of each
  // [Pa], one per point: what look by="stress" shows; empty: no body has elements
  std::vector<double> largest_stress;
  std::vector<std::int32_t> vertex;        // one per point: its slot in the body
  std::vector<std::int32_t> body_of_point; // from 0

  std::vector<std::int32_t> corners; // points of all faces, face by face
  std::vector<std::int64_t> ends;    // one per face: one past its last entry in `corners`
  std::vector<std::int32_t> body_of_face;
  std::vector<std::int32_t> fragment; // one per face, numbered over all bodies by their smallest darts
  std::vector<std::uint32_t> element; // one per face: the smallest dart of its cell
  // one per face, 1: exposed by fracture; empty: no body can tear, or none is a solid
  std::vector<std::uint8_t> exposed;
  // [Pa], one per face: von Mises stress of its cell; empty: no body has elements
  std::vector<double> equivalent;
  // The place in the picture of each entry of `corners`; of faces without a picture the middle. Empty: no body
  // has one.
  std::vector<TexturePlace> texture;
};

// Makes skins of a scene's states, starting with the first, which determines which arrays are empty.
class SkinMaker {
public:
  explicit SkinMaker(const Scene& scene, SkinPictures pictures = {});
  Skin skin() const; // of the current state

  // Which of those that a skin may lack it has.
  struct Arrays {
    bool stress = false, exposed = false;
  };

private:
  const Scene* scene_;
  SkinPictures pictures_;
  std::vector<Sides> sides_; // of each body; of solids empty
  Arrays arrays_;
};

} // namespace rend
