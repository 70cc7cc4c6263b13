// The walks of walk.h over any set of visited darts: an object with has(dart's number), set() and insert(), as
// Marks has. Numbering all orbits of a map uses the slots that it assigns as that set, and needs no marks.
#pragma once

#include "sim/topology/walk.h"

#include <algorithm>

namespace rend {

template <class Seen> void flood(const GMap& map, Orbit orbit, Dart d, std::vector<Dart>& out, Seen& seen) {
  std::size_t at = out.size();
  out.push_back(d);
  seen.set(d.value);
  for (; at < out.size(); ++at) {
    for (int i = 0; i < 4; ++i) {
      if (!orbit.has(i)) continue;
      const Dart next = map.alpha(i, out[at]);
      if (seen.insert(next.value)) out.push_back(next);
    }
  }
}

// <i,j,k>(d), where αk commutes with αi and αj: the orbit <i,j> and its image under αk.
inline void mirrored(const GMap& map, int i, int j, int k, Dart d, std::vector<Dart>& out) {
  const std::size_t begin = out.size();
  walk_two(map, i, j, d, [&](Dart e) { out.push_back(e); });
  const std::size_t end = out.size();
  const Dart image = map.alpha(k, d);
  if (std::find(out.begin() + begin, out.begin() + end, image) != out.begin() + end) return;
  for (std::size_t n = begin; n < end; ++n) out.push_back(map.alpha(k, out[n]));
}

// <i,i+1,i+2>(d): a volume face by face, or the vertex of a solid corner by corner. Each piece <i,i+1> is
// walked without marks; αi+2 maps a pair {e, αi(e)} to a pair, so one dart of each pair is enough.
template <class Seen> void piece_by_piece(const GMap& map, int i, Dart d, std::vector<Dart>& out, Seen& seen) {
  std::size_t at = out.size();
  const auto piece = [&](Dart first) {
    walk_two(map, i, i + 1, first, [&](Dart e) {
      out.push_back(e);
      seen.set(e.value);
    });
  };
  piece(d);
  for (; at < out.size(); ++at) {
    const Dart e = out[at], next = map.alpha(i + 2, e);
    if (!seen.has(next.value) && map.alpha(i, e) >= e) piece(next);
  }
}

// Appends the darts of orbit(d). Returns whether it marked them on the way.
template <class Seen>
bool append_orbit(const GMap& map, Orbit orbit, Dart d, std::vector<Dart>& out, Seen& seen) {
  if (map.dimension() == 2) orbit.mask = static_cast<std::uint8_t>(orbit.mask & 7); // every dart is α3-free
  const auto push = [&](Dart e) { out.push_back(e); };
  const auto one = [&](int i) {
    out.push_back(d);
    if (!map.is_free(i, d)) out.push_back(map.alpha(i, d));
  };
  switch (orbit.mask) {
  case 0:
    return push(d), false;
  case 1:
    return one(0), false;
  case 2:
    return one(1), false;
  case 4:
    return one(2), false;
  case 8:
    return one(3), false;
  case 3:
    return walk_two(map, 0, 1, d, push), false;
  case 5:
    return walk_two(map, 0, 2, d, push), false;
  case 6:
    return walk_two(map, 1, 2, d, push), false;
  case 9:
    return walk_two(map, 0, 3, d, push), false;
  case 10:
    return walk_two(map, 1, 3, d, push), false;
  case 12:
    return walk_two(map, 2, 3, d, push), false;
  case 13:
    return mirrored(map, 2, 3, 0, d, out), false;
  case 11:
    return mirrored(map, 0, 1, 3, d, out), false;
  case 7:
    return piece_by_piece(map, 0, d, out, seen), true;
  case 14:
    return piece_by_piece(map, 1, d, out, seen), true;
  default:
    return flood(map, orbit, d, out, seen), true;
  }
}

} // namespace rend
