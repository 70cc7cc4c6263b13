// The input of a force law for one row: positions, velocities and rest positions of its particles, and the
// row's values.
//
// For code that processes rows one by one; the kernels of common laws take four rows at a time and gather them
// in lanes (lanes.h).
#pragma once

#include "sim/mechanics/force_law.h"
#include "sim/rows/packed_rows.h"

#include <array>
#include <vector>

namespace rend {

class GatheredRow {
public:
  // Positions [m], velocities [m/s] (null: at rest) and rest positions [m], one per vertex slot.
  void take(const ForceLaw& law, const PackedRows& rows, std::size_t row, const Record* position,
            const Record* velocity, const Record* rest) {
    for (int p = 0; p < law.particles(); ++p) {
      const std::uint32_t vertex = rows.index(p)[row];
      const auto n = static_cast<std::size_t>(p);
      x_[n] = position[vertex];
      v_[n] = velocity ? velocity[vertex].vec() : Vec3::Zero();
      rest_[n] = rest[vertex];
    }
    unit_.resize(static_cast<std::size_t>(law.values()));
    for (int c = 0; c < law.values(); ++c) unit_[static_cast<std::size_t>(c)] = rows.value(c, row);
  }

  const double* unit() const { return unit_.data(); }
  UnitState state() const { return {x_.data(), v_.data(), rest_.data()}; }

private:
  std::array<Vec3, most_particles> x_, v_, rest_;
  std::vector<double> unit_; // ForceLaw::values() of them
};

} // namespace rend
