// Walks over the darts of an orbit, for all sixteen orbits.
//
// Orbits of at most two links are a path or a cycle and are walked without marks. So are <0,2,3> and <0,1,3>:
// α0 commutes with α2 and α3, hence <0,2,3>(d) = <2,3>(d) ∪ α0<2,3>(d); and α3 with α0 and α1. The others mark
// visited darts (marks.h); <0,1,2> and <1,2,3> are walked face by face and corner by corner. The order of a
// walk depends on the map and the first dart alone.
#pragma once

#include "sim/topology/gmap.h"
#include "sim/topology/marks.h"

#include <span>
#include <vector>

namespace rend {

// Appends the darts of orbit(d) to `out`, d first.
void collect(const GMap& map, Orbit orbit, Dart d, std::vector<Dart>& out);

// The same, and leaves a mark on each of them. `marks` has room for the map's darts and is clear before.
void collect_marked(const GMap& map, Orbit orbit, Dart d, std::vector<Dart>& out, Marks& marks);

std::vector<Dart> darts_of(const GMap& map, Orbit orbit, Dart d);
Dart smallest_dart(const GMap& map, Orbit orbit, Dart d);
bool same_cell(const GMap& map, Orbit orbit, Dart a, Dart b);

// Follows αi, αj, αi, .. from d and calls f on every dart of <i,j>(d), d first; of <i>(d), if i = j.
template <class F> void walk_two(const GMap& map, int i, int j, Dart d, F&& f) {
  f(d);
  for (Dart at = d;;) {
    Dart next = map.alpha(i, at);
    if (next == at) break; // the end of a path: the rest lies in the other direction
    f(next);
    at = next;
    next = map.alpha(j, at);
    if (next == at) break;
    if (next == d) return; // a full cycle, which always closes by αj
    f(next);
    at = next;
  }
  for (Dart at = d;;) {
    Dart next = map.alpha(j, at);
    if (next == at) return;
    f(next);
    at = next;
    next = map.alpha(i, at);
    if (next == at) return;
    f(next);
    at = next;
  }
}

// The number of sides of the face of d; 0 if it is not closed.
int sides_of_face(const GMap& map, Dart d);

// Calls f on every dart of the vertex of d in a sheet.
template <class F> void walk_sheet_vertex(const GMap& map, Dart d, F&& f) {
  walk_two(map, 1, 2, d, f);
}

} // namespace rend
