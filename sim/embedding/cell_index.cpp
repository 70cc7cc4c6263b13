#include "sim/embedding/cell_index.h"

#include "sim/base/archive.h"
#include "sim/topology/append_orbit.h"
#include "sim/topology/dart_sort.h"
#include "sim/topology/walk.h"

#include <fmt/format.h>

#include <algorithm>

namespace rend {

void SlotEvents::clear() {
  splits.clear();
  merges.clear();
  births.clear();
  deaths.clear();
  settled.clear();
  moved.clear();
  origins.clear();
  lost.clear();
  renamed.clear();
  reused.clear();
  slots_before = buried = 0;
}

CellIndex::CellIndex(const GMap& map, Orbit orbit) : orbit_(orbit), slot_of_dart_(map.capacity()) {
  number(map);
  if (!orbit.has(map.dimension())) slot_of_dart_.pack();
}

namespace {

// A set of visited darts (append_orbit.h): those that have a slot.
struct Numbered {
  SlotTable& slots;
  Slot next;
  bool has(std::uint32_t d) const { return slots[Dart{d}] != no_slot; }
  void set(std::uint32_t d) { slots.set(Dart{d}, next); }
  bool insert(std::uint32_t d) {
    if (has(d)) return false;
    set(d);
    return true;
  }
};

} // namespace

// Darts come in increasing order: the first visited of an orbit is its smallest.
void CellIndex::number(const GMap& map) {
  std::vector<Dart> darts;
  Numbered seen{slot_of_dart_, 0};
  map.for_each_dart([&](Dart first) {
    if (seen.has(first.value)) return;
    darts.clear();
    if (!append_orbit(map, orbit_, first, darts, seen))
      for (const Dart d : darts) seen.set(d.value);
    first_dart_.push_back(first);
    ++seen.next;
  });
  first_dart_.shrink_to_fit();
}

bool CellIndex::in_order() const {
  return free_.empty() && std::is_sorted(first_dart_.begin(), first_dart_.end());
}

void CellIndex::renumber(const GMap& map, std::vector<Slot>& from) {
  std::vector<std::uint64_t> order; // smallest dart, and slot
  order.reserve(count());
  for (Slot s = 0; s < slots(); ++s)
    if (alive(s)) order.push_back(std::uint64_t{first_dart_[s].value} << 32 | s);
  sort_by_dart(order);
  std::vector<Slot> now(slots(), no_slot);
  from.resize(order.size());
  first_dart_.resize(order.size());
  for (Slot s = 0; s < order.size(); ++s) {
    from[s] = static_cast<Slot>(order[s] & 0xffffffffu);
    first_dart_[s] = Dart{order[s] >> 32};
    now[from[s]] = s;
  }
  free_.clear();
  slot_of_dart_.rename(now);
  if (!orbit_.has(map.dimension())) slot_of_dart_.pack();
}

// An edit assigns new slots before it frees dead ones: there may be more slots than darts, but at most twice as
// many.
void CellIndex::store(Archive& archive, const GMap& map) {
  slot_of_dart_.store(archive, map.capacity());
  archive.list(first_dart_, 2 * map.capacity(), "there are more slots than darts ever had");
  archive.list(free_, first_dart_.size(), "there are more free slots than slots");
  if (!archive.reading()) return;
  if (const auto found = fault(map)) throw ArchiveError(*found);
}

std::optional<std::string> CellIndex::fault_of_free() const {
  std::vector<bool> listed(slots());
  for (const Slot slot : free_) {
    if (slot >= slots() || alive(slot) || listed[slot])
      return fmt::format("{}: slot {} is listed as free, and is not, or is twice", name(orbit_), slot);
    listed[slot] = true;
  }
  const auto dead = std::count(first_dart_.begin(), first_dart_.end(), Dart{});
  if (static_cast<std::size_t>(dead) != free_.size())
    return fmt::format("{}: of {} free slots {} are listed", name(orbit_), dead, free_.size());
  return {};
}

// Each slot's orbit is walked from its smallest dart: if all walks together are as long as the number of darts,
// no orbit was left out.
std::optional<std::string> CellIndex::fault(const GMap& map) const {
  if (slot_of_dart_.size() != map.capacity()) return fmt::format("{}: not every dart has a slot", name(orbit_));
  std::size_t walked = 0;
  std::vector<Dart> darts;
  for (Slot slot = 0; slot < slots(); ++slot) {
    if (!alive(slot)) continue;
    const Dart first = first_dart_[slot];
    if (!map.alive(first)) return fmt::format("slot {} of {} lives without darts", slot, name(orbit_));
    darts.clear();
    collect(map, orbit_, first, darts);
    for (const Dart d : darts)
      if (slot_of_dart_[d] != slot || d < first)
        return fmt::format("{} of dart {}: dart {} has another slot, or is smaller", name(orbit_), first.value,
                           d.value);
    walked += darts.size();
  }
  if (walked != map.dart_count())
    return fmt::format("{}: of {} darts {} have a slot", name(orbit_), map.dart_count(), walked);
  for (std::uint32_t d = 0; d < map.capacity(); ++d)
    if (!map.alive(Dart{d}) && slot_of_dart_[Dart{d}] != no_slot)
      return fmt::format("{}: dart {} was removed and has a slot", name(orbit_), d);
  return fault_of_free();
}

std::size_t CellIndex::bytes() const {
  return slot_of_dart_.bytes() + (first_dart_.size() + free_.size()) * sizeof(Slot);
}

Slot CellIndex::new_slot(SlotEvents& events) {
  if (!free_.empty()) {
    const Slot slot = free_.back();
    events.reused.push_back(slot);
    free_.pop_back();
    return slot;
  }
  first_dart_.emplace_back();
  return static_cast<Slot>(first_dart_.size() - 1);
}

// An orbit, after the edit, that contains a touched dart.
struct CellIndex::Fragment {
  Dart smallest;
  std::uint32_t begin, end; // its darts, in Scratch::darts
  Slot old; // of all its darts before the edit; no_slot: they had several, or one of them had none
};

namespace {

// Scratch memory, kept between edits to avoid allocation.
struct Scratch {
  std::vector<Dart> darts;          // of all fragments, one after another
  std::vector<std::uint64_t> order; // smallest dart, and number of its fragment
  std::vector<Slot> affected;       // slots that may have lost all their darts
  std::vector<Slot> old_slots;      // of one fragment, without repetition, in the order of its darts
  Marks reached;                    // darts that were collected
  Marks met;                        // old slots of one fragment already seen
  Marks claimed;                    // slots that are kept
};
thread_local Scratch scratch;

} // namespace

void CellIndex::update(const GMap& map, const Journal& journal, SlotEvents& events) {
  events.clear();
  events.slots_before = slots();
  slot_of_dart_.begin_edit();
  scratch.affected.clear();
  for (Dart d : journal.removed) {
    if (d.value >= slot_of_dart_.size()) continue; // created and removed by the same edit
    if (slot_of_dart_[d] == no_slot) continue;
    scratch.affected.push_back(slot_of_dart_[d]);
    events.lost.push_back({d, slot_of_dart_[d]});
    slot_of_dart_.set(d, no_slot);
  }
  slot_of_dart_.resize(map.capacity());

  thread_local std::vector<Fragment> fragments;
  fragments.clear();
  find_fragments(map, journal, fragments);
  scratch.claimed.fit(first_dart_.size() + fragments.size());
  scratch.met.fit(first_dart_.size() + fragments.size());
  sort_by_dart(scratch.order);
  for (const std::uint64_t key : scratch.order) settle(fragments[key & 0xffffffffu], events);
  bury(events);

  for (const Dart d : scratch.darts) scratch.reached.clear_word(d.value);
  for (const Slot slot : events.settled) scratch.claimed.clear_word(slot);
}

void CellIndex::rollback(const SlotEvents& events) noexcept {
  scratch.reached = scratch.met = scratch.claimed = Marks(); // in case the update did not come to its end
  slot_of_dart_.rollback();
  std::size_t n = 0;
  for (const SlotEvents::Origin& origin : events.origins)
    for (; n < origin.end; ++n)
      if (events.moved[n].value < slot_of_dart_.size()) slot_of_dart_.set(events.moved[n], origin.from);
  for (const auto& [dart, slot] : events.lost) slot_of_dart_.set(dart, slot); // also if used again, and moved

  free_.resize(free_.size() - events.buried);
  for (std::size_t k = events.reused.size(); k-- > 0;) {
    free_.push_back(events.reused[k]); // where it was: no memory is needed
    first_dart_[events.reused[k]] = Dart{};
  }
  for (std::size_t k = events.renamed.size(); k-- > 0;)
    first_dart_[events.renamed[k].first] = events.renamed[k].second;
  first_dart_.resize(events.slots_before);
}

void CellIndex::find_fragments(const GMap& map, const Journal& journal, std::vector<Fragment>& fragments) {
  Scratch& my = scratch;
  my.darts.clear();
  my.order.clear();
  my.reached.fit(map.capacity());
  const auto visit = [&](Dart d) {
    if (my.reached.has(d.value) || !map.alive(d)) return;
    fragments.push_back(fragment_at(map, d));
    my.order.push_back(std::uint64_t{fragments.back().smallest.value} << 32 | (fragments.size() - 1));
  };
  for (int i = 0; i < 4; ++i)
    if (orbit_.has(i))
      for (const Dart d : journal.touched[static_cast<std::size_t>(i)]) visit(d);
  for (const Dart d : journal.created) visit(d);
}

CellIndex::Fragment CellIndex::fragment_at(const GMap& map, Dart d) const {
  Scratch& my = scratch;
  const std::size_t begin = my.darts.size();
  collect_marked(map, orbit_, d, my.darts, my.reached);
  Fragment fragment{d, static_cast<std::uint32_t>(begin), static_cast<std::uint32_t>(my.darts.size()),
                    slot_of_dart_[d]};
  for (const Dart e : std::span(my.darts).subspan(begin)) {
    fragment.smallest = std::min(fragment.smallest, e);
    if (slot_of_dart_[e] != fragment.old) fragment.old = no_slot;
  }
  return fragment;
}

inline void CellIndex::set_first(Slot slot, Dart first, SlotEvents& events) {
  Dart& was = first_dart_[slot];
  if (was == first) return;
  if (was) events.renamed.push_back({slot, was});
  was = first;
}

// Assigns a slot to a fragment. Fragments come by increasing smallest dart, so that the first to claim a slot
// keeps it.
void CellIndex::settle(const Fragment& fragment, SlotEvents& events) {
  Scratch& my = scratch;
  const std::span<const Dart> darts(my.darts.data() + fragment.begin, fragment.end - fragment.begin);
  // Everything is written down before it is done: memory may be exhausted in between.
  Slot slot = fragment.old;
  if (slot == no_slot) {
    slot = slot_for(fragment, events);
    for (const Dart d : darts) {
      const Slot from = slot_of_dart_[d];
      if (from == slot) continue;
      events.moved.push_back(d);
      events.origins.push_back({from, static_cast<std::uint32_t>(events.moved.size())});
      slot_of_dart_.set(d, slot);
    }
  } else if (!my.claimed.insert(slot)) { // a fragment of what was one orbit: the common case
    slot = new_slot(events);
    my.claimed.set(slot);
    events.splits.push_back({fragment.old, slot});
    events.moved.insert(events.moved.end(), darts.begin(), darts.end());
    events.origins.push_back({fragment.old, static_cast<std::uint32_t>(events.moved.size())});
    for (const Dart d : darts) slot_of_dart_.set(d, slot);
  }
  events.settled.push_back(slot);
  set_first(slot, fragment.smallest, events);
}

// The slot of a fragment whose darts had several, or some of them none.
Slot CellIndex::slot_for(const Fragment& fragment, SlotEvents& events) {
  const std::span<const Dart> darts(scratch.darts.data() + fragment.begin, fragment.end - fragment.begin);
  Dart oldest; // the smallest dart that had a slot
  auto& old_slots = scratch.old_slots;
  old_slots.clear();
  for (const Dart d : darts) {
    const Slot old = slot_of_dart_[d];
    if (old == no_slot) continue;
    if (!oldest || d < oldest) oldest = d;
    if (scratch.met.insert(old)) old_slots.push_back(old);
  }
  for (const Slot old : old_slots) scratch.met.clear_word(old);
  scratch.affected.insert(scratch.affected.end(), old_slots.begin(), old_slots.end());

  Slot slot = no_slot;
  if (oldest && !scratch.claimed.has(slot_of_dart_[oldest])) slot = slot_of_dart_[oldest];
  if (slot == no_slot) {
    for (const Slot old : old_slots)
      if (!scratch.claimed.has(old)) slot = std::min(slot, old); // no_slot is the largest
  }
  if (slot == no_slot) {
    slot = new_slot(events);
    if (oldest)
      events.splits.push_back({slot_of_dart_[oldest], slot});
    else
      events.births.push_back(slot);
  }
  scratch.claimed.set(slot);
  for (const Slot old : old_slots)
    if (old != slot && !scratch.claimed.has(old)) events.merges.push_back({slot, old});
  return slot;
}

// Frees the slots that nobody claimed: those absorbed in a merge, and those whose orbit was removed.
void CellIndex::bury(SlotEvents& events) {
  auto& affected = scratch.affected;
  std::sort(affected.begin(), affected.end());
  affected.erase(std::unique(affected.begin(), affected.end()), affected.end());
  std::erase_if(events.merges, [](const auto& merge) { return scratch.claimed.has(merge.second); });
  for (const Slot slot : affected) {
    if (scratch.claimed.has(slot)) continue;
    events.deaths.push_back(slot);
    free_.push_back(slot);
    ++events.buried;
    set_first(slot, Dart{}, events);
  }
}

} // namespace rend
