#include "sim/embedding/embedded_map.h"

#include "sim/base/archive.h"
#include "sim/base/check.h"
#include "sim/base/stop_request.h"
#include "sim/embedding/vertex_acceleration.h"
#include "sim/topology/validate.h"
#include "sim/topology/walk.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstring>

namespace rend {

void Changes::clear() {
  if (!any) return;
  for (auto& list : touched) list.clear();
  for (auto& list : moved) list.clear();
  for (auto& list : slots) list.clear();
  reshaped.clear();
  any = whole = false;
}

EmbeddedMap::EmbeddedMap(int dimension) : EmbeddedMap(GMap(dimension), [](Dart) { return Point{}; }) {}

EmbeddedMap::EmbeddedMap(GMap map, const std::function<Point(Dart)>& point_of) : map_(std::move(map)) {
  const CellIndex& vertices = use(Vertex);
  position_ = &add(VertexRecord{"position"});
  rest_ = &add(VertexRecord{"rest position"});
  velocity_ = &add(VertexRecord{"velocity"});
  for (Slot v = 0; v < vertices.slots(); ++v) {
    const Point point = point_of(vertices.first_dart(v));
    (*position_)[v] = point.position;
    (*rest_)[v] = point.rest;
    (*velocity_)[v] = point.velocity;
  }
}

const CellIndex& EmbeddedMap::use(Orbit orbit) {
  auto& index = cells_[orbit.mask];
  if (!index) {
    throw_if_stop_is_due();
    index = std::make_unique<CellIndex>(map_, orbit);
  }
  return *index;
}

const CellIndex& EmbeddedMap::cells(Orbit orbit) const {
  CHECK_NOTE(cells_[orbit.mask], to_string(orbit));
  return *cells_[orbit.mask];
}

void EmbeddedMap::adopt(std::unique_ptr<ColumnBase> column) {
  const CellIndex& index = use(column->orbit());
  column->resize(index.slots());
  for (Slot slot = 0; slot < index.slots(); ++slot) {
    throw_if_stop_is_due();
    if (index.alive(slot)) column->initialise(*this, index, slot);
  }
  columns_.push_back(std::move(column));
}

void EmbeddedMap::publish_whole() {
  for (Changes* changes : readers_) {
    changes->clear();
    changes->any = changes->whole = true;
  }
}

void EmbeddedMap::renumber() {
  CHECK_NOTE(!open_, "an edit is open");
  std::vector<Slot> from;
  for (auto& index : cells_) {
    if (!index || index->in_order()) continue;
    index->renumber(map_, from);
    for (auto& column : columns_)
      if (column->orbit() == index->orbit()) column->gather(from);
  }
  publish_whole();
}

std::size_t EmbeddedMap::slots_when_separated(Orbit orbit) const {
  const std::size_t grown = grows_ ? growth : 1;
  if (!orbit.has(map_.dimension())) return grown * cells(orbit).slots();
  Orbit inside = orbit; // restricted to one element
  inside.mask = static_cast<std::uint8_t>(inside.mask & ((1 << map_.dimension()) - 1));
  std::size_t darts = 2; // the least number of darts of a corner or edge of an element
  if (inside == SingleDart) darts = 1;
  return grown * std::max(cells(orbit).slots(), map_.dart_count() / darts);
}

void EmbeddedMap::reserve_for_separations() {
  if (grows_) {
    const std::size_t darts = growth * map_.capacity();
    MapEdit(map_).reserve(darts);
    for (auto& index : cells_)
      if (index) index->reserve_darts(darts);
  }
  for (auto& index : cells_)
    if (index) index->reserve(slots_when_separated(index->orbit()));
  for (auto& column : columns_) column->reserve(slots_when_separated(column->orbit()));
}

std::size_t EmbeddedMap::bytes() const {
  std::size_t total = 0;
  for (const auto& index : cells_)
    if (index) total += index->bytes();
  for (const auto& column : columns_) total += column->bytes();
  return total;
}

void EmbeddedMap::store(Archive& archive) {
  archive.mark("map");
  constexpr std::size_t most_darts = Dart::none_value;
  grows_ ? map_.store_any(archive, most_darts) : map_.store(archive);
  // the slots before reading, of the orbits that are read
  std::array<std::optional<CellIndex>, orbit_kinds> was;
  for (std::size_t mask = 0; mask < cells_.size(); ++mask) {
    archive.same(cells_[mask] ? 1 : 0, "whether orbits have slots");
    if (!cells_[mask]) continue;
    if (archive.reading()) was[mask] = std::move(*cells_[mask]);
    cells_[mask]->store(archive, map_);
  }
  archive.same(columns_.size(), "number of embeddings");
  for (const auto& column : columns_) {
    const auto& index = was[column->orbit().mask];
    store(archive, *column, index ? &*index : nullptr);
  }
  if (archive.reading()) publish_whole();
}

namespace {

// Whether every slot in use has the value that the slot of its smallest dart had before.
bool same_values(std::span<const std::byte> now, const CellIndex& cells, std::span<const std::byte> then,
                 const CellIndex& was) {
  const std::size_t size = cells.slots() > 0 ? now.size() / cells.slots() : 0;
  for (Slot slot = 0; slot < cells.slots(); ++slot)
    if (cells.alive(slot) &&
        std::memcmp(now.data() + slot * size, then.data() + was.slot(cells.first_dart(slot)) * size, size) != 0)
      return false;
  return true;
}

// Whether time steps change its values.
bool hands_on_motion(const ColumnBase& column) {
  return dynamic_cast<const AccelerationColumn*>(&column) != nullptr;
}

void refuse_unless_finite_motion(ColumnBase& column) {
  std::vector<Record> values(column.raw().size() / sizeof(Record));
  if (!values.empty()) std::memcpy(values.data(), column.raw().data(), column.raw().size());
  refuse_unless_finite(values);
}

} // namespace

// `was`: the slots before reading. Fracture gives no embedding another value: fragments keep the value of the
// whole.
void EmbeddedMap::store(Archive& archive, ColumnBase& column, const CellIndex* was) {
  archive.mark(column.name());
  const CellIndex& index = *cells_[column.orbit().mask];
  std::vector<std::byte> then;
  const bool in_motion = moves(column) || hands_on_motion(column);
  if (was && !in_motion && !grows_) then.assign(column.raw().begin(), column.raw().end());
  column.resize(index.slots());
  archive.same(column.bytes(), "bytes of an embedding");
  archive.raw(column.raw().data(), column.raw().size());
  if (!was) return;
  if (in_motion)
    refuse_unless_finite_motion(column);
  else if (!grows_)
    refuse_unless(same_values(column.raw(), index, then, *was),
                  "what the scene has from its preset is another");
}

std::optional<std::string> validate(const EmbeddedMap& embedded) {
  if (const auto fault = validate(embedded.map())) return fault->text();
  for (int mask = 0; mask < orbit_kinds; ++mask) {
    Orbit orbit;
    orbit.mask = static_cast<std::uint8_t>(mask);
    if (!embedded.uses(orbit)) continue;
    if (auto fault = embedded.cells(orbit).fault(embedded.map())) return fault;
  }
  return {};
}

} // namespace rend
