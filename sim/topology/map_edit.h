// The only writer of a GMap. It keeps the journal that everything built upon the map is brought up to date
// from.
//
// The journal: for every i, the darts whose αi changed; the darts created; the darts removed. A dart may stand
// in it more than once. Touched darts come in pairs, those that were linked to each other or let go of each other.
#pragma once

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

private:
  GMap& map_;
  Journal* journal_;
};

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
