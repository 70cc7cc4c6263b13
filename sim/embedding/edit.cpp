// An edit of a map with its values: what it records, how it closes, and how it is taken back.
#include "sim/base/check.h"
#include "sim/base/stop_request.h"
#include "sim/embedding/embedded_map.h"
#include "sim/topology/walk.h"

#include <algorithm>
#include <cmath>

namespace rend {

// How far an edit has been closed.
struct EmbeddedMap::Closing {
  std::array<bool, orbit_kinds> slots{}; // kinds of orbit whose slots are up to date, or the last one: in part
  std::size_t columns = 0;               // as many are up to date, the last perhaps in part
  std::size_t published = 0;             // lists of subscribers
  std::vector<std::unique_ptr<Heirs>> heirs;
  std::vector<const Heirs*> heirs_of; // of each column; null: it has none. Empty: no column has
};

// While vertices have their old rest positions.
void EmbeddedMap::find_reshaped(const Edit& edit) {
  for (const auto& [d, point] : edit.moves_)
    if (map_.alive(d) && rest_of(d) != point.rest) reshaped_.push_back(d);
}

// What depends on rest positions, but not masses: matter is neither made nor lost where it is moved.
void EmbeddedMap::initialise_around_reshaped(ColumnBase& column, const Heirs* done_by_them) {
  thread_local std::vector<Dart> darts;
  if (reshaped_.empty() || column.support() == SingleDart || !column.masses().empty()) return;
  const CellIndex& index = *cells_[column.orbit().mask];
  IndexSet seen, done; // darts, slots
  if (done_by_them) done_by_them->each_slot([&](Slot slot) { done.insert(slot); });
  for (Dart moved : reshaped_)
    for (Dart around : darts_of(map_, Vertex, moved)) {
      if (seen.contains(around.value)) continue;
      darts.clear();
      collect(map_, column.support(), around, darts);
      for (Dart d : darts) {
        seen.insert(d.value);
        const Slot slot = index.slot(d);
        if (!done.insert(slot)) continue;
        column.initialise(*this, index, slot);
        initialised_[column.orbit().mask].push_back(slot);
      }
    }
}

void EmbeddedMap::edit(const std::function<void(Edit&)>& change) {
  CHECK_NOTE(!open_, "an edit is open");
  journal_.clear();
  Edit edit(map_, journal_, *this);
  const Edit::Savepoint start = edit.savepoint();
  open_ = true;
  Closing closing;
  try {
    change(edit);
    if (!journal_.empty() || !edit.moves_.empty()) close(edit, closing);
  } catch (...) {
    take_back(closing);
    edit.rollback(start);
    open_ = false;
    throw;
  }
  open_ = false;
#ifdef REND_VALIDATE
  if (const auto fault = validate(*this)) CHECK_NOTE(!fault, *fault);
#endif
}

void EmbeddedMap::close(const Edit& edit, Closing& closing) {
  reshaped_.clear();
  if (edit.lineage_ && !edit.lineage_->empty()) find_heirs(edit, closing);
  for (std::size_t mask = 0; mask < cells_.size(); ++mask) {
    initialised_[mask].clear();
    if (!cells_[mask]) continue;
    throw_if_stop_is_due();
    closing.slots[mask] = true;
    cells_[mask]->update(map_, journal_, events_[mask]);
  }
  for (const auto& heirs : closing.heirs) heirs->find_slots(*this);
  bring_columns_up_to_date(edit, closing);
  publish(closing);
  bool overwrote = !closing.heirs.empty();
  for (std::size_t mask = 0; mask < cells_.size(); ++mask) {
    if (!cells_[mask]) continue;
    cells_[mask]->commit();
    overwrote = overwrote || events_[mask].beyond_splits() || !initialised_[mask].empty();
  }
  if (!overwrote) return; // only separations
  for (const auto& column : columns_) column->commit();
}

// Whose heirs there are, and what they inherit, while slots and values are those from before the edit.
void EmbeddedMap::find_heirs(const Edit& edit, Closing& closing) {
  const OldLinks old_links(map_, journal_);
  const EditRecord record{*this, journal_, *edit.lineage_, old_links};
  closing.heirs_of.resize(columns_.size());
  for (std::size_t n = 0; n < columns_.size(); ++n) {
    ColumnBase& column = *columns_[n];
    const auto by = column.inheritance();
    if (!by) continue;
    Heirs* found = nullptr;
    for (const auto& heirs : closing.heirs)
      if (heirs->serves(column.orbit(), column.support(), *by)) found = heirs.get();
    if (!found) {
      closing.heirs.push_back(std::make_unique<Heirs>(record, column.orbit(), column.support(), *by));
      found = closing.heirs.back().get();
    }
    column.note_parents(*found);
    found->note_momentum(*this, column.masses());
    closing.heirs_of[n] = found;
  }
}

void EmbeddedMap::bring_columns_up_to_date(const Edit& edit, Closing& closing) {
  for (const auto& column : columns_) {
    const Heirs* heirs = closing.heirs_of.empty() ? nullptr : closing.heirs_of[closing.columns];
    ++closing.columns;
    const std::size_t mask = column->orbit().mask;
    column->apply(*this, *cells_[mask], events_[mask], heirs);
    // position and rest come before: the columns that follow depend on rest positions
    if (column.get() == velocity_) {
      give_points(edit);
      find_reshaped(edit);
      move_vertices(edit);
      for (const auto& each : closing.heirs) each->weigh(*this);
    }
    if (heirs) column->inherit(*this, *cells_[mask], *heirs);
    initialise_reshaped(*column, edit, heirs);
    initialise_around_reshaped(*column, heirs);
    if (heirs)
      heirs->restore_momentum(*this, column->masses(), [&](Slot v, const Vec3& shift) {
        velocity_->write(v, Record((*velocity_)[v].vec() + shift));
      });
  }
}

void EmbeddedMap::take_back(const Closing& closing) noexcept {
  std::size_t n = 0;
  each_publication([&](auto& to, const auto& from) {
    if (n++ < closing.published) to.resize(to.size() - from.size());
  });
  for (std::size_t c = closing.columns; c-- > 0;) columns_[c]->rollback();
  for (std::size_t mask = 0; mask < cells_.size(); ++mask)
    if (closing.slots[mask]) cells_[mask]->rollback(events_[mask]);
  for (const auto& column : columns_) column->commit();
}

void EmbeddedMap::give_points(const Edit& edit) {
  const CellIndex& vertices = *cells_[Vertex.mask];
  std::vector<Dart> darts;
  for (Slot v : events_[Vertex.mask].births) {
    std::uint32_t given = edit.given_.find(vertices.first_dart(v).value);
    if (given == IndexMap::none) { // not the smallest dart: the next of them
      darts.clear();
      collect(map_, Vertex, vertices.first_dart(v), darts);
      std::sort(darts.begin(), darts.end());
      for (Dart d : darts)
        if (given == IndexMap::none) given = edit.given_.find(d.value);
    }
    CHECK_NOTE(given != IndexMap::none, "a new vertex was given no point");
    const Point& point = edit.points_[given];
    (*position_)[v] = point.position; // births were initialised already, and so are noted as overwritten
    (*rest_)[v] = point.rest;
    (*velocity_)[v] = point.velocity;
  }
}

void EmbeddedMap::move_vertices(const Edit& edit) {
  for (const auto& [d, point] : edit.moves_) {
    if (!map_.alive(d)) continue;
    const Slot v = vertex(d);
    position_->write(v, point.position);
    rest_->write(v, point.rest);
    velocity_->write(v, point.velocity);
  }
}

void EmbeddedMap::initialise_reshaped(ColumnBase& column, const Edit&, const Heirs* heirs) {
  thread_local std::vector<Dart> darts;
  thread_local IndexSet seen, done;
  const Orbit support = column.support();
  const CellIndex& index = *cells_[column.orbit().mask];
  std::vector<Slot>& initialised = initialised_[column.orbit().mask];
  seen.clear();
  done.clear();
  for (Slot slot : events_[column.orbit().mask].births) done.insert(slot); // just initialised
  if (heirs)
    heirs->each_slot([&](Slot slot) {
      if (done.insert(slot)) initialised.push_back(slot);
    });
  const auto initialise_around = [&](Dart touched) {
    if (!map_.alive(touched) || seen.contains(touched.value)) return;
    darts.clear();
    collect(map_, support, touched, darts);
    for (Dart d : darts) {
      seen.insert(d.value);
      const Slot slot = index.slot(d);
      if (!done.insert(slot)) continue;
      column.initialise(*this, index, slot);
      initialised.push_back(slot);
    }
  };
  for (int i = 0; i < 4; ++i) {
    if (!support.has(i)) continue;
    for (Dart touched : journal_.touched[static_cast<std::size_t>(i)]) initialise_around(touched);
  }
}

// Calls f(list of a subscriber, what is appended to it) in an order that is always the same.
template <class F> void EmbeddedMap::each_publication(F&& f) {
  for (Changes* changes : readers_) {
    f(changes->reshaped, reshaped_);
    for (std::size_t i = 0; i < 4; ++i) f(changes->touched[i], journal_.touched[i]);
    for (std::size_t mask = 0; mask < cells_.size(); ++mask) {
      if (!cells_[mask]) continue;
      const SlotEvents& events = events_[mask];
      f(changes->moved[mask], events.moved);
      f(changes->slots[mask], events.settled);
      f(changes->slots[mask], events.deaths);
      f(changes->slots[mask], initialised_[mask]);
    }
  }
}

void EmbeddedMap::publish(Closing& closing) {
  each_publication([&](auto& to, const auto& from) {
    to.insert(to.end(), from.begin(), from.end());
    ++closing.published;
  });
  for (Changes* changes : readers_) changes->any = true;
}

Edit::Edit(GMap& map, Journal& journal, EmbeddedMap& embedded) : MapEdit(map, &journal), embedded_(embedded) {
  for (const auto& column : embedded.columns()) inherits_ = inherits_ || column->inheritance();
}

std::uint32_t Edit::add_point(const Point& point) {
  points_.push_back(point);
  return static_cast<std::uint32_t>(points_.size() - 1);
}

void Edit::give(Dart d, std::uint32_t point) {
  gifts_.push_back({d.value, given_.find(d.value)});
  try {
    given_.assign(d.value, point);
  } catch (...) {
    gifts_.pop_back();
    throw;
  }
}

bool Edit::is_new(Dart d) const {
  return embedded_.cells(Vertex).find(d) == no_slot;
}

// A vertex that moves has its old point until the edit closes.
Point Edit::point(Dart d) const {
  if (const std::uint32_t given = given_.find(d.value); given != IndexMap::none) return points_[given];
  const Slot v = embedded_.cells(Vertex).find(d);
  CHECK_NOTE(v != no_slot, "the dart was created by this edit and given no point");
  return {embedded_.position()[v], embedded_.rest()[v], embedded_.velocity()[v]};
}

void Edit::inherit(Dart child, Orbit orbit, std::span<const Parent> parents) {
  inherit(child, orbit, add_family(orbit, parents));
}

std::span<const Parent> Edit::parents(Dart child, Orbit orbit) const {
  return lineage_ ? lineage_->parents(child, orbit).value_or(std::span<const Parent>())
                  : std::span<const Parent>();
}

Lineage& Edit::lineage() {
  if (!lineage_) lineage_ = std::make_unique<Lineage>();
  return *lineage_;
}

std::uint32_t Edit::add_family(Orbit orbit, std::span<const Parent> parents) {
  double sum = 0;
  std::vector<Parent> old; // the parents that are from before the edit, in place of new ones
  bool orphan = false;
  const auto add = [&](Dart d, double weight) {
    for (Parent& each : old)
      if (each.dart == d) return void(each.weight += weight);
    old.push_back({d, weight});
  };
  for (const Parent& parent : parents) {
    sum += parent.weight;
    if (const auto own = lineage().parents(parent.dart, orbit)) {
      orphan = orphan || own->empty();
      for (const Parent& each : *own) add(each.dart, parent.weight * each.weight);
    } else if (embedded_.cells(Vertex).find(parent.dart) != no_slot) {
      add(parent.dart, parent.weight);
    } else {
      orphan = true;
    }
  }
  CHECK_NOTE(std::abs(sum - 1) < 1e-9, "the weights of the parents of a dart do not sum up to 1");
  if (orphan) old.clear();
  return lineage().add_family(old);
}

Edit::Savepoint Edit::savepoint() const {
  return {MapEdit::savepoint(), lineage_ ? lineage_->savepoint() : Lineage::Savepoint{}, points_.size(),
          gifts_.size(), moves_.size()};
}

void Edit::rollback(const Savepoint& to) noexcept {
  MapEdit::rollback(to.map);
  if (lineage_) lineage_->rollback(to.lineage);
  for (; gifts_.size() > to.given; gifts_.pop_back()) given_.replace(gifts_.back().first, gifts_.back().second);
  moves_.erase(moves_.begin() + static_cast<std::ptrdiff_t>(to.moves), moves_.end());
  points_.erase(points_.begin() + static_cast<std::ptrdiff_t>(to.points), points_.end());
}

} // namespace rend
