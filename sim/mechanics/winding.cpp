#include "sim/mechanics/winding.h"

#include "sim/topology/index_set.h"

namespace rend {

Vec3 rest_area_vector(const EmbeddedMap& map, Dart d) {
  const GMap& links = map.map();
  const Vec3 from = map.rest_of(d);
  Vec3 sum = Vec3::Zero(), last = map.rest_of(links.alpha(0, d)) - from;
  for (Dart at = links.follow(d, to_next_side); at != d; at = links.follow(at, to_next_side)) {
    const Vec3 next = map.rest_of(links.alpha(0, at)) - from;
    sum += last.cross(next);
    last = next;
  }
  return sum;
}

// Six times the volume: fans of triangles over each face, as tetrahedra from the vertex of d.
bool winds_outward(const EmbeddedMap& map, Dart d) {
  thread_local std::vector<Dart> starts;
  thread_local IndexSet seen;
  seen.clear();
  starts.assign(1, d);
  const GMap& links = map.map();
  const Vec3 origin = map.rest_of(d);
  double volume = 0;
  for (std::size_t n = 0; n < starts.size(); ++n) {
    if (seen.contains(starts[n].value)) continue; // a face visited before
    const Vec3 corner = map.rest_of(starts[n]) - origin;
    Dart at = starts[n];
    do {
      seen.insert(at.value);
      if (!links.is_free(2, at)) starts.push_back(links.follow(at, to_next_face));
      const Dart next = links.follow(at, to_next_side);
      volume += corner.dot((map.rest_of(at) - origin).cross(map.rest_of(next) - origin));
      at = next;
    } while (at != starts[n]);
  }
  return volume >= 0;
}

} // namespace rend
