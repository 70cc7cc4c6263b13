#include "sim/rules/rest_measures.h"

#include "sim/topology/walk.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace rend {

std::vector<Dart> vertices_of_orbit(const GMap& map, Orbit orbit, Dart d) {
  std::vector<Dart> out;
  vertices_of_orbit(map, orbit, d, out);
  return out;
}

void vertices_of_orbit(const GMap& map, Orbit orbit, Dart d, std::vector<Dart>& out) {
  thread_local std::vector<Dart> darts, vertex;
  thread_local IndexSet counted;
  darts.clear();
  counted.clear();
  collect(map, orbit, d, darts);
  std::sort(darts.begin(), darts.end());
  out.clear();
  for (Dart e : darts) {
    if (counted.contains(e.value)) continue;
    vertex.clear();
    collect(map, Vertex, e, vertex);
    for (Dart v : vertex) counted.insert(v.value);
    out.push_back(e);
  }
}

namespace {

// One dart for each corner of a cell, where the vertex meets the cell: the smallest, in increasing order.
void corners_of_orbit(const GMap& map, Orbit orbit, Dart d, std::vector<Dart>& out) {
  thread_local std::vector<Dart> darts, corner;
  thread_local IndexSet counted;
  Orbit around = orbit;
  around.mask = static_cast<std::uint8_t>(around.mask & Vertex.mask);
  darts.clear();
  counted.clear();
  collect(map, orbit, d, darts);
  std::sort(darts.begin(), darts.end());
  out.clear();
  for (Dart e : darts) {
    if (counted.contains(e.value)) continue;
    corner.clear();
    collect(map, around, e, corner);
    for (Dart c : corner) counted.insert(c.value);
    out.push_back(e);
  }
}

} // namespace

// Corners at different places belong to different vertices: to know that, no vertex needs to be walked, which
// in a solid may have a thousand darts.
void vertices_of_orbit(const Edit& edit, Orbit orbit, Dart d, std::vector<Dart>& out) {
  constexpr std::size_t few = 16;
  std::array<Vec3, few> place;
  if ((orbit.mask & Vertex.mask) == Vertex.mask) return vertices_of_orbit(edit.map(), orbit, d, out);
  corners_of_orbit(edit.map(), orbit, d, out);
  for (std::size_t n = 0; n < out.size(); ++n) {
    if (n < few) place[n] = edit.point(out[n]).rest;
    if (n == few || std::find(place.begin(), place.begin() + n, place[n]) != place.begin() + n)
      return vertices_of_orbit(edit.map(), orbit, d, out);
  }
}

Point mean_point(const Edit& edit, Orbit orbit, Dart d) {
  thread_local std::vector<Dart> vertices;
  vertices_of_orbit(edit, orbit, d, vertices);
  return mean_point(edit, vertices);
}

Point mean_point(const Edit& edit, std::span<const Dart> vertices) {
  Point sum;
  double count = 0;
  for (Dart e : vertices) {
    const Point point = edit.point(e);
    sum.position += point.position;
    sum.rest += point.rest;
    sum.velocity += point.velocity;
    count += 1;
  }
  return {sum.position / count, sum.rest / count, sum.velocity / count};
}

namespace {

// The smallest of these darts in each orbit that they are of, increasing.
std::vector<Dart> firsts_of(const GMap& map, Orbit orbit, std::vector<Dart> darts) {
  IndexSet counted;
  std::vector<Dart> cell, out;
  std::sort(darts.begin(), darts.end());
  for (Dart e : darts) {
    if (counted.contains(e.value)) continue;
    cell.clear();
    collect(map, orbit, e, cell);
    for (Dart c : cell) counted.insert(c.value);
    out.push_back(e);
  }
  return out;
}

} // namespace

std::vector<Dart> cells_at_vertex(const GMap& map, Orbit cell, Dart d) {
  return firsts_of(map, cell, darts_of(map, Vertex, d));
}

