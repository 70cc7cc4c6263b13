#include "sim/rows/binder.h"

#include "sim/base/check.h"
#include "sim/topology/walk.h"

#include <algorithm>

namespace rend {
namespace {

std::vector<IndexColumn> particle_columns(const Pattern& pattern, Orbit orbit) {
  std::vector<IndexColumn> columns(pattern.units.front().size());
  for (std::size_t p = 0; p < columns.size(); ++p) {
    columns[p].orbit = orbit;
    for (const auto& unit : pattern.units) columns[p].word.push_back(unit[p]);
  }
  return columns;
}

// A word within the owner's orbit ends in it, wherever it starts.
bool stays_in(Orbit orbit, const Word& word) {
  return std::all_of(word.begin(), word.end(), [&](auto letter) { return orbit.has(letter - '0'); });
}

Dart follow_back(const GMap& map, Dart d, const Word& word, std::size_t length) {
  while (length > 0) d = map.alpha(word[--length] - '0', d);
  return d;
}

} // namespace

Binder Binder::of(const EmbeddedMap& map, const Interaction& interaction, Folding folding,
                  std::optional<Orbit> corners) {
  std::vector<IndexColumn> columns = particle_columns(interaction.pattern, Vertex);
  const int places = static_cast<int>(columns.size());
  if (corners) {
    const std::vector<IndexColumn> more = particle_columns(interaction.pattern, *corners);
    columns.insert(columns.end(), more.begin(), more.end());
  }
  Binder binder(map, interaction.pattern, std::move(columns), places);
  binder.interaction_ = &interaction;
  binder.fold_ = folding == Folding::On && !interaction.pattern.fold.empty();
  binder.rows_ = PackedRows(static_cast<int>(binder.columns_.size()), places, interaction.law->values(),
                            interaction.damped ? -1 : interaction.law->damping_value());
  return binder;
}

Binder::Binder(const EmbeddedMap& map, Pattern pattern, std::vector<IndexColumn> columns, int places)
    : map_(&map), pattern_(std::move(pattern)), columns_(std::move(columns)),
      rows_(static_cast<int>(columns_.size()), places, 0) {
  CHECK(columns_.size() <= Row{}.index.size());
}

bool Binder::present(Slot owner, std::size_t unit) const {
  const CellIndex& cells = map_->cells(pattern_.owner);
  return cells.alive(owner) && pattern_.present(map_->map(), cells.first_dart(owner), unit);
}

bool Binder::fill(Slot owner, std::size_t unit, Row& row) const {
  if (!present(owner, unit)) return false;
  const Dart d = map_->cells(pattern_.owner).first_dart(owner);
  for (std::size_t c = 0; c < columns_.size(); ++c)
    row.index[c] = map_->slot(columns_[c].orbit, map_->map().follow(d, columns_[c].word[unit]));
  if (!interaction_) return true;
  row.value = interaction_->unit(owner, unit);
  return interaction_->law->acts(row.value, row.index.data());
}

bool Binder::same_particles(const Row& a, const Row& b) const {
  const std::size_t particles = pattern_.units.front().size();
  const auto same = [&](std::size_t n, std::size_t m) { return a.index[n] == b.index[m]; };
  return particles == 1 ? same(0, 0) : (same(0, 0) && same(1, 1)) || (same(0, 1) && same(1, 0));
}

// Keys of all units between the same particles as this one, found by fold words, including itself.
void Binder::find_class(Slot owner, std::size_t unit, const Row& row, std::vector<std::size_t>& keys) const {
  const std::size_t count = pattern_.units.size();
  keys.assign(1, owner * count + unit);
  thread_local std::vector<Dart> darts;
  for (std::size_t at = 0; at < keys.size(); ++at) {
    darts.clear();
    collect(map_->map(), pattern_.owner, map_->cells(pattern_.owner).first_dart(owner_of(keys[at])), darts);
    for (std::size_t n = 0; n < darts.size(); ++n) {
      for (const Word& word : pattern_.fold) {
        const Slot twin = map_->slot(pattern_.owner, map_->map().follow(darts[n], word));
        for (std::size_t u = 0; u < count; ++u) {
          const std::size_t key = twin * count + u;
          Row other;
          if (std::find(keys.begin(), keys.end(), key) != keys.end()) continue;
          if (fill(twin, u, other) && same_particles(row, other)) keys.push_back(key);
        }
      }
    }
  }
  std::sort(keys.begin(), keys.end());
}

void Binder::units_of_row(std::size_t key, std::vector<std::size_t>& keys) const {
  Row row;
  if (fold_ && fill(owner_of(key), key % pattern_.units.size(), row))
    find_class(owner_of(key), key % pattern_.units.size(), row, keys);
  else
    keys.assign(1, key);
}

// The sum of the values of such units, with the particles in the order of the first. Valid until the next call.
const double* Binder::sum_of(const std::vector<std::size_t>& keys, const Row& first) const {
  const std::size_t count = pattern_.units.size();
  thread_local std::vector<double> sum;
  sum.assign(first.value, first.value + interaction_->law->values());
  for (std::size_t n = 1; n < keys.size(); ++n) {
    Row other;
    fill(owner_of(keys[n]), keys[n] % count, other);
    interaction_->law->fold(sum.data(), other.value, swapped(first, other));
  }
  return sum.data();
}

// Updates one row.
void Binder::write(std::size_t key) {
  const std::size_t count = pattern_.units.size(), unit = key % count;
  const Slot owner = owner_of(key);
  thread_local std::vector<std::size_t> keys;
  Row row;
  bool live = fill(owner, unit, row);
  if (live && fold_) {
    find_class(owner, unit, row, keys);
    live = keys.front() == key;
    if (live && keys.size() > 1) row.value = sum_of(keys, row);
  }
  if (live)
    rows_.set(key, row.index.data(), row.value);
  else
    rows_.erase(key);
}

// Starts from empty rows: there may be fewer owners than before, and blocks are laid out in order again.
void Binder::bind_all() {
  rows_.clear();
  rows_.resize(map_->cells(pattern_.owner).slots() * pattern_.units.size());
  for (std::size_t block = 0; block < rows_.blocks(); ++block)
    for (std::size_t n = 0; n < PackedRows::block_size; ++n)
      if (const std::size_t key = PackedRows::key_at(block, n); key < rows_.keys()) write(key);
  rows_.seal();
}

void Binder::bind() {
  bind_all();
  rows_.trim();
}

void Binder::reserve_for_separations() {
  rows_.reserve(map_->slots_when_separated(pattern_.owner) * pattern_.units.size());
}

namespace {
thread_local IndexSet owners_seen;
}

void Binder::add_owner(Dart d, std::vector<Slot>& owners) {
  if (!map_->map().alive(d)) return;
  const Slot owner = map_->slot(pattern_.owner, d);
  if (owners_seen.insert(owner)) owners.push_back(owner);
}

// Adjacent darts of the list mostly have the same owner.
void Binder::add_owners(const std::vector<Dart>& darts, std::vector<Slot>& owners) {
  Slot last = no_slot;
  for (Dart d : darts) {
    if (!map_->map().alive(d)) continue;
    const Slot owner = map_->slot(pattern_.owner, d);
    if (owner == last) continue;
    last = owner;
    if (owners_seen.insert(owner)) owners.push_back(owner);
  }
}

void Binder::reach(const Changes& changes, std::vector<Slot>& owners) {
  const GMap& map = map_->map();
  const auto by_links = [&](const Word& word) {
    for (std::size_t n = 0; n < word.size(); ++n)
      for (Dart x : changes.touched[static_cast<std::size_t>(word[n] - '0')])
        if (map.alive(x)) add_owner(follow_back(map, x, word, n), owners);
  };
  for (Slot owner : changes.slots[pattern_.owner.mask])
    if (owners_seen.insert(owner)) owners.push_back(owner);
  // whether a column of that index space has a word within the owner's orbit
  std::array<bool, orbit_kinds> inside{};
  for (const IndexColumn& column : columns_) {
    for (const Word& word : column.word) {
      by_links(word);
      if (stays_in(pattern_.owner, word))
        inside[column.orbit.mask] = true;
      else
        for (Dart x : changes.moved[column.orbit.mask])
          if (map.alive(x)) add_owner(follow_back(map, x, word, word.size()), owners);
    }
  }
  for (std::size_t mask = 0; mask < inside.size(); ++mask)
    if (inside[mask]) add_owners(changes.moved[mask], owners);
  if (fold_)
    for (const Word& word : pattern_.fold) by_links(word);
}

// A row may gain or lose summed units although nothing of its owner changed.
void Binder::add_folding(std::vector<Slot>& owners) {
  const CellIndex& cells = map_->cells(pattern_.owner);
  const std::size_t count = pattern_.units.size();
  thread_local std::vector<Dart> darts;
  thread_local std::vector<std::size_t> keys;
  const std::size_t reached = owners.size();
  for (std::size_t at = 0; at < reached; ++at) { // owners one fold word away
    if (!cells.alive(owners[at])) continue;
    darts.clear();
    collect(map_->map(), pattern_.owner, cells.first_dart(owners[at]), darts);
    for (std::size_t n = 0; n < darts.size(); ++n)
      for (const Word& word : pattern_.fold) add_owner(map_->map().follow(darts[n], word), owners);
  }
  const std::size_t near = owners.size();
  for (std::size_t at = 0; at < near; ++at) { // and all units summed with those
    for (std::size_t unit = 0; unit < count; ++unit) {
      Row row;
      if (!fill(owners[at], unit, row)) continue;
      find_class(owners[at], unit, row, keys);
      for (std::size_t key : keys)
        if (owners_seen.insert(owner_of(key))) owners.push_back(owner_of(key));
    }
  }
}

void Binder::rebind(const Changes& changes) {
  if (!changes.any) return;
  if (changes.whole) return bind_all();
  thread_local std::vector<Slot> owners;
  owners.clear();
  owners_seen.clear();
  reach(changes, owners);
  if (fold_) add_folding(owners);
  rows_.resize(map_->cells(pattern_.owner).slots() * pattern_.units.size());
  for (Slot owner : owners)
    for (std::size_t unit = 0; unit < pattern_.units.size(); ++unit)
      write(owner * pattern_.units.size() + unit);
  rows_.seal();
}

} // namespace rend
