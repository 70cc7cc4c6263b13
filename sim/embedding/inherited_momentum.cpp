#include "sim/embedding/embedded_map.h"
#include "sim/embedding/inheritance.h"
#include "sim/topology/walk.h"

#include <algorithm>
#include <numeric>

namespace rend {

void Heirs::note_momentum(const EmbeddedMap& map, std::span<const double> masses) {
  if (masses.empty()) return;
  for (std::size_t n = 0; n < pools_.size(); ++n)
    for (std::uint32_t cell = pools_[n].begin; cell < end_of(n); ++cell)
      pools_[n].momentum += masses[old_slots_[cell]] * map.velocity()[map.vertex(old_darts_[cell])].vec();
}

// A number for each pool: pools with a common heir have the same.
std::vector<std::uint32_t> Heirs::groups() const {
  std::vector<std::uint32_t> group(pools_.size());
  std::iota(group.begin(), group.end(), 0u);
  const auto root = [&](std::uint32_t pool) {
    while (group[pool] != pool) pool = group[pool] = group[group[pool]];
    return pool;
  };
  for (const Child& child : children_)
    for (const Share& share : shares(child)) {
      const std::uint32_t a = root(shares(child).front().pool), b = root(share.pool);
      group[std::max(a, b)] = std::min(a, b);
    }
  for (std::uint32_t pool = 0; pool < group.size(); ++pool) group[pool] = root(pool);
  return group;
}

namespace {

// The sum of the masses of all corners of a vertex.
double mass_of_vertex(const EmbeddedMap& map, const CellIndex& corners, std::span<const double> masses,
                      Slot v) {
  thread_local std::vector<Dart> darts;
  thread_local std::vector<Slot> slots;
  darts.clear();
  slots.clear();
  collect(map.map(), Vertex, map.cells(Vertex).first_dart(v), darts);
  for (const Dart d : darts) slots.push_back(corners.slot(d));
  std::sort(slots.begin(), slots.end());
  slots.erase(std::unique(slots.begin(), slots.end()), slots.end());
  double sum = 0;
  for (const Slot slot : slots) sum += masses[slot];
  return sum;
}

} // namespace

std::vector<std::pair<Slot, Vec3>> Heirs::shifts(const EmbeddedMap& map, std::span<const double> masses) const {
  if (masses.empty()) return {};
  const CellIndex& corners = map.cells(orbit_);
  const std::vector<std::uint32_t> group = groups();
  std::vector<Vec3> missing(pools_.size(), Vec3::Zero()); // of each group [kg m/s]
  std::vector<double> mass(pools_.size(), 0);             // of the vertices of each group [kg]
  for (std::size_t n = 0; n < pools_.size(); ++n) missing[group[n]] += pools_[n].momentum;
  // What was copied is new, with its momentum.
  std::vector<bool> copied(pools_.size(), false);
  for (std::size_t n = 0; n < pools_.size(); ++n)
    if (pools_[n].untouched) copied[group[n]] = true;

  std::vector<std::pair<Slot, std::uint32_t>> touched; // vertices and groups
  for (const Heir& heir : heirs_) {
    const std::uint32_t at = group[shares(children_[heir.child]).front().pool];
    if (copied[at]) continue;
    const Slot v = map.vertex(corners.first_dart(heir.slot));
    missing[at] -= masses[heir.slot] * map.velocity()[v].vec();
    touched.push_back({v, at});
  }
  std::sort(touched.begin(), touched.end());
  touched.erase(std::unique(touched.begin(), touched.end()), touched.end());
  for (const auto& [v, at] : touched) mass[at] += mass_of_vertex(map, corners, masses, v);

  std::vector<std::pair<Slot, Vec3>> all;
  for (const auto& [v, at] : touched) {
    if (!(mass[at] > 0)) continue;
    const Vec3 shift = missing[at] / mass[at];
    if (!all.empty() && all.back().first == v)
      all.back().second += shift;
    else
      all.push_back({v, shift});
  }
  return all;
}

} // namespace rend
