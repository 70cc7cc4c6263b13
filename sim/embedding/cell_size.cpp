#include "sim/embedding/cell_size.h"

#include "sim/topology/index_set.h"
#include "sim/topology/walk.h"

#include <algorithm>
#include <vector>

namespace rend {

double rest_area(const EmbeddedMap& map, Dart d) {
  std::vector<Vec3> x;
  Dart at = d;
  do {
    x.push_back(map.rest_of(at));
    at = map.map().alpha(1, map.map().alpha(0, at));
  } while (at != d);
  Vec3 centre = Vec3::Zero();
  for (const Vec3& p : x) centre += p;
  centre /= static_cast<double>(x.size());
  double area = 0;
  for (std::size_t n = 0; n < x.size(); ++n)
    area += 0.5 * (x[n] - centre).cross(x[(n + 1) % x.size()] - centre).norm();
  return area;
}

namespace {

// Calls f(d) once for each face of the volume of d, with a dart of the same orientation class as d, so that all
// faces have the same orientation as seen from inside.
template <class F> void each_face_of_volume(const GMap& map, Dart d, F&& f) {
  thread_local IndexSet faces; // the smallest dart of each
  thread_local std::vector<Dart> found;
  faces.clear();
  found.assign(1, d);
  const auto visit = [&](Dart start) {
    Dart smallest = start;
    walk_two(map, 0, 1, start, [&](Dart e) { smallest = std::min(smallest, e); });
    return faces.insert(smallest.value);
  };
  visit(d);
  for (std::size_t n = 0; n < found.size(); ++n) {
    const Dart face = found[n];
    f(face);
    Dart at = face;
    do {
      const Dart across = map.alpha(2, map.alpha(0, at));
      if (visit(across)) found.push_back(across);
      at = map.alpha(1, map.alpha(0, at));
    } while (at != face);
  }
}

} // namespace

double rest_volume(const EmbeddedMap& map, Dart d) {
  const Vec3 origin = map.rest_of(d); // any point would do, since the surface is closed
  double sixfold = 0;
  thread_local std::vector<Vec3> x;
  each_face_of_volume(map.map(), d, [&](Dart face) {
    x.clear();
    Vec3 centre = Vec3::Zero();
    Dart at = face;
    do {
      x.push_back(map.rest_of(at) - origin);
      centre += x.back();
      at = map.map().alpha(1, map.map().alpha(0, at));
    } while (at != face);
    centre /= static_cast<double>(x.size());
    for (std::size_t n = 0; n < x.size(); ++n) sixfold += centre.dot(x[n].cross(x[(n + 1) % x.size()]));
  });
  return std::abs(sixfold) / 6;
}

int corners_of_volume(const GMap& map, Dart d) {
  int corners = 0;
  each_face_of_volume(map, d, [&](Dart face) {
    Dart at = face;
    do { // count each corner once, in the face whose dart is the smallest
      Dart smallest = at, here = map.alpha(2, map.alpha(1, at));
      for (; here != at; here = map.alpha(2, map.alpha(1, here))) smallest = std::min(smallest, here);
      corners += smallest == at;
      at = map.alpha(1, map.alpha(0, at));
    } while (at != face);
  });
  return corners;
}

} // namespace rend
