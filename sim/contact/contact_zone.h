// Vertices that move through a step as one rigid body: what is left where impulses cannot keep an edge out of a
// face (Bridson, Fedkiw, Anderson, "Robust treatment of collisions, contact and friction for cloth animation",
// 2002, 7.5: rigid impact zones). What does not cross at the start of the step does not at its end, since
// distances within a zone stay as they were.
//
// With the displacements d of its vertices in the step, their masses m and places x at its start,
//
//   x' = c + v + R(ω) (x − c),   v = Σ m d/Σ m,   I ω = Σ m (x − c) × (d − v),   c = Σ m x/Σ m
//
// the rigid motion that is nearest to d in the metric of masses, as far as angles are small: momentum is kept,
// angular momentum to second order in ω, and the kinetic energy of the displacements can only become less. One
// that is prescribed along all axes has a mass that is larger by `heavy`: the zone follows it, and its support
// takes the momentum. One that is prescribed along some axes goes its way along these.
#pragma once

#include "sim/base/record.h"

#include <functional>
#include <map>
#include <span>
#include <vector>

namespace rend {

// A vertex, by the index of its body or mesh obstacle; or a box, by its index in the world.
struct ZonePart {
  std::uint32_t body = 0; // index into ContactBodies
  std::uint32_t number = 0;
  static constexpr std::uint32_t box = ~std::uint32_t{0}; // in place of the index
  bool is_box() const { return body == box; }
  auto operator<=>(const ZonePart&) const = default;
};

// Disjoint sets of parts, which grow.
class ContactZones {
public:
  void clear();
  bool unite(std::span<const ZonePart> parts); // false: they were in one zone already
  // Each zone with its parts in their order: boxes come last.
  std::vector<std::vector<ZonePart>> all() const;

private:
  std::size_t root(std::size_t n) const;
  std::map<ZonePart, std::size_t> number_; // into parent_
  std::vector<std::size_t> parent_;
};

struct ZoneMember {
  double mass = 0;                             // [kg]
  bool prescribed = false;                     // along all axes
  Vec3 from = Vec3::Zero(), to = Vec3::Zero(); // [m], at the start of the step and at its end
};

// x ↦ x' of the rigid motion that is nearest to what the members do.
std::function<Vec3(const Vec3&)> nearest_rigid_motion(std::span<const ZoneMember> members);

} // namespace rend
