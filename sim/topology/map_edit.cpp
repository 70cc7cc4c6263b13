#include "sim/topology/map_edit.h"

#include "sim/topology/index_set.h"
#include "sim/topology/walk.h"

#include <algorithm>

namespace rend {

bool Journal::empty() const {
  for (const auto& list : touched)
    if (!list.empty()) return false;
  return created.empty() && removed.empty();
}

void Journal::clear() {
  for (auto& list : touched) list.clear();
  created.clear();
  removed.clear();
}

Dart MapEdit::add_dart() {
  // What this edit has removed may still be spoken of, by a law's candidates: it is not used again before the
  // next.
  const bool again = !map_.free_.empty() && (!journal_ || journal_->removed.empty());
  const Dart d = again ? Dart{map_.free_.back()} : Dart{map_.links_.size()};
  if (!again) {
    CHECK_NOTE(d.value != Dart::none_value, "a map holds at most 2^32 - 1 darts");
    map_.links_.emplace_back().fill(Dart::none_value);
  }
  if (journal_) {
    try {
      journal_->created.push_back(d);
    } catch (...) {
      if (!again) map_.links_.pop_back();
      throw;
    }
  }
  if (again) map_.free_.pop_back();
  map_.links_[d.value].fill(d.value);
  return d;
}

void MapEdit::remove_dart(Dart d) {
  CHECK(map_.alive(d));
  for (int i = 0; i < 4; ++i) CHECK(map_.is_free(i, d));
  map_.free_.push_back(d.value);
  if (journal_) {
    try {
      journal_->removed.push_back(d);
    } catch (...) {
      map_.free_.pop_back();
      throw;
    }
  }
  map_.links_[d.value].fill(Dart::none_value);
}

void MapEdit::note_cut(int i, std::span<const Dart> pairs) {
  try {
    note(i, pairs);
  } catch (...) {
    for (std::size_t n = 0; n < pairs.size(); n += 2) join(i, pairs[n], pairs[n + 1]);
    throw;
  }
}

MapEdit::Savepoint MapEdit::savepoint() const {
  CHECK(journal_);
  Savepoint now{{}, journal_->created.size(), journal_->removed.size(), map_.capacity()};
  for (std::size_t i = 0; i < 4; ++i) now.touched[i] = journal_->touched[i].size();
  return now;
}

void MapEdit::rollback(const Savepoint& to) noexcept {
  for (std::size_t n = to.removed; n < journal_->removed.size();
       ++n) { // a removed dart was free in all its links
    const Dart d = journal_->removed[n];
    if (!map_.alive(d)) map_.links_[d.value].fill(d.value);
  }
  for (std::size_t i = 0; i < 4; ++i) undo_links(i, to.touched[i]);
  undo_darts(to);
}

void MapEdit::undo_links(std::size_t i, std::size_t from) noexcept {
  std::vector<Dart>& touched = journal_->touched[i];
  for (std::size_t n = touched.size(); n > from; n -= 2) {
    const std::uint32_t a = touched[n - 2].value, b = touched[n - 1].value;
    const bool linked = map_.links_[a][i] == b;
    map_.links_[a][i] = linked ? a : b;
    map_.links_[b][i] = linked ? b : a;
  }
  touched.resize(from);
}

// Darts beyond the old capacity are left out: none of them was free then. Without them the others still form a
// stack, which never needs more room than it had.
void MapEdit::undo_darts(const Savepoint& to) noexcept {
  std::vector<std::uint32_t>& free = map_.free_;
  std::vector<Dart>&created = journal_->created, &removed = journal_->removed;
  const auto is_new = [&](std::uint32_t d) { return d >= to.capacity; };
  const auto drop_new = [&](std::vector<Dart>& list, std::size_t least) {
    while (list.size() > least && is_new(list.back().value)) list.pop_back();
    return list.size() > least;
  };
  std::erase_if(free, is_new);
  std::size_t untouched = free.size(); // of the list of free darts, from the bottom
  for (;;) {
    const bool some_created = drop_new(created, to.created), some_removed = drop_new(removed, to.removed);
    if (some_removed && !free.empty() && free.back() == removed.back().value) {
      free.pop_back();
      removed.pop_back();
      untouched = std::min(untouched, free.size());
    } else if (some_created) {
      free.push_back(created.back().value);
      created.pop_back();
    } else {
      break;
    }
  }
  map_.links_.resize(to.capacity);
  for (std::size_t n = untouched; n < free.size(); ++n) map_.links_[free[n]].fill(Dart::none_value);
}

void MapEdit::reserve(std::size_t darts) {
  map_.links_.reserve(darts);
}

Dart MapEdit::add_linked(std::span<const GMap::Links> links) {
  CHECK(!journal_ && map_.free_.empty());
  const std::size_t first = map_.links_.size();
  CHECK_NOTE(first + links.size() < Dart::none_value, "a map holds at most 2^32 - 1 darts");
  map_.links_.insert(map_.links_.end(), links.begin(), links.end());
  for (std::size_t d = first; d < map_.links_.size(); ++d)
    for (std::uint32_t& link : map_.links_[d]) link += static_cast<std::uint32_t>(first);
  return Dart{first};
}

namespace {

struct Pairs {
  std::vector<std::pair<Dart, Dart>> list;
  IndexMap left, right; // dart → number of its pair
};

// Pairs the darts of orbit(d) and orbit(e) that the same words lead to. False: the orbits are not isomorphic.
bool pair_orbits(const GMap& map, Orbit orbit, Dart d, Dart e, Pairs& pairs) {
  pairs.left.clear();
  pairs.right.clear();
  pairs.left.insert(d.value, 0);
  pairs.right.insert(e.value, 0);
  pairs.list.assign(1, {d, e});
  for (std::size_t at = 0; at < pairs.list.size(); ++at) {
    for (int i = 0; i < 4; ++i) {
      if (!orbit.has(i)) continue;
      const Dart a = map.alpha(i, pairs.list[at].first), b = map.alpha(i, pairs.list[at].second);
      const auto next = static_cast<std::uint32_t>(pairs.list.size());
      const std::uint32_t pair_a = pairs.left.insert(a.value, next), pair_b = pairs.right.insert(b.value, next);
      if (pair_a != pair_b) return false;
      if (pair_a == next) pairs.list.push_back({a, b});
    }
  }
  return true;
}

} // namespace

bool sew(MapEdit& edit, int i, Dart d, Dart e) {
  const GMap& map = edit.map();
  if (i == 3 && map.dimension() == 2) return false;
  thread_local Pairs pairs;
  if (!pair_orbits(map, sewing_orbit(i), d, e, pairs)) return false;
  for (const auto& [a, b] : pairs.list) {
    if (!map.is_free(i, a) || !map.is_free(i, b) || a == b) return false;
    // If the two orbits coincide (an edge sewn to itself), a pair and its mirror image must agree.
    const std::uint32_t mirror = pairs.left.find(b.value);
    if (mirror != IndexMap::none && pairs.list[mirror].second != a) return false;
  }
  for (const auto& [a, b] : pairs.list)
    if (map.is_free(i, a)) edit.link(i, a, b);
  return true;
}

bool unsew(MapEdit& edit, int i, Dart d) {
  const GMap& map = edit.map();
  if (map.is_free(i, d)) return false;
  std::array<Dart, 16> pairs; // collected for one journal entry per face
  std::size_t count = 0;
  const auto open = [&](Dart a) {
    if (map.is_free(i, a)) return; // if the orbit is sewn to itself, this pair was unlinked already
    pairs[count++] = a;
    pairs[count++] = edit.cut(i, a);
    if (count < pairs.size()) return;
    edit.note_cut(i, pairs);
    count = 0;
  };
  switch (i) { // sewing_orbit(i), none of whose links is αi
  case 0:
    walk_two(map, 2, 3, d, open);
    break;
  case 1:
    walk_two(map, 3, 3, d, open);
    break;
  case 2:
    walk_two(map, 0, 0, d, open);
    break;
  default:
    walk_two(map, 0, 1, d, open);
  }
  edit.note_cut(i, std::span(pairs).first(count));
  return true;
}

void remove_orbit(MapEdit& edit, Orbit orbit, Dart d) {
  const std::vector<Dart> darts = darts_of(edit.map(), orbit, d);
  for (Dart a : darts)
    for (int i = 3; i >= 0; --i)
      if (!edit.map().is_free(i, a)) edit.unlink(i, a);
  for (Dart a : darts) edit.remove_dart(a);
}

} // namespace rend
