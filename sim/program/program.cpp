#include "sim/program/program.h"

#include "sim/base/simd.h"
#include "sim/mechanics/hinge_law.h"
#include "sim/mechanics/spring_law.h"
#include "sim/program/kernels.h"
#include "sim/program/threads.h"

#include <algorithm>
#include <cstring>

namespace rend {

Program::Program(EmbeddedMap& map, const std::vector<std::unique_ptr<Interaction>>& interactions,
                 const MassColumn& mass, const DragColumn* drag, const ProgramOptions& options)
    : map_(&map), interactions_(&interactions), mass_(&mass), drag_(drag), options_(options) {
  const Orbit corner = corner_orbit(map.dimension());
  for (const auto& interaction : interactions) {
    if (options.folded) folded_.push_back(Binder::of(map, *interaction, options.fold, {}));
    if (options.elementary) elementary_.push_back(Binder::of(map, *interaction, false, corner));
  }
  for (Binder& binder : folded_) binder.bind();
  for (Binder& binder : elementary_) binder.bind();
  weigh_all();
  if (options.elementary) place_corners();
  map.subscribe(changes_);
}

Program::~Program() {
  map_->unsubscribe(changes_);
}

int Program::parts() const {
  return vertices() < 4096 ? 1 : options_.threads;
}

void Program::weigh(Slot vertex) {
  const CellIndex& vertices = map_->cells(Vertex);
  double inverse = 0, rate = 0;
  if (vertices.alive(vertex)) {
    const double m = sum_at_vertex(*map_, mass_->orbit(), mass_->values(), vertices.first_dart(vertex));
    if (m > 0) inverse = 1 / m;
    if (drag_)
      rate = inverse * sum_at_vertex(*map_, drag_->orbit(), drag_->values(), vertices.first_dart(vertex));
  }
  inverse_mass_[vertex] = inverse;
  if (drag_) drag_rate_[vertex] = rate;
}

void Program::weigh_all() {
  const std::size_t slots = map_->cells(Vertex).slots();
  inverse_mass_.assign(slots, 0);
  if (drag_) drag_rate_.assign(slots, 0);
  for (Slot v = 0; v < slots; ++v) weigh(v);
}

void Program::reserve_for_separations() {
  for (Binder& binder : folded_) binder.reserve_for_separations();
  for (Binder& binder : elementary_) binder.reserve_for_separations();
  const std::size_t vertices = map_->slots_when_separated(Vertex);
  inverse_mass_.reserve(vertices);
  if (drag_) drag_rate_.reserve(vertices);
}

void Program::place_corners() {
  const CellIndex& corners = map_->cells(mass_->orbit());
  corner_vertex_.assign(corners.slots(), no_slot);
  for (Slot c = 0; c < corners.slots(); ++c)
    if (corners.alive(c)) corner_vertex_[c] = map_->vertex(corners.first_dart(c));
}

void Program::rebind() {
  if (!changes_.any) return;
  for (Binder& binder : folded_) binder.rebind(changes_);
  for (Binder& binder : elementary_) binder.rebind(changes_);
  inverse_mass_.resize(map_->cells(Vertex).slots(), 0);
  if (drag_) drag_rate_.resize(inverse_mass_.size(), 0);
  for (Slot v : changes_.slots[Vertex.mask]) weigh(v);
  const CellIndex& corners = map_->cells(mass_->orbit());
  for (Slot c : changes_.slots[mass_->orbit().mask])
    if (corners.alive(c)) weigh(map_->vertex(corners.first_dart(c)));
  if (options_.elementary) {
    corner_vertex_.resize(corners.slots(), no_slot);
    for (Slot c : changes_.slots[mass_->orbit().mask])
      corner_vertex_[c] = corners.alive(c) ? map_->vertex(corners.first_dart(c)) : no_slot;
    for (Dart d : changes_.moved[Vertex.mask])
      if (map_->map().alive(d)) corner_vertex_[corners.slot(d)] = map_->vertex(d);
  }
  changes_.clear();
}

// Rows of all interactions are run tile by tile, so that the vertices of a tile are read from memory once and not once
// per interaction: 8192 vertices with their forces take half a megabyte. Tiles depend on the number of slots alone.
constexpr std::size_t tile_vertices = 8192;

void Program::forces(const Record* position, const Record* velocity, Record* force) const {
  if (options_.walk) return walk_forces(position, velocity, nullptr, force);
  const std::vector<Binder>& binders = folded_.empty() ? elementary_ : folded_;
  const std::size_t tiles = vertices() / tile_vertices + 1;
  in_parts(parts(), vertices(), [&](std::size_t begin, std::size_t end) {
    std::size_t cleared = begin; // forces are set to 0 just before the first tile that adds to them
    const auto clear_to = [&](std::size_t to) {
      if (to <= cleared) return;
      std::memset(static_cast<void*>(force + cleared), 0, (to - cleared) * sizeof(Record));
      cleared = to;
    };
    for (std::size_t tile = 0; tile < tiles; ++tile) {
      for (const Binder& binder : binders) {
        const std::size_t blocks = binder.rows().blocks();
        for (std::size_t block = blocks * tile / tiles; block < blocks * (tile + 1) / tiles; ++block)
          clear_to(std::min<std::size_t>(end, binder.rows().range(block).high + std::size_t{1}));
      }
      for (const Binder& binder : binders) {
        const std::size_t blocks = binder.rows().blocks();
        const KernelArguments arguments{binder.rows(),
                                        position,
                                        velocity,
                                        force,
                                        static_cast<std::uint32_t>(begin),
                                        static_cast<std::uint32_t>(end),
                                        blocks * tile / tiles,
                                        blocks * (tile + 1) / tiles};
        if (binder.interaction()->law == Law::Spring)
          spring_forces(arguments, binder.interaction()->damped);
        else
          hinge_forces(arguments);
      }
    }
    clear_to(end);
  });
}

void Program::corner_forces(const Record* position, const Record* velocity, Record* corner,
                            Record* force) const {
  if (options_.walk) return walk_forces(position, velocity, corner, force);
  std::memset(static_cast<void*>(corner), 0, corner_vertex_.size() * sizeof(Record));
  std::memset(static_cast<void*>(force), 0, vertices() * sizeof(Record));
  for (const Binder& binder : elementary_) {
    const KernelArguments arguments{binder.rows(), position, velocity, corner, 0, 0, 0, binder.rows().blocks()};
    if (binder.interaction()->law == Law::Spring)
      spring_corner_forces(arguments, binder.interaction()->damped);
    else
      hinge_corner_forces(arguments);
  }
  for (Slot c = 0; c < corner_vertex_.size(); ++c) {
    if (corner_vertex_[c] == no_slot) continue;
    Record& sum = force[corner_vertex_[c]];
    store(sum, load(sum) + load(corner[c]));
  }
}

namespace {

// The forces of one unit on its particles.
std::array<Vec3, 8> unit_forces(const Interaction& interaction, const UnitParameters& p,
                                const std::array<Slot, 8>& at, const Record* x, const Record* v) {
  if (interaction.law == Law::Spring) {
    const Vec3 f = spring_force(p, x[at[0]], x[at[1]], v[at[0]], v[at[1]]);
    return {f, -f};
  }
  HingePoints positions, velocities;
  for (std::size_t n = 0; n < positions.size(); ++n) {
    positions[n] = x[at[n]];
    velocities[n] = v[at[n]];
  }
  return hinge_forces(p, positions, velocities);
}

} // namespace

void Program::walk_forces(const Record* position, const Record* velocity, Record* corner, Record* force) const {
  const GMap& map = map_->map();
  std::memset(static_cast<void*>(force), 0, vertices() * sizeof(Record));
  const CellIndex& corners = map_->cells(mass_->orbit());
  if (corner) std::memset(static_cast<void*>(corner), 0, corners.slots() * sizeof(Record));
  for (const auto& interaction : *interactions_) {
    const Pattern& pattern = interaction->pattern;
    const CellIndex& owners = map_->cells(pattern.owner);
    for (Slot owner = 0; owner < owners.slots(); ++owner) {
      if (!owners.alive(owner)) continue;
      const Dart d = owners.first_dart(owner);
      if (!pattern.present(map, d)) continue;
      for (std::size_t unit = 0; unit < pattern.units.size(); ++unit) {
        const UnitParameters p = interaction->parameters(owner, static_cast<int>(unit));
        std::array<Slot, 8> at{};
        std::array<Dart, 8> end{};
        const std::size_t particles = pattern.units[unit].size();
        for (std::size_t n = 0; n < particles; ++n) {
          end[n] = map.follow(d, pattern.units[unit][n]);
          at[n] = map_->vertex(end[n]);
        }
        const std::array<Vec3, 8> f = unit_forces(*interaction, p, at, position, velocity);
        for (std::size_t n = 0; n < particles; ++n) {
          force[at[n]] = Record(force[at[n]].vec() + f[n]);
          if (corner) corner[corners.slot(end[n])] = Record(corner[corners.slot(end[n])].vec() + f[n]);
        }
      }
    }
  }
}

double Program::elastic_energy(const Record* x) const {
  double sum = 0;
  for (const Binder& binder : folded_.empty() ? elementary_ : folded_) {
    const PackedRows& rows = binder.rows();
    rows.for_each([&](std::size_t, std::size_t row) {
      const UnitParameters p{rows.value(0)[row], rows.value(1)[row], rows.value(2)[row]};
      if (binder.interaction()->law == Law::Spring) {
        sum += spring_energy(p, x[rows.index(0)[row]], x[rows.index(1)[row]]);
      } else {
        HingePoints points;
        for (int n = 0; n < particles_of(Law::Hinge); ++n)
          points[static_cast<std::size_t>(n)] = x[rows.index(n)[row]];
        sum += hinge_energy(p, points);
      }
    });
  }
  return sum;
}

namespace {

// What a unit adds to the discs of its particles' corners, per k: |g_n| Σ|g_m|, g the gradient of its one measure.
std::array<double, 8> disc_weights(const EmbeddedMap& map, const Interaction& interaction, Dart d,
                                   std::size_t unit) {
  if (interaction.law == Law::Spring) return {2, 2};
  const std::vector<Vec3> rest = rest_positions(map, d, interaction.pattern.units[unit]);
  HingePoints x;
  std::copy(rest.begin(), rest.end(), x.begin());
  const HingePoints g = hinge_gradient(x);
  double sum = 0;
  for (const Vec3& v : g) sum += v.norm();
  std::array<double, 8> weights{};
  for (std::size_t n = 0; n < weights.size(); ++n) weights[n] = g[n].norm() * sum;
  return weights;
}

} // namespace

Program::Bounds Program::frequency_bounds() const {
  const CellIndex& corners = map_->cells(mass_->orbit());
  std::vector<double> stiffness(corners.slots(), 0), damping(corners.slots(), 0);
  for (const auto& interaction : *interactions_) {
    const CellIndex& owners = map_->cells(interaction->pattern.owner);
    for (Slot owner = 0; owner < owners.slots(); ++owner) {
      if (!owners.alive(owner)) continue;
      const Dart d = owners.first_dart(owner);
      if (!interaction->pattern.present(map_->map(), d)) continue;
      for (std::size_t unit = 0; unit < interaction->pattern.units.size(); ++unit) {
        const UnitParameters p = interaction->parameters(owner, static_cast<int>(unit));
        const std::array<double, 8> weight = disc_weights(*map_, *interaction, d, unit);
        for (std::size_t n = 0; n < interaction->pattern.units[unit].size(); ++n) {
          const Slot c = corners.slot(map_->map().follow(d, interaction->pattern.units[unit][n]));
          stiffness[c] += p.k * weight[n];
          damping[c] += p.damping * weight[n];
        }
      }
    }
  }
  Bounds bounds{0, 0, 1e300};
  for (Slot c = 0; c < corners.slots(); ++c) {
    if (!corners.alive(c) || (*mass_)[c] <= 0) continue;
    const double drag = drag_ ? (*drag_)[c] : 0;
    bounds.omega_squared = std::max(bounds.omega_squared, stiffness[c] / (*mass_)[c]);
    bounds.damping_rate = std::max(bounds.damping_rate, (damping[c] + drag) / (*mass_)[c]);
    bounds.least_drag_rate = std::min(bounds.least_drag_rate, drag / (*mass_)[c]);
  }
  return bounds;
}

std::size_t Program::bytes() const {
  std::size_t total =
      (inverse_mass_.size() + drag_rate_.size()) * sizeof(double) + corner_vertex_.size() * sizeof(Slot);
  for (const Binder& binder : folded_) total += binder.rows().bytes();
  for (const Binder& binder : elementary_) total += binder.rows().bytes();
  return total;
}

bool Program::same_as(const Program& other) const {
  const auto same = [](const std::vector<Binder>& a, const std::vector<Binder>& b) {
    return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                      [](const Binder& p, const Binder& q) { return p.rows().same_as(q.rows()); });
  };
  const auto same_bytes = [](const std::vector<double>& a, const std::vector<double>& b) {
    return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(double)) == 0;
  };
  return same(folded_, other.folded_) && same(elementary_, other.elementary_) &&
         corner_vertex_ == other.corner_vertex_ && same_bytes(inverse_mass_, other.inverse_mass_) &&
         same_bytes(drag_rate_, other.drag_rate_);
}

} // namespace rend
