#include "sim/rows/vertex_bounds.h"

#include "sim/base/stop_request.h"

#include <algorithm>
#include <array>
#include <limits>

namespace rend {

VertexBounds::VertexBounds(EmbeddedMap& map, const std::vector<std::unique_ptr<Interaction>>& interactions,
                           const MassColumn& mass, const DragColumn* drag)
    : map_(map), corners_(map.cells(mass.orbit())), mass_(mass), drag_(drag) {
  for (const auto& each : interactions) {
    if (each->pattern.owner == element_orbit(map.dimension()))
      of_elements_.push_back({each.get(), static_cast<std::size_t>(each->law->particles()), {}, {}, {}, {}});
    else
      others_.push_back(each.get());
  }
  map_.subscribe(changes_);
}

VertexBounds::~VertexBounds() {
  map_.unsubscribe(changes_);
}

FrequencyBounds VertexBounds::bounds(int rounds) {
  constexpr double high = 0.25; // of the highest bound of ω²: where masses are shared anew
  forget_changed();
  for (Units& units : of_elements_) find_unknown(units);
  const CornerBounds others = corner_bounds(map_, others_, mass_);
  std::vector<Slot> vertex_of(corners_.slots(), no_slot);
  for (Slot c = 0; c < corners_.slots(); ++c)
    if (corners_.alive(c)) vertex_of[c] = map_.vertex(corners_.first_dart(c));
  constexpr double infinity = std::numeric_limits<double>::infinity();
  FrequencyBounds least{infinity, infinity, infinity};
  for (int round = 0; round <= rounds; ++round) {
    const std::vector<Sums> at = sums_at_vertices(vertex_of, others);
    FrequencyBounds now{0, 0, 1e300};
    for (const Sums& v : at) {
      if (v.mass <= 0) continue;
      now.omega_squared = std::max(now.omega_squared, v.stiffness / v.mass);
      now.damping_rate = std::max(now.damping_rate, (v.damping + v.drag) / v.mass);
      now.least_drag_rate = std::min(now.least_drag_rate, v.drag / v.mass);
    }
    least = {std::min(least.omega_squared, now.omega_squared), std::min(least.damping_rate, now.damping_rate),
             now.least_drag_rate};
    if (round < rounds) share_masses(vertex_of, at, high * now.omega_squared);
  }
  return least;
}

// A unit is initialised again, and so listed, where one of its particles is at another place at rest.
void VertexBounds::forget_changed() {
  for (Units& units : of_elements_) {
    if (changes_.whole) units.known.clear();
    for (Slot owner : changes_.slots[units.interaction->pattern.owner.mask])
      if (owner < units.known.size()) units.known[owner] = 0;
  }
  changes_.clear();
}

void VertexBounds::find_unknown(Units& units) {
  const CellIndex& owners = map_.cells(units.interaction->pattern.owner);
  const std::size_t count = owners.slots() * units.interaction->pattern.units.size() * units.stride;
  units.known.resize(owners.slots(), 0);
  units.corner.resize(count, no_slot);
  units.stiffness.resize(count, 0);
  units.damping.resize(count, 0);
  for (Slot owner = 0; owner < owners.slots(); ++owner) {
    if (units.known[owner] != 0) continue;
    throw_if_stop_is_due();
    find(units, owner);
    units.known[owner] = 1;
  }
}

void VertexBounds::find(Units& units, Slot owner) {
  const Pattern& pattern = units.interaction->pattern;
  const CellIndex& owners = map_.cells(pattern.owner);
  for (std::size_t unit = 0; unit < pattern.units.size(); ++unit) {
    const std::size_t begin = (owner * pattern.units.size() + unit) * units.stride;
    units.corner[begin] = no_slot;
    if (!owners.alive(owner)) continue;
    const Dart d = owners.first_dart(owner);
    if (!pattern.present(map_.map(), d, unit)) continue;
    std::array<double, most_particles> mass{};
    for (std::size_t n = 0; n < units.stride; ++n) {
      const Slot corner = corners_.slot(map_.map().follow(d, pattern.units[unit][n]));
      units.corner[begin + n] = corner;
      mass[n] = mass_[corner];
    }
    evaluate(units, owner, unit, mass.data());
  }
}

void VertexBounds::evaluate(Units& units, Slot owner, std::size_t unit, const double* mass) {
  const Interaction& interaction = *units.interaction;
  const std::vector<Word>& words = interaction.pattern.units[unit];
  const Dart d = map_.cells(interaction.pattern.owner).first_dart(owner);
  std::array<Vec3, most_particles> rest;
  for (std::size_t n = 0; n < units.stride; ++n) rest[n] = map_.rest_of(map_.map().follow(d, words[n]));
  const std::size_t begin = (owner * interaction.pattern.units.size() + unit) * units.stride;
  interaction.law->bound(interaction.unit(owner, unit), rest.data(), mass, &units.stiffness[begin],
                         &units.damping[begin]);
}

std::vector<VertexBounds::Sums> VertexBounds::sums_at_vertices(const std::vector<Slot>& vertex_of,
                                                               const CornerBounds& others) const {
  std::vector<Sums> at(map_.cells(Vertex).slots());
  for (Slot c = 0; c < corners_.slots(); ++c) {
    if (vertex_of[c] == no_slot) continue;
    Sums& v = at[vertex_of[c]];
    v.mass += mass_[c];
    v.stiffness += others.stiffness[c];
    v.damping += others.damping[c];
    if (drag_) v.drag += (*drag_)[c];
  }
  for (const Units& units : of_elements_)
    for (std::size_t begin = 0; begin < units.corner.size(); begin += units.stride) {
      if (units.corner[begin] == no_slot) continue;
      for (std::size_t n = begin; n < begin + units.stride; ++n) {
        Sums& v = at[vertex_of[units.corner[n]]];
        v.stiffness += units.stiffness[n];
        v.damping += units.damping[n];
      }
    }
  return at;
}

// Evaluates units at vertices whose bound is above that [1/s²] with shares of the masses of their vertices.
void VertexBounds::share_masses(const std::vector<Slot>& vertex_of, const std::vector<Sums>& at, double above) {
  std::array<double, most_particles> mass{};
  for (Units& units : of_elements_) {
    const std::size_t per_owner = units.interaction->pattern.units.size();
    for (std::size_t begin = 0; begin < units.corner.size(); begin += units.stride) {
      if (units.corner[begin] == no_slot) continue;
      bool high = false;
      for (std::size_t n = 0; n < units.stride; ++n) {
        const Sums& v = at[vertex_of[units.corner[begin + n]]];
        high = high || v.stiffness > above * v.mass;
        mass[n] = v.stiffness > 0 ? v.mass * units.stiffness[begin + n] / v.stiffness : v.mass;
      }
      if (!high) continue;
      const std::size_t index = begin / units.stride;
      const auto owner = static_cast<Slot>(index / per_owner);
      evaluate(units, owner, index % per_owner, mass.data());
      units.known[owner] = 0; // with the masses of its corners
    }
  }
}

} // namespace rend
