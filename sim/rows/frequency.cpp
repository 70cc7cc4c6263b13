#include "sim/rows/frequency.h"

#include "sim/base/stop_request.h"
#include "sim/topology/walk.h"

#include <algorithm>
#include <array>

namespace rend {
namespace {

// Whether fragments of a divided owner keep the unit. What reaches across a border to its particles is gone
// when that border is separated; only around a vertex are there others.
bool outlives_division(const Pattern& pattern, std::size_t unit, int dimension) {
  if (!pattern.owner.has(dimension)) return false; // no separation divides the owner
  const auto crosses = [&](const Word& word) {
    return word.find(static_cast<char>('0' + dimension)) != Word::npos;
  };
  return pattern.owner == Vertex ||
         std::none_of(pattern.units[unit].begin(), pattern.units[unit].end(), crosses);
}

// Appends the darts from which the unit of an owner may be bound, now or after separations: the smallest of
// each part of the owner that no separation divides.
void collect_starts(const GMap& map, Orbit owner, Dart d, std::vector<Dart>& out) {
  Orbit part = owner;
  part.mask = static_cast<std::uint8_t>(part.mask & ~(1U << static_cast<unsigned>(map.dimension())));
  collect(map, owner, d, out);
  std::erase_if(out, [&](Dart e) { return smallest_dart(map, part, e) != e; });
}

// Calls f(interaction, slot of the owner, dart at which it starts, unit) for every unit that counts.
template <class F>
void for_each_bounded_unit(const EmbeddedMap& map, std::span<const Interaction* const> interactions, F&& f) {
  std::vector<Dart> starts;
  std::vector<char> outlives; // one per unit
  for (const Interaction* interaction : interactions) {
    const Pattern& pattern = interaction->pattern;
    const CellIndex& owners = map.cells(pattern.owner);
    outlives.clear();
    for (std::size_t unit = 0; unit < pattern.units.size(); ++unit)
      outlives.push_back(outlives_division(pattern, unit, map.dimension()) ? 1 : 0);
    for (Slot owner = 0; owner < owners.slots(); ++owner) {
      if (!owners.alive(owner)) continue;
      for (std::size_t unit = 0; unit < pattern.units.size(); ++unit) {
        starts.clear();
        if (outlives[unit] != 0)
          collect_starts(map.map(), pattern.owner, owners.first_dart(owner), starts);
        else
          starts.push_back(owners.first_dart(owner));
        for (const Dart d : starts)
          if (pattern.present(map.map(), d, unit)) f(*interaction, owner, d, unit);
      }
    }
  }
}

} // namespace

CornerBounds corner_bounds(const EmbeddedMap& map,
                           const std::vector<std::unique_ptr<Interaction>>& interactions,
                           const MassColumn& mass) {
  std::vector<const Interaction*> all;
  for (const auto& interaction : interactions) all.push_back(interaction.get());
  return corner_bounds(map, all, mass);
}

CornerBounds corner_bounds(const EmbeddedMap& map, std::span<const Interaction* const> interactions,
                           const MassColumn& mass) {
  const CellIndex& corners = map.cells(mass.orbit());
  CornerBounds sums;
  sums.stiffness.assign(corners.slots(), 0);
  sums.damping.assign(corners.slots(), 0);
  std::array<Vec3, most_particles> rest;
  std::array<double, most_particles> weight{}, s{}, c{};
  const auto add = [&](const Interaction& interaction, Slot owner, Dart d, std::size_t unit) {
    throw_if_stop_is_due();
    const std::vector<Word>& words = interaction.pattern.units[unit];
    std::array<Slot, most_particles> at{};
    for (std::size_t n = 0; n < words.size(); ++n) {
      const Dart end = map.map().follow(d, words[n]);
      at[n] = corners.slot(end);
      rest[n] = map.rest_of(end);
      weight[n] = mass[at[n]];
    }
    interaction.law->bound(interaction.unit(owner, unit), rest.data(), weight.data(), s.data(), c.data());
    for (std::size_t n = 0; n < words.size(); ++n) {
      sums.stiffness[at[n]] += s[n];
      sums.damping[at[n]] += c[n];
    }
  };
  for_each_bounded_unit(map, interactions, add);
  return sums;
}

FrequencyBounds frequency_bounds(const CornerBounds& sums, const EmbeddedMap& map, const MassColumn& mass,
                                 const DragColumn* drag) {
  const CellIndex& corners = map.cells(mass.orbit());
  FrequencyBounds bounds{0, 0, 1e300};
  for (Slot corner = 0; corner < corners.slots(); ++corner) {
    const double m = mass[corner], own = drag ? (*drag)[corner] : 0;
    if (!corners.alive(corner) || m <= 0) continue;
    bounds.omega_squared = std::max(bounds.omega_squared, sums.stiffness[corner] / m);
    bounds.damping_rate = std::max(bounds.damping_rate, (sums.damping[corner] + own) / m);
    bounds.least_drag_rate = std::min(bounds.least_drag_rate, own / m);
  }
  return bounds;
}

} // namespace rend
