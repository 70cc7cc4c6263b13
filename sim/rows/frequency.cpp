#include "sim/rows/frequency.h"

#include <algorithm>
#include <array>

namespace rend {

FrequencyBounds frequency_bounds(const EmbeddedMap& map,
                                 const std::vector<std::unique_ptr<Interaction>>& interactions,
                                 const MassColumn& mass, const DragColumn* drag) {
  const CellIndex& corners = map.cells(mass.orbit());
  std::vector<double> stiffness(corners.slots(), 0), damping(corners.slots(), 0); // one per corner slot
  std::array<Vec3, most_particles> rest;
  std::array<double, most_particles> weight{}, s{}, c{};
  for_each_unit(map, interactions, [&](const Interaction& interaction, Dart d, std::size_t unit) {
    const std::vector<Word>& words = interaction.pattern.units[unit];
    std::array<Slot, most_particles> at{};
    for (std::size_t n = 0; n < words.size(); ++n) {
      const Dart end = map.map().follow(d, words[n]);
      at[n] = corners.slot(end);
      rest[n] = map.rest_of(end);
      weight[n] = mass[at[n]];
    }
    const double* values = interaction.unit(map.slot(interaction.pattern.owner, d), unit);
    interaction.law->bound(values, rest.data(), weight.data(), s.data(), c.data());
    for (std::size_t n = 0; n < words.size(); ++n) {
      stiffness[at[n]] += s[n];
      damping[at[n]] += c[n];
    }
  });
  FrequencyBounds bounds{0, 0, 1e300};
  for (Slot corner = 0; corner < corners.slots(); ++corner) {
    const double m = corners.alive(corner) ? mass[corner] : 0;
    if (m <= 0) continue;
    const double own = drag ? (*drag)[corner] : 0;
    bounds.omega_squared = std::max(bounds.omega_squared, stiffness[corner] / m);
    bounds.damping_rate = std::max(bounds.damping_rate, (damping[corner] + own) / m);
    bounds.least_drag_rate = std::min(bounds.least_drag_rate, own / m);
  }
  return bounds;
}

} // namespace rend
