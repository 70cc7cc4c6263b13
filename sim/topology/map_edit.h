// The only writer of a GMap. It keeps the journal that everything built upon the map is brought up to date
// from.
//
// The journal: for every i, the darts whose αi changed; the darts created; the darts removed. A dart may stand
// in it more than once. Touched darts come in pairs, those that were linked to each other or let go of each
// other.
#pragma once

#include "sim/base/check.h"
#include "sim/topology/gmap.h"

#include <array>
#include <span>
#include <vector>

namespace rend {

struct Journal {
  std::array<std::vector<Dart>, 4> touched; // touched[i]: darts whose αi changed
  std::vector<Dart> created, removed;
  bool empty() const;
  void clear();
};

class MapEdit {
public:
  // Without a journal: for building a map that nothing is built upon yet.
  explicit MapEdit(GMap& map, Journal* journal = nullptr) : map_(map), journal_(journal) {}

  const GMap& map() const { return map_; }
  const Journal* journal() const { return journal_; } // null: without one

  Dart add_dart();                  // free in all its links
  void remove_dart(Dart d);         // CHECK: free in all its links
  void link(int i, Dart a, Dart b); // αi(a) = b, αi(b) = a. CHECK: both αi-free
  void unlink(int i, Dart a);       // a and αi(a) become αi-free. CHECK: a is not free
  void reserve(std::size_t darts);

  // Appends as many darts as there are links, dart n with αi = the first of them + links[n][i]; returns the
  // first. CHECK: without a journal, and no dart was removed. That the links are involutions is the caller's
  // word.
  Dart add_linked(std::span<const GMap::Links> links);

private:
  friend bool unsew(MapEdit& edit, int i, Dart d);
  Dart cut(int i, Dart a); // unlinks, without a note of it; returns what a was linked to
  void note(int i, std::span<const Dart> pairs) {
    if (!journal_) return;
    std::vector<Dart>& touched = journal_->touched[static_cast<std::size_t>(i)];
    touched.insert(touched.end(), pairs.begin(), pairs.end());
  }

  GMap& map_;
  Journal* journal_;
};

inline void MapEdit::link(int i, Dart a, Dart b) {
  CHECK(map_.alive(a) && map_.alive(b));
  CHECK(map_.is_free(i, a) && map_.is_free(i, b));
  CHECK_NOTE(i < 3 || map_.dimension() == 3, "the darts of a sheet stay α3-free");
  if (a == b) return;
  map_.links_[a.value][static_cast<std::size_t>(i)] = b.value;
  map_.links_[b.value][static_cast<std::size_t>(i)] = a.value;
  note(i, std::array{a, b});
}

inline Dart MapEdit::cut(int i, Dart a) {
  CHECK(map_.alive(a));
  const Dart b = map_.alpha(i, a);
  CHECK(a != b);
  map_.links_[a.value][static_cast<std::size_t>(i)] = a.value;
  map_.links_[b.value][static_cast<std::size_t>(i)] = b.value;
  return b;
}

inline void MapEdit::unlink(int i, Dart a) {
  note(i, std::array{a, cut(i, a)});
}

// Sews αi between d and e, and between all darts of <0..i-2, i+2..3>(d) and (e) that correspond. False, and
// nothing changed: one of them is not αi-free, or the orbits are not isomorphic, or d and e overlap wrongly.
bool sew(MapEdit& edit, int i, Dart d, Dart e);

// The opposite. False, and nothing changed: d is αi-free.
bool unsew(MapEdit& edit, int i, Dart d);

// The links that an αi runs parallel to: <0..i-2, i+2..3>.
constexpr Orbit parallel_to(int i) {
  Orbit orbit;
  for (int j = 0; j < 4; ++j)
    if (j <= i - 2 || j >= i + 2) orbit.mask = static_cast<std::uint8_t>(orbit.mask | 1 << j);
  return orbit;
}

// Unlinks all that still holds the darts of orbit(d) to others by αi, then removes them.
void remove_orbit(MapEdit& edit, Orbit orbit, Dart d);

} // namespace rend
