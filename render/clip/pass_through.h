// Whether pictures show a body inside of what it has no <contact> with: the floor, a sphere, a box, or a mesh
// that is closed. All of these are drawn, so this looks like a mistake, and is told; a body that stays clear of
// them needs no contact.
#pragma once

#include "sim/contact/standing_mesh.h"
#include "sim/scene/scene.h"

#include <string>
#include <vector>

namespace rend {

class PassThrough {
public:
  explicit PassThrough(const Scene& scene);

  // To be called with the state of each frame that is drawn. A vertex counts from a depth of 0.002 of its
  // body's size at rest on, which a picture can show.
  void look(long frame);

  // One for each body and kind of obstacle that it was seen in.
  const std::vector<std::string>& notes() const { return notes_; }

private:
  struct Watched {
    const Body* body;
    double hair;                        // [m]
    bool floor, spheres, boxes, meshes; // whether it is looked for there
  };
  void tell(const Body& body, long frame, const char* what, const char* remedy);

  const Scene& scene_;
  std::vector<Watched> bodies_;      // without those that have nothing to pass through
  std::vector<StandingMesh> meshes_; // those that are closed; empty where no body passes through
  std::vector<std::string> notes_;
};

} // namespace rend
