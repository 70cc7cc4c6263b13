#include "sim/topology/walk.h"

#include "sim/topology/append_orbit.h"

#include <algorithm>

namespace rend {
void collect(const GMap& map, Orbit orbit, Dart d, std::vector<Dart>& out) {
  thread_local Marks marks;
  marks.fit(map.capacity());
  const std::size_t begin = out.size();
  try {
    if (!append_orbit(map, orbit, d, out, marks)) return;
  } catch (...) { // no memory left, with some darts marked
    marks = Marks();
    throw;
  }
  for (std::size_t n = begin; n < out.size(); ++n) marks.clear_word(out[n].value);
}

void collect_marked(const GMap& map, Orbit orbit, Dart d, std::vector<Dart>& out, Marks& marks) {
  const std::size_t begin = out.size();
  if (append_orbit(map, orbit, d, out, marks)) return;
  for (std::size_t n = begin; n < out.size(); ++n) marks.set(out[n].value);
}

std::vector<Dart> darts_of(const GMap& map, Orbit orbit, Dart d) {
  std::vector<Dart> out;
  collect(map, orbit, d, out);
  return out;
}

Dart smallest_dart(const GMap& map, Orbit orbit, Dart d) {
  thread_local std::vector<Dart> darts; // keeps its capacity, since criteria call this in every step
  darts.clear();
  collect(map, orbit, d, darts);
  return *std::min_element(darts.begin(), darts.end());
}

bool same_cell(const GMap& map, Orbit orbit, Dart a, Dart b) {
  const std::vector<Dart> darts = darts_of(map, orbit, a);
  return std::find(darts.begin(), darts.end(), b) != darts.end();
}

int sides_of_face(const GMap& map, Dart d) {
  int darts = 0;
  bool closed = true;
  walk_two(map, 0, 1, d, [&](Dart e) {
    ++darts;
    closed = closed && !map.is_free(0, e) && !map.is_free(1, e);
  });
  return closed ? darts / 2 : 0;
}

} // namespace rend
