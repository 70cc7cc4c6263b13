#include "sim/topology/map_edit.h"

#include "sim/topology/index_set.h"
#include "sim/topology/walk.h"

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
  Dart d;
  if (map_.free_.empty()) {
    d = Dart{map_.links_.size()};
    CHECK_NOTE(d.value != Dart::none_value, "a map holds at most 2^32 - 1 darts");
    map_.links_.emplace_back();
  } else {
    d = Dart{map_.free_.back()};
    map_.free_.pop_back();
  }
  map_.links_[d.value].fill(d.value);
  if (journal_) journal_->created.push_back(d);
  return d;
}

void MapEdit::remove_dart(Dart d) {
  CHECK(map_.alive(d));
  for (int i = 0; i < 4; ++i) CHECK(map_.is_free(i, d));
  map_.links_[d.value].fill(Dart::none_value);
  map_.free_.push_back(d.value);
  if (journal_) journal_->removed.push_back(d);
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
    edit.note(i, pairs);
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
  edit.note(i, std::span(pairs).first(count));
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
