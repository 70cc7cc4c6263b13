#include "sim/topology/walk.h"

#include <algorithm>

namespace rend {
namespace {

void flood(const GMap& map, Orbit orbit, Dart d, std::vector<Dart>& out) {
  thread_local IndexSet seen;
  seen.clear();
  seen.insert(d.value);
  std::size_t at = out.size();
  out.push_back(d);
  for (; at < out.size(); ++at) {
    for (int i = 0; i < 4; ++i) {
      if (!orbit.has(i)) continue;
      const Dart next = map.alpha(i, out[at]);
      if (next != out[at] && seen.insert(next.value)) out.push_back(next);
    }
  }
}

// <i,j,k>(d), where αk commutes with αi and αj: the orbit <i,j> and its image.
void mirrored(const GMap& map, int i, int j, int k, Dart d, std::vector<Dart>& out) {
  const std::size_t begin = out.size();
  walk_two(map, i, j, d, [&](Dart e) { out.push_back(e); });
  const std::size_t end = out.size();
  const Dart image = map.alpha(k, d);
  if (std::find(out.begin() + begin, out.begin() + end, image) != out.begin() + end) return;
  for (std::size_t n = begin; n < end; ++n) out.push_back(map.alpha(k, out[n]));
}

// <i,i+1,i+2>(d): a volume face after face, or the vertex of a solid one volume's corner after another. Those pieces,
// <i,i+1>, are walked without marks; of a pair {e, αi(e)}, which αi+2 takes to a pair, the smaller dart alone is marked.
void piece_by_piece(const GMap& map, int i, Dart d, std::vector<Dart>& out) {
  thread_local IndexSet seen;
  seen.clear();
  std::size_t at = out.size();
  const auto piece = [&](Dart first) {
    walk_two(map, i, i + 1, first, [&](Dart e) {
      out.push_back(e);
      if (e <= map.alpha(i, e)) seen.insert(e.value);
    });
  };
  piece(d);
  for (; at < out.size(); ++at) {
    const Dart e = out[at], next = map.alpha(i + 2, e);
    if (next == e || map.alpha(i, e) < e) continue;
    if (!seen.contains(std::min(next, map.alpha(i, next)).value)) piece(next);
  }
}

} // namespace

void collect(const GMap& map, Orbit orbit, Dart d, std::vector<Dart>& out) {
  if (map.dimension() == 2) orbit.mask = static_cast<std::uint8_t>(orbit.mask & 7); // every dart is α3-free
  const auto push = [&](Dart e) { out.push_back(e); };
  const auto one = [&](int i) {
    out.push_back(d);
    if (!map.is_free(i, d)) out.push_back(map.alpha(i, d));
  };
  switch (orbit.mask) {
  case 0:
    return push(d);
  case 1:
    return one(0);
  case 2:
    return one(1);
  case 4:
    return one(2);
  case 8:
    return one(3);
  case 3:
    return walk_two(map, 0, 1, d, push);
  case 5:
    return walk_two(map, 0, 2, d, push);
  case 6:
    return walk_two(map, 1, 2, d, push);
  case 9:
    return walk_two(map, 0, 3, d, push);
  case 10:
    return walk_two(map, 1, 3, d, push);
  case 12:
    return walk_two(map, 2, 3, d, push);
  case 13:
    return mirrored(map, 2, 3, 0, d, out);
  case 11:
    return mirrored(map, 0, 1, 3, d, out);
  case 7:
    return piece_by_piece(map, 0, d, out);
  case 14:
    return piece_by_piece(map, 1, d, out);
  default:
    return flood(map, orbit, d, out);
  }
}

std::vector<Dart> darts_of(const GMap& map, Orbit orbit, Dart d) {
  std::vector<Dart> out;
  collect(map, orbit, d, out);
  return out;
}

Dart smallest_dart(const GMap& map, Orbit orbit, Dart d) {
  const std::vector<Dart> darts = darts_of(map, orbit, d);
  return *std::min_element(darts.begin(), darts.end());
}

bool same_cell(const GMap& map, Orbit orbit, Dart a, Dart b) {
  const std::vector<Dart> darts = darts_of(map, orbit, a);
  return std::find(darts.begin(), darts.end(), b) != darts.end();
}

} // namespace rend
