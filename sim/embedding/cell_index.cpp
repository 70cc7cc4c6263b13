#include "sim/embedding/cell_index.h"

#include "sim/base/archive.h"
#include "sim/topology/walk.h"

#include <algorithm>

namespace rend {

void SlotEvents::clear() {
  splits.clear();
  merges.clear();
  births.clear();
  deaths.clear();
  settled.clear();
  moved.clear();
}

CellIndex::CellIndex(const GMap& map, Orbit orbit) : orbit_(orbit), slot_of_dart_(map.capacity(), no_slot) {
  std::vector<Dart>
      darts; // of one orbit; those that were reached have their slot, so that none is marked besides
  map.for_each_dart([&](Dart first) {
    if (slot_of_dart_[first.value] != no_slot) return;
    const Slot slot = static_cast<Slot>(first_dart_.size());
    slot_of_dart_[first.value] = slot;
    darts.assign(1, first);
    for (std::size_t n = 0; n < darts.size(); ++n) {
      for (int i = 0; i < 4; ++i) {
        if (!orbit_.has(i)) continue;
        const Dart next = map.alpha(i, darts[n]);
        if (slot_of_dart_[next.value] != no_slot) continue;
        slot_of_dart_[next.value] = slot;
        darts.push_back(next);
      }
    }
    first_dart_.push_back(first); // darts come in increasing order: the first is the smallest
  });
  first_dart_.shrink_to_fit();
}

void CellIndex::store(Archive& archive) {
  archive(slot_of_dart_, first_dart_, free_);
}

std::size_t CellIndex::bytes() const {
  return (slot_of_dart_.size() + first_dart_.size() + free_.size()) * sizeof(Slot);
}

Slot CellIndex::new_slot() {
  if (!free_.empty()) {
    const Slot slot = free_.back();
    free_.pop_back();
    return slot;
  }
  first_dart_.emplace_back();
  return static_cast<Slot>(first_dart_.size() - 1);
}

// An orbit, after the edit, that holds a dart the edit touched.
struct CellIndex::Fragment {
  Dart smallest;
  std::size_t begin, end; // its darts, in Scratch::darts
};

namespace {

// Kept between edits so that a steady run allocates nothing.
struct Scratch {
  std::vector<Dart> darts;     // of all fragments, one after another
  std::vector<Slot> affected;  // slots that may have lost all their darts
  std::vector<Slot> old_slots; // of one fragment, each once, in the order of its darts
  IndexSet seen;               // darts that were collected
  IndexSet met;                // old slots of one fragment
  IndexSet claimed;            // slots that live on
};
thread_local Scratch scratch;

} // namespace

void CellIndex::update(const GMap& map, const Journal& journal, SlotEvents& events) {
  events.clear();
  scratch.affected.clear();
  scratch.claimed.clear();
  for (Dart d : journal.removed) {
    if (d.value >= slot_of_dart_.size()) continue; // created and removed by the same edit
    if (slot_of_dart_[d.value] != no_slot) scratch.affected.push_back(slot_of_dart_[d.value]);
    slot_of_dart_[d.value] = no_slot;
  }
  if (slot_of_dart_.size() < map.capacity()) slot_of_dart_.resize(map.capacity(), no_slot);

  thread_local std::vector<Fragment> fragments;
  fragments.clear();
  scratch.darts.clear();
  scratch.seen.clear();
  // Marks every dart, or one of each pair {d, α1(d)}.
  const auto marked = [&](Dart d) { return (orbit_.has(1) ? std::min(d, map.alpha(1, d)) : d).value; };
  const auto visit = [&](Dart d) {
    if (!map.alive(d) || scratch.seen.contains(marked(d))) return;
    const std::size_t begin = scratch.darts.size();
    collect(map, orbit_, d, scratch.darts);
    Dart smallest = d;
    for (std::size_t n = begin; n < scratch.darts.size(); ++n) {
      const Dart e = scratch.darts[n];
      if (marked(e) == e.value) scratch.seen.insert(e.value);
      smallest = std::min(smallest, e);
    }
    fragments.push_back({smallest, begin, scratch.darts.size()});
  };
  for (int i = 0; i < 4; ++i)
    if (orbit_.has(i))
      for (Dart d : journal.touched[static_cast<std::size_t>(i)]) visit(d);
  for (Dart d : journal.created) visit(d);

  std::sort(fragments.begin(), fragments.end(),
            [](const Fragment& a, const Fragment& b) { return a.smallest < b.smallest; });
  for (Fragment& fragment : fragments) settle(fragment, events);

  // What nobody claimed was absorbed (named in merges already) or is gone.
  std::sort(scratch.affected.begin(), scratch.affected.end());
  scratch.affected.erase(std::unique(scratch.affected.begin(), scratch.affected.end()), scratch.affected.end());
  std::erase_if(events.merges, [](const auto& merge) { return scratch.claimed.contains(merge.second); });
  for (Slot slot : scratch.affected) {
    if (scratch.claimed.contains(slot)) continue;
    first_dart_[slot] = Dart{};
    free_.push_back(slot);
    events.deaths.push_back(slot);
  }
}

// Gives a fragment its slot. Fragments come by increasing smallest dart, so that the first to ask keeps the
// slot.
void CellIndex::settle(Fragment& fragment, SlotEvents& events) {
  Dart* const begin = scratch.darts.data() + fragment.begin;
  Dart* const end = scratch.darts.data() + fragment.end;
  Dart oldest; // the smallest dart that had a slot
  Slot last = no_slot;
  scratch.old_slots.clear();
  scratch.met.clear();
  for (Dart* d = begin; d != end; ++d) {
    const Slot old = slot_of_dart_[d->value];
    if (old == no_slot) continue;
    if (!oldest || *d < oldest) oldest = *d;
    if (old == last) continue; // mostly
    last = old;
    if (scratch.met.insert(old)) scratch.old_slots.push_back(old);
  }
  scratch.affected.insert(scratch.affected.end(), scratch.old_slots.begin(), scratch.old_slots.end());

  Slot slot = no_slot;
  if (oldest && !scratch.claimed.contains(slot_of_dart_[oldest.value])) slot = slot_of_dart_[oldest.value];
  if (slot == no_slot) {
    for (Slot old : scratch.old_slots)
      if (!scratch.claimed.contains(old)) slot = std::min(slot, old); // no_slot is the largest
  }
  if (slot == no_slot) {
    slot = new_slot();
    if (oldest)
      events.splits.push_back({slot_of_dart_[oldest.value], slot});
    else
      events.births.push_back(slot);
  }
  scratch.claimed.insert(slot);
  events.settled.push_back(slot);
  for (Slot old : scratch.old_slots)
    if (old != slot && !scratch.claimed.contains(old)) events.merges.push_back({slot, old});

  first_dart_[slot] = fragment.smallest;
  for (Dart* d = begin; d != end; ++d) {
    if (slot_of_dart_[d->value] == slot) continue;
    slot_of_dart_[d->value] = slot;
    events.moved.push_back(*d);
  }
}

} // namespace rend
