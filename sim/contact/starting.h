// A body, or a mesh obstacle, before the first step, as what looks for overlaps sees it (start_overlap.h):
// where it is, what of it contact can move, and its faces in a tree.
#pragma once

#include "sim/body/body.h"
#include "sim/contact/surface_tree.h"
#include "sim/outside/world.h"

namespace rend {

class Starting {
public:
  using Bounds = Eigen::AlignedBox3d;

  // Puts what is prescribed where it is at time 0. `number_`: of the body in the scene.
  Starting(Body& body_, std::size_t number_);
  Starting(const MeshObstacle& mesh, std::size_t number_); // of the obstacle in the world

  const ContactSettings& settings() const { return *body->contact; } // of a body
  Vec3 at(Slot v) const { return positions()[v].vec(); }
  double least() const; // [m], what counts as inside
  bool solid() const { return solid_; }

  // Whether contact can move a vertex along n.
  bool free_along(Slot v, const Vec3& n) const {
    for (int axis = 0; axis < 3; ++axis)
      if (std::abs(n[axis]) > 1e-3 && !(held[v] & (1u << axis))) return true;
    return false;
  }
  bool pinned(Slot v) const { return held[v] == everywhere; }
  bool pinned(const ContactFaces::Triangle& t) const {
    return pinned(t.vertex[0]) && pinned(t.vertex[1]) && pinned(t.vertex[2]);
  }

  void move(const Vec3& by); // a body

  Body* body = nullptr; // null: an obstacle
  std::size_t number;
  std::vector<Slot> alive;
  std::vector<std::uint8_t> held; // one per vertex slot, bits 0, 1, 2: prescribed along x, y, z
  bool movable = true;            // nothing is prescribed
  Bounds bounds;                  // [m]
  Vec3 moved = Vec3::Zero();      // [m]
  std::string out_of;             // what it was moved out of, for a note
  std::optional<ContactFaces> faces;
  std::optional<SurfaceTree> tree; // none: contact with the floor alone

private:
  static constexpr std::uint8_t everywhere = 7;
  const std::vector<Record>& positions() const { return body ? body->map->position().values() : placed_; }
  void look();

  std::vector<Record> placed_; // [m], one per vertex of an obstacle
  bool solid_;
};

} // namespace rend
