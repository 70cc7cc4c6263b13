// What tests of cuts in sheets and solids share: cuts at one vertex, and what they must keep.
#pragma once

#include "sim/fracture/torn_bodies.h"
#include "sim/rows/continuum.h"

namespace rend::cuts {

// Cuts at one vertex, by the plane with that normal.
inline bool cut_at(Body& body, const ChangeType& change, Dart d, const Vec3& normal) {
  bool made = false;
  const ForceView view = body.view();
  change.memory->begin(view);
  body.map->edit([&](Edit& edit) {
    made = change.apply(edit, view, normal, darts_of(body.map->map(), Vertex, d));
    change.memory->settle_candidate(made, "");
  });
  body.rebind();
  body.evaluate();
  return made;
}

inline std::shared_ptr<const ChangeType> cuts_of(Body& body, double smallest_part = 1.0 / 20) {
  return find_change("cut")->of_law(body.request_for(
      LawSettings{.criterion = find_criterion("vertex-stress"), .smallest_part = smallest_part}));
}

// Pulled along the normal: each element has the same strain.
inline void stretch(Body& body, const Vec3& normal) {
  for (Slot v = 0; v < body.vertices(); ++v) {
    const Vec3 rest = body.map->rest()[v];
    body.map->position().values()[v] = Record(Vec3(rest + 0.1 * normal.dot(rest) * normal));
  }
  body.evaluate();
}

// Of elasticity, without the springs [J].
inline double energy(const Body& body) {
  double sum = 0;
  for_each_unit(*body.map, body.interactions, [&](const Interaction& interaction, Dart d, std::size_t unit) {
    if (!dynamic_cast<const ElementLaw*>(interaction.law.get())) return;
    const CurrentUnit now(*body.map, interaction, d, unit, meshes::positions(body), nullptr);
    if (now.acts()) sum += interaction.law->energy(now.values, now.state());
  });
  return sum;
}

} // namespace rend::cuts