void ends_of_edges(const GMap& map, Dart d, bool border, std::vector<Dart>& out) {
  out.clear();
  for (Dart e : cells_at_vertex(map, Edge, d)) {
    const std::vector<Dart> edge = darts_of(map, Edge, e);
    const auto is_free = [&](Dart c) { return map.is_free(map.dimension(), c); };
    if (!border || std::any_of(edge.begin(), edge.end(), is_free)) out.push_back(map.alpha(0, e));
  }
}

Point mean_of_cells(const Edit& edit, Orbit cell, Dart d, std::vector<Dart>& vertices) {
  Point sum;
  vertices.clear();
  const std::vector<Dart> cells = cells_at_vertex(edit.map(), cell, d);
  for (Dart e : cells) {
    std::vector<Dart> of_cell;
    vertices_of_orbit(edit, cell, e, of_cell);
    const Point middle = mean_point(edit, of_cell);
    sum.position += middle.position;
    sum.rest += middle.rest;
    sum.velocity += middle.velocity;
    vertices.insert(vertices.end(), of_cell.begin(), of_cell.end());
  }
  const auto count = static_cast<double>(cells.size());
  return {sum.position / count, sum.rest / count, sum.velocity / count};
}

namespace {

// The darts of the face of d that begin its sides, in its order from d; empty: the face is not closed. Valid
// until the next call.
const std::vector<Dart>& sides_from(const GMap& map, Dart d) {
  thread_local std::vector<Dart> sides;
  sides.clear();
  Dart at = d;
  do {
    sides.push_back(at);
    const Dart end = map.alpha(0, at);
    if (end == at || map.is_free(1, end)) {
      sides.clear();
      break;
    }
    at = map.alpha(1, end);
  } while (at != d);
  return sides;
}

double size_of(const std::vector<Vec3>& points) {
  double farthest = 0;
  for (const Vec3& p : points) farthest = std::max(farthest, (p - points[0]).norm());
  return farthest;
}

std::string place_of(const Vec3& p) {
  return fmt::format("({:.4g}, {:.4g}, {:.4g})", p.x(), p.y(), p.z());
}

constexpr double flat = 1e-9; // of a measure, relative to that of a cube or square of the same extent

std::string fault_of_face(const Edit& edit, Dart d) {
  thread_local std::vector<Vec3> x;
  x.clear();
  for (Dart s : sides_from(edit.map(), d)) x.push_back(edit.point(s).rest);
  if (x.empty()) return {}; // not closed yet
  if (x.size() < 3) return "a face would have fewer than three sides";
  const Vec3 area = face_vector(edit, d);
  const double extent = size_of(x);
  if (!(area.norm() > flat * extent * extent)) return "a face would have no area, near " + place_of(x[0]);
  if (x.size() > 4) return {};
  int reflex = 0; // corners: one of a concave quad, two of one that crosses itself; a straight corner is none
  for (std::size_t n = 0; n < x.size(); ++n) {
    const Vec3 &before = x[(n + x.size() - 1) % x.size()], &at = x[n], &next = x[(n + 1) % x.size()];
    reflex += !((next - at).cross(before - at).dot(area) >= -flat * extent * extent * area.norm());
  }
  if (reflex > 1) return "a face would cross itself, near " + place_of(x[0]);
  return {};
}

std::string fault_of_volume(const Edit& edit, Dart d) {
  const GMap& map = edit.map();
  thread_local std::vector<Dart> darts, stack;
  thread_local std::vector<Vec3> x;
  darts.clear();
  x.clear();
  collect(map, Volume, d, darts);
  for (Dart e : darts) {
    for (int i = 0; i < 3; ++i)
      if (map.is_free(i, e)) return {}; // not closed yet
    x.push_back(edit.point(e).rest);
  }
  const double extent = size_of(x);
  if (!(std::abs(volume_at_rest(edit, d)) > flat * extent * extent * extent))
    return "a volume would be flat, near " + place_of(x[0]);
  thread_local IndexMap sense; // dart → 0, 1: darts that one link joins have different ones
  sense.clear();
  sense.insert(d.value, 0);
  int turned = 0, all = 0; // corners of three edges with positive determinants, and all
  stack.assign(1, d);
  while (!stack.empty()) {
    const Dart e = stack.back();
    stack.pop_back();
    const std::uint32_t side = sense.find(e.value);
    for (int i = 0; i < 3; ++i) {
      const Dart next = map.alpha(i, e);
      if (sense.find(next.value) != IndexMap::none) continue;
      sense.insert(next.value, 1 - side);
      stack.push_back(next);
    }
    if (map.follow(e, std::string_view("121212")) != e) continue; // more than three edges meet, as at an apex
    const Vec3 at = edit.point(e).rest;
    const auto edge = [&](std::string_view word) { return Vec3(edit.point(map.follow(e, word)).rest - at); };
    const double turn = edge("0").cross(edge("10")).dot(edge("210")) * (side == 0 ? 1 : -1);
    if (std::abs(turn) <= flat * extent * extent * extent) continue; // its edges lie in a plane
    turned += turn > 0;
    ++all;
    if (turned != 0 && turned != all) return "a volume would be inverted, near " + place_of(at);
  }
  return {};
}

} // namespace

