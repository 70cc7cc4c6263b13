#include "sim/mechanics/element_quality.h"

#include "sim/base/math.h"
#include "sim/embedding/cell_size.h"
#include "sim/mechanics/element.h"
#include "sim/topology/walk.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

namespace rend {
namespace {

constexpr double degrees = 180 / pi; // in a radian

Vec3 rest(const EmbeddedMap& map, Dart d) {
  return map.rest()[map.vertex(d)].vec();
}

// From d to the other end of its edge.
Vec3 along(const EmbeddedMap& map, Dart d) {
  return rest(map, map.map().alpha(0, d)) - rest(map, d);
}

double angle_between(const Vec3& a, const Vec3& b) {
  return degrees * arc_tangent(a.cross(b).norm(), a.dot(b));
}

// Twice the area vector of a face; the edge of d leads counter-clockwise around it.
Vec3 area_vector(const EmbeddedMap& map, Dart d) {
  const GMap& links = map.map();
  const Vec3 origin = rest(map, d);
  Vec3 sum = Vec3::Zero();
  Dart at = d;
  do {
    const Dart next = links.alpha(1, links.alpha(0, at));
    sum += (rest(map, at) - origin).cross(rest(map, next) - origin);
    at = next;
  } while (at != d);
  return sum;
}

// The angle between the faces at the edge of d: between the directions into them, normal to the edge.
double dihedral_angle(const EmbeddedMap& map, Dart d) {
  const Vec3 edge = along(map, d);
  return angle_between(area_vector(map, d).cross(edge), area_vector(map, map.map().alpha(2, d)).cross(edge));
}

double corner_angle(const EmbeddedMap& map, Dart d) {
  return angle_between(along(map, d), along(map, map.map().alpha(1, d)));
}

std::optional<ElementKind> kind_of(const EmbeddedMap& map, Dart d) {
  const auto place = element_at(map.map(), d);
  return place ? std::optional(place->kind) : std::nullopt;
}

// l S/V or l P/A of the shape with equal sides.
double of_equal_sides(const EmbeddedMap& map, Dart d) {
  if (map.dimension() == 2) {
    const auto sides = static_cast<double>(darts_of(map.map(), FaceOfVolume, d).size()) / 2;
    return 4 * tangent(pi / sides);
  }
  const double root2 = std::sqrt(2.0), root3 = std::sqrt(3.0);
  switch (kind_of(map, d).value_or(ElementKind::Hexahedron)) {
  case ElementKind::Tetrahedron:
    return 6 * root2 * root3;
  case ElementKind::Prism:
    return 4 * root3 + 2;
  case ElementKind::Pyramid:
    return 3 * root2 * (1 + root3);
  default:
    return 6;
  }
}

// Sum of the areas of faces, or of the lengths of sides.
double border(const EmbeddedMap& map, const std::vector<Dart>& darts) {
  double sum = 0;
  if (map.dimension() == 2) {
    for (const Dart d : darts) sum += 0.5 * along(map, d).norm(); // each side has two darts
    return sum;
  }
  for (const Dart d : darts) {
    const std::vector<Dart> face = darts_of(map.map(), FaceOfVolume, d);
    if (d == *std::min_element(face.begin(), face.end())) sum += 0.5 * area_vector(map, d).norm();
  }
  return sum;
}

Orbit orbit_of(const EmbeddedMap& map) {
  return element_orbit(map.dimension());
}

} // namespace

ElementQuality quality_of(const EmbeddedMap& map, Dart d) {
  const std::vector<Dart> darts = darts_of(map.map(), orbit_of(map), d);
  const bool solid = map.dimension() == 3;
  ElementQuality out{.least_angle = std::numeric_limits<double>::infinity()};
  double longest = 0;
  for (const Dart each : darts) {
    const double angle = solid ? dihedral_angle(map, each) : corner_angle(map, each);
    out.least_angle = std::min(out.least_angle, angle);
    out.greatest_angle = std::max(out.greatest_angle, angle);
    longest = std::max(longest, along(map, each).norm());
  }
  out.size = solid ? rest_volume(map, d) : rest_area(map, d);
  out.aspect = out.size > 0 ? longest * border(map, darts) / (of_equal_sides(map, d) * out.size)
                            : std::numeric_limits<double>::infinity();
  return out;
}

std::string element_name(const EmbeddedMap& map, Dart d) {
  const auto kind = kind_of(map, d);
  if (kind) return shape_of(*kind).name;
  return map.dimension() == 2 ? "polygon" : "polyhedron";
}

Vec3 element_centre(const EmbeddedMap& map, Dart d) {
  std::vector<Slot> vertices;
  for (const Dart each : darts_of(map.map(), orbit_of(map), d)) vertices.push_back(map.vertex(each));
  std::sort(vertices.begin(), vertices.end());
  vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
  Vec3 sum = Vec3::Zero();
  for (const Slot v : vertices) sum += map.rest()[v].vec();
  return sum / static_cast<double>(vertices.size());
}

MeshQuality mesh_quality(const EmbeddedMap& map) {
  constexpr double infinite = std::numeric_limits<double>::infinity();
  MeshQuality out;
  out.least_angle.value = out.smallest.value = infinite;
  out.greatest_angle.value = out.aspect.value = out.largest.value = -infinite;
  const CellIndex elements(map.map(), orbit_of(map));
  double sum = 0;
  std::size_t count = 0;
  for (Slot e = 0; e < elements.slots(); ++e) {
    if (!elements.alive(e)) continue;
    const ElementQuality one = quality_of(map, elements.first_dart(e));
    sum += one.size;
    ++count;
    const auto take = [&](WorstElement& worst, double value, bool worse) {
      if (!worse) return;
      worst.value = value;
      worst.element = e;
    };
    take(out.least_angle, one.least_angle, one.least_angle < out.least_angle.value);
    take(out.greatest_angle, one.greatest_angle, one.greatest_angle > out.greatest_angle.value);
    take(out.aspect, one.aspect, one.aspect > out.aspect.value);
    take(out.smallest, one.size, one.size < out.smallest.value);
    take(out.largest, one.size, one.size > out.largest.value);
  }
  const double mean = sum / static_cast<double>(count);
  for (WorstElement* worst : {&out.smallest, &out.largest}) worst->value /= mean;
  for (WorstElement* worst :
       {&out.least_angle, &out.greatest_angle, &out.aspect, &out.smallest, &out.largest}) {
    const Dart d = elements.first_dart(worst->element);
    worst->kind = element_name(map, d);
    worst->centre = element_centre(map, d);
  }
  return out;
}

} // namespace rend
