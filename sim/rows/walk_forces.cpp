#include "sim/rows/walk_forces.h"

#include <array>
#include <cstring>

namespace rend {
namespace {

void add_force(Record& to, const Vec3& force) {
  to = Record(to.vec() + force);
}

} // namespace

void walk_forces(const EmbeddedMap& map, const std::vector<std::unique_ptr<Interaction>>& interactions,
                 Orbit corner_orbit, const Record* position, const Record* velocity, Record* corner,
                 Record* force) {
  std::memset(static_cast<void*>(force), 0, map.cells(Vertex).slots() * sizeof(Record));
  if (corner) std::memset(static_cast<void*>(corner), 0, map.cells(corner_orbit).slots() * sizeof(Record));
  std::array<Vec3, most_particles> x, v, rest, f;
  for_each_unit(map, interactions, [&](const Interaction& interaction, Dart d, std::size_t unit) {
    const std::vector<Word>& words = interaction.pattern.units[unit];
    std::array<Dart, most_particles> end{};
    for (std::size_t n = 0; n < words.size(); ++n) {
      end[n] = map.map().follow(d, words[n]);
      x[n] = position[map.vertex(end[n])];
      v[n] = velocity[map.vertex(end[n])];
      rest[n] = map.rest_of(end[n]);
    }
    const double* values = interaction.unit(map.slot(interaction.pattern.owner, d), unit);
    interaction.law->forces(values, {x.data(), v.data(), rest.data()}, f.data());
    for (std::size_t n = 0; n < words.size(); ++n) {
      add_force(force[map.vertex(end[n])], f[n]);
      if (corner) add_force(corner[map.slot(corner_orbit, end[n])], f[n]);
    }
  });
}

} // namespace rend