Vec3 face_vector(const Edit& edit, Dart d, Vec3 Point::*part) {
  const std::vector<Dart>& sides = sides_from(edit.map(), d);
  if (sides.empty()) return Vec3::Zero();
  const Vec3 origin = edit.point(d).*part;
  Vec3 sum = Vec3::Zero();
  for (std::size_t n = 1; n + 1 < sides.size(); ++n)
    sum += (edit.point(sides[n]).*part - origin).cross(edit.point(sides[n + 1]).*part - origin);
  return sum / 2;
}

Vec3 face_vector_rate(const Edit& edit, Dart d) {
  const std::vector<Dart>& sides = sides_from(edit.map(), d);
  if (sides.empty()) return Vec3::Zero();
  const Point origin = edit.point(d);
  Vec3 sum = Vec3::Zero();
  for (std::size_t n = 1; n + 1 < sides.size(); ++n) {
    const Point a = edit.point(sides[n]), b = edit.point(sides[n + 1]);
    sum += (a.velocity - origin.velocity).cross(b.position - origin.position) +
           (a.position - origin.position).cross(b.velocity - origin.velocity);
  }
  return sum / 2;
}

double volume_at_rest(const Edit& edit, Dart d) {
  const GMap& map = edit.map();
  const Vec3 origin = edit.point(d).rest;
  double sum = 0;
  thread_local IndexMap sense; // dart → 0, 1: darts that one link joins have different ones
  thread_local std::vector<Dart> queue, face;
  thread_local std::vector<Vec3> means; // of faces, less the origin
  thread_local IndexMap mean_of;        // dart → index in means
  sense.clear();
  sense.insert(d.value, 0);
  queue.assign(1, d);
  means.clear();
  mean_of.clear();
  for (std::size_t at = 0; at < queue.size(); ++at)
    for (int i = 0; i < 3; ++i) {
      const Dart next = map.alpha(i, queue[at]);
      if (sense.find(next.value) != IndexMap::none) continue;
      sense.insert(next.value, 1 - sense.find(queue[at].value));
      queue.push_back(next);
    }
  // Each side of each face, with the face's mean: a tetrahedron with the origin.
  for (Dart e : queue) {
    if (sense.find(e.value) != 0) continue;
    const Vec3 a = edit.point(e).rest - origin, b = edit.point(map.alpha(0, e)).rest - origin;
    if (mean_of.find(e.value) == IndexMap::none) {
      face.clear();
      collect(map, FaceOfVolume, e, face);
      for (Dart f : face) mean_of.insert(f.value, static_cast<std::uint32_t>(means.size()));
      means.push_back(mean_point(edit, FaceOfVolume, e).rest - origin);
    }
    const Vec3& mean = means[mean_of.find(e.value)];
    sum += a.cross(b).dot(mean) / 6;
  }
  return sum;
}

std::string shape_fault(const Edit& edit, Dart d) {
  return edit.map().dimension() == 2 ? fault_of_face(edit, d) : fault_of_volume(edit, d);
}

} // namespace rend
