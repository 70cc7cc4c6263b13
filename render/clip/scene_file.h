// What meshes cannot say of an exported clip: the camera, the light, obstacles as spheres and boxes, the
// floor and the colours, for programs that draw it themselves (presets/blender/import.py reads it).
//
// One JSON object:
//   {"scene": name, "format": "ply", "fps": 30 [1/s], "size": [width, height] [pixels],
//    "background": "#rrggbb" or null (transparent), "floor": z [m] or null,
//    "bodies": [{"name", "solid": true or false, "colour", "back" (of sheets), "inside" (of solids)}],
//    "obstacles": [{"name", "kind": "sphere", "radius" [m], "colour"}, {"name", "kind": "box", "size" [m],
//     "colour"}, {"name", "kind": "mesh", "points" [m, from its middle], "triangles", "colour"}],
//    "frames": [{"frame": number, "file", "time" [s], "camera": {"eye" [m], "target" [m], "up", "fov" [degrees,
//                from bottom to top]}, "light": direction towards the key light,
//                "obstacles": [{"middle" [m], "turn": 9 numbers, a matrix by rows}]}]}
// Bodies and obstacles are in the order of the exported meshes, spheres before boxes before meshes. The
// middle of an obstacle is that of the sphere, the box, or the bounding box at time 0, and `turn` takes
// directions at time 0 to those of the frame.
#pragma once

#include "render/clip/session.h"
#include "render/picture/viewpoint.h"

#include <nlohmann/json.hpp>

namespace rend {

class SceneFile {
public:
  // Before the first step; `format`: of the meshes.
  SceneFile(const Session& session, const std::string& format);

  void observe(); // call with the state of each frame of the clip, written or not
  // An entry of `frames`: of the current state, as `frame` shows it in `file`.
  nlohmann::ordered_json frame(long frame, const std::string& file) const;
  void add(nlohmann::ordered_json frame); // that was written
  std::string text() const;

private:
  const Session& session_;
  Viewpoint viewpoint_;
  nlohmann::ordered_json file_;
};

} // namespace rend
