#include "sim/rows/program.h"

#include "sim/base/check.h"
#include "sim/base/simd.h"
#include "sim/base/threads.h"
#include "sim/mechanics/spring_law.h"
#include "sim/rows/gathered_row.h"
#include "sim/rows/row_times.h"
#include "sim/rows/spring_sums.h"
#include "sim/rows/walk_forces.h"

#include <algorithm>
#include <cstring>

namespace rend {

Program::Program(EmbeddedMap& map, const std::vector<std::unique_ptr<Interaction>>& interactions,
                 const MassColumn& mass, const DragColumn* drag, const ProgramOptions& options)
    : map_(&map), interactions_(&interactions), mass_(&mass), drag_(drag), options_(options) {
  for (const auto& interaction : interactions) add_rows(*interaction);
  if (options.timed && !folded_.empty()) folded_times_ = std::make_unique<RowTimes>(folded_.size());
  if (options.timed && !elementary_.empty()) elementary_times_ = std::make_unique<RowTimes>(elementary_.size());
  recompute_masses();
  map.subscribe(changes_);
}

void Program::add_rows(const Interaction& interaction) {
  const Orbit corner = corner_orbit(map_->dimension());
  kernels_.push_back(&kernel_of(*interaction.law));
  if (options_.folded) folded_.emplace_back(Binder::of(*map_, interaction, Folding{options_.fold}, {})).bind();
  if (options_.elementary)
    elementary_.emplace_back(Binder::of(*map_, interaction, Folding::Off, corner)).bind();
}

void Program::take_up_interactions() {
  for (std::size_t n = kernels_.size(); n < interactions_->size(); ++n) add_rows(*(*interactions_)[n]);
  if (folded_times_) folded_times_->resize(folded_.size());
  if (elementary_times_) elementary_times_->resize(elementary_.size());
  tiles_.clear();
}

Program::~Program() {
  map_->unsubscribe(changes_);
}

int Program::parts() const {
  return vertices() < 4096 && !options_.parallel_small_bodies ? 1 : options_.threads;
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
  tiles_.clear();
  for (Binder& binder : folded_) binder.rebind(changes_);
  for (Binder& binder : elementary_) binder.rebind(changes_);
  changes_.whole ? recompute_masses() : update_masses();
  changes_.clear();
}

void Program::recompute_masses() {
  weigh_all();
  if (options_.elementary) place_corners();
}

void Program::update_masses() {
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
}

KernelArguments Program::arguments(const Binder& binder, const Record* position, const Record* velocity,
                                   Record* force) const {
  const Interaction& interaction = *binder.interaction();
  return {.law = *interaction.law,
          .rows = binder.rows(),
          .position = position,
          .velocity = velocity,
          .rest = map_->rest().values().data(),
          .force = force,
          .low = 0,
          .high = static_cast<std::uint32_t>(vertices()),
          .first = 0,
          .last = binder.rows().blocks(),
          .damped = interaction.damped};
}

// Cache blocking: rows of all interactions are run tile by tile, so that the vertices of a tile are read from
// memory once and not once per interaction: 8192 vertices with their forces take half a megabyte. Tiles depend
// on the number of slots alone.
constexpr std::size_t tile_vertices = 8192;
constexpr std::size_t corner_tile_vertices = 1024; // with about four corners each

void Program::forces(const Record* position, const Record* velocity, Record* force) const {
  if (options_.walk)
    return walk_forces(*map_, *interactions_, mass_->orbit(), position, velocity, nullptr, force);
  run({.sums = false, .position = position, .velocity = velocity, .force = force}, 1, nullptr);
}

bool sums_available(const std::vector<std::unique_ptr<Interaction>>& interactions,
                    const ProgramOptions& options) {
  return !options.walk && std::all_of(interactions.begin(), interactions.end(),
                                      [](const auto& interaction) { return interaction->law == spring_law(); });
}

void Program::forces_with_sums(const Record* position, const Record* velocity, Record* force) const {
  CHECK(sums_available(*interactions_, options_));
  run({.sums = true, .position = position, .velocity = velocity, .force = force}, 1, nullptr);
}

void Program::forces_in_ranges(const Record* position, const Record* velocity, Record* force, std::size_t unit,
                               RangeFunction whole) const {
  CHECK(!options_.walk);
  run({.sums = false, .position = position, .velocity = velocity, .force = force}, unit, &whole);
}

void Program::run(const Evaluation& what, std::size_t unit, const RangeFunction* whole) const {
  if (tiles_.empty()) find_tiles();
  if (RowTimes* const times = folded_.empty() ? elementary_times_.get() : folded_times_.get()) times->count();
  const std::size_t count = vertices();
  parallel_ranges(parts(), (count + unit - 1) / unit, [&](std::size_t first, std::size_t last) {
    run_part(what, first * unit, std::min(count, last * unit), whole);
  });
}

void Program::find_tiles() const {
  const auto count = static_cast<std::uint32_t>(vertices());
  tiles_.assign(count / tile_vertices + 1, {0, count});
  for (const Binder& binder : rows()) {
    const std::size_t blocks = binder.rows().blocks();
    std::uint32_t low = count; // the lowest vertex that later tiles add to
    for (std::size_t tile = tiles_.size(); tile-- > 0;) {
      tiles_[tile].whole = std::min(tiles_[tile].whole, low);
      for (std::size_t n = blocks * tile / tiles_.size(); n < blocks * (tile + 1) / tiles_.size(); ++n) {
        const PackedRows::Range range = binder.rows().range(n);
        low = std::min(low, range.low);
        tiles_[tile].reached = std::max(tiles_[tile].reached, range.high + 1);
      }
    }
  }
  tiles_.back().reached = count;
}

// For vertex slots [begin, end). Forces are set to 0 just before the first tile that adds to them.
void Program::run_part(const Evaluation& what, std::size_t begin, std::size_t end,
                       const RangeFunction* whole) const {
  const std::vector<Binder>& binders = rows();
  RowTimes::Laps laps(folded_.empty() ? elementary_times_.get() : folded_times_.get());
  std::size_t cleared = begin, told = begin;
  for (std::size_t tile = 0; tile < tiles_.size(); ++tile) {
    if (const std::size_t to = std::min<std::size_t>(end, tiles_[tile].reached); to > cleared) {
      std::memset(static_cast<void*>(what.force + cleared), 0, (to - cleared) * sizeof(Record));
      cleared = to;
    }
    laps.begin();
    for (std::size_t n = 0; n < binders.size(); ++n) {
      const std::size_t blocks = binders[n].rows().blocks();
      KernelArguments part = arguments(binders[n], what.position, what.velocity, what.force);
      part.low = static_cast<std::uint32_t>(begin);
      part.high = static_cast<std::uint32_t>(end);
      part.first = blocks * tile / tiles_.size();
      part.last = blocks * (tile + 1) / tiles_.size();
      what.sums ? spring_forces_with_sums(part) : kernels_[n]->forces(part);
      laps.end(n);
    }
    if (const std::size_t to = std::min<std::size_t>(end, tiles_[tile].whole); whole && to > told) {
      (*whole)(told, to);
      told = to;
    }
  }
}

void Program::corner_forces(const Record* position, const Record* velocity, Record* corner,
                            Record* force) const {
  if (options_.walk)
    return walk_forces(*map_, *interactions_, mass_->orbit(), position, velocity, corner, force);
  std::memset(static_cast<void*>(corner), 0, corner_vertex_.size() * sizeof(Record));
  std::memset(static_cast<void*>(force), 0, vertices() * sizeof(Record));
  const std::size_t tiles = vertices() / corner_tile_vertices + 1;
  if (elementary_times_) elementary_times_->count();
  RowTimes::Laps laps(elementary_times_.get());
  laps.begin();
  for (std::size_t tile = 0; tile < tiles; ++tile) {
    for (std::size_t n = 0; n < elementary_.size(); ++n) {
      const std::size_t blocks = elementary_[n].rows().blocks();
      KernelArguments part = arguments(elementary_[n], position, velocity, corner);
      part.first = blocks * tile / tiles;
      part.last = blocks * (tile + 1) / tiles;
      kernels_[n]->corner_forces(part);
      laps.end(n);
    }
  }
  for (Slot c = 0; c < corner_vertex_.size(); ++c) {
    if (corner_vertex_[c] == no_slot) continue;
    Record& sum = force[corner_vertex_[c]];
    store(sum, load(sum) + load(corner[c]));
  }
}

// A unit that acts on a corner has a row in a block whose range holds the corner's vertex.
void Program::corner_forces_at(const std::vector<std::uint8_t>& mark, const Record* position,
                               const Record* velocity, Record* corner) const {
  // number of marked slots before each slot, and of all at the end
  thread_local std::vector<std::uint32_t> marks;
  marks.assign(mark.size() + 1, 0);
  for (std::size_t v = 0; v < mark.size(); ++v) marks[v + 1] = marks[v] + mark[v];
  const auto concerned = [&](const PackedRows& rows, std::size_t block) {
    const PackedRows::Range range = rows.range(block);
    return range.low <= range.high && marks[range.high + 1] > marks[range.low];
  };
  for (Slot c = 0; c < corner_vertex_.size(); ++c)
    if (corner_vertex_[c] != no_slot && mark[corner_vertex_[c]]) store(corner[c], Double4{});
  for (std::size_t n = 0; n < elementary_.size(); ++n) {
    KernelArguments part = arguments(elementary_[n], position, velocity, corner);
    for (std::size_t block = 0; block < elementary_[n].rows().blocks(); ++block) {
      if (!concerned(elementary_[n].rows(), block)) continue;
      part.first = block;
      part.last = block + 1;
      kernels_[n]->corner_forces(part);
    }
  }
}

double Program::elastic_energy(const Record* x) const {
  double sum = 0;
  thread_local GatheredRow g; // keeps its capacity, since the guard calls this during a run
  for (const Binder& binder : rows()) {
    const ForceLaw& law = *binder.interaction()->law;
    binder.rows().for_each([&](std::size_t, std::size_t row) {
      g.take(law, binder.rows(), row, x, nullptr, map_->rest().values().data());
      sum += law.energy(g.unit(), g.state());
    });
  }
  return sum;
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
    return a.size() == b.size() &&
           (a.empty() || std::memcmp(a.data(), b.data(), a.size() * sizeof(double)) == 0);
  };
  return same(folded_, other.folded_) && same(elementary_, other.elementary_) &&
         corner_vertex_ == other.corner_vertex_ && same_bytes(inverse_mass_, other.inverse_mass_) &&
         same_bytes(drag_rate_, other.drag_rate_);
}

} // namespace rend
