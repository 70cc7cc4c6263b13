// One unit of an interaction in a given state, found by walking the map: for evaluating single units.
#pragma once

#include "sim/mechanics/interaction.h"

#include <array>

namespace rend {

struct CurrentUnit {
  const Interaction* interaction = nullptr;
  Dart owner;                                      // the first dart of its orbit
  const double* values = nullptr;                  // ForceLaw::values() of them
  int particles = 0;                               // number of valid entries of each array
  std::array<Dart, most_particles> corner;         // the dart that the word of each particle leads to
  std::array<Slot, most_particles> vertex;         // of each particle
  std::array<Vec3, most_particles> position, rest; // [m]
  std::array<Vec3, most_particles> velocity;       // [m/s]

  // The unit whose words start at d, the first dart of its owner. Positions [m] and velocities [m/s]: one
  // record per vertex slot; null velocities: 0.
  CurrentUnit(const EmbeddedMap& map, const Interaction& interaction_, Dart d, std::size_t unit,
              const Record* x, const Record* v)
      : interaction(&interaction_), owner(d),
        values(interaction_.unit(map.slot(interaction_.pattern.owner, d), unit)),
        particles(interaction_.law->particles()) {
    const std::vector<Word>& words = interaction_.pattern.units[unit];
    for (std::size_t n = 0; n < words.size(); ++n) {
      corner[n] = map.map().follow(d, words[n]);
      vertex[n] = map.vertex(corner[n]);
      position[n] = x[vertex[n]];
      velocity[n] = v ? v[vertex[n]].vec() : Vec3::Zero();
      rest[n] = map.rest()[vertex[n]];
    }
  }

  UnitState state() const { return {position.data(), velocity.data(), rest.data()}; }
  bool acts() const { return interaction->law->acts(values, vertex.data()); }

  // [N], on each particle.
  std::array<Vec3, most_particles> forces() const {
    std::array<Vec3, most_particles> force;
    interaction->law->forces(values, state(), force.data());
    return force;
  }
};

} // namespace rend
