#include "sim/mesh/polygons.h"

#include "sim/base/check.h"
#include "sim/mesh/fault.h"

#include <fmt/format.h>

#include <algorithm>
#include <span>

namespace rend {

void PolygonMesh::add(std::initializer_list<std::uint32_t> polygon) {
  if (first.empty()) first.push_back(0);
  corners.insert(corners.end(), polygon.begin(), polygon.end());
  first.push_back(static_cast<std::uint32_t>(corners.size()));
}

PolygonExtent extent_of(const PolygonMesh& mesh, std::size_t p) {
  const std::span<const std::uint32_t> corners(mesh.corners.data() + mesh.first[p],
                                               mesh.first[p + 1] - mesh.first[p]);
  Vec3 centre = Vec3::Zero();
  for (const std::uint32_t c : corners) centre += mesh.points[c];
  centre /= static_cast<double>(corners.size());
  PolygonExtent extent;
  for (std::size_t n = 0; n < corners.size(); ++n) {
    const Vec3 a = mesh.points[corners[n]] - centre,
               b = mesh.points[corners[(n + 1) % corners.size()]] - centre;
    extent.area += 0.5 * a.cross(b).norm();
    extent.square = std::max(extent.square, a.squaredNorm());
  }
  return extent;
}

namespace {

[[noreturn]] void refuse(std::size_t polygon, const std::string& flaw) {
  throw MeshFault("polygon", polygon, flaw);
}

// Refuses a polygon with a repeated corner. By sorting, as a file may hold a polygon of a million corners.
void check_repeats(const PolygonMesh& mesh, std::size_t p) {
  thread_local std::vector<std::uint32_t> sorted;
  sorted.assign(mesh.corners.begin() + mesh.first[p], mesh.corners.begin() + mesh.first[p + 1]);
  std::sort(sorted.begin(), sorted.end());
  const auto repeat = std::adjacent_find(sorted.begin(), sorted.end());
  if (repeat != sorted.end()) refuse(p, fmt::format("meets point {} twice", mesh.name(*repeat)));
}

void check(const PolygonMesh& mesh) {
  for (std::size_t p = 0; p < mesh.polygons(); ++p) {
    const auto begin = mesh.corners.begin() + mesh.first[p], end = mesh.corners.begin() + mesh.first[p + 1];
    if (end - begin < 3) refuse(p, "has fewer than three corners");
    for (auto c = begin; c != end; ++c) {
      if (*c >= mesh.points.size())
        refuse(p, fmt::format("has a corner {}, and there are {} points", *c, mesh.points.size()));
    }
    check_repeats(mesh, p);
  }
}

// Side s runs from corner s to the next corner of its polygon; darts 2s and 2s+1 are its two ends.
struct PolygonSides {
  std::vector<std::uint32_t> end;     // point at the far end of each side
  std::vector<std::uint32_t> polygon; // of each side
};

PolygonSides link_polygons(MapEdit& edit, const PolygonMesh& mesh) {
  PolygonSides sides;
  sides.end.resize(mesh.corners.size());
  sides.polygon.resize(mesh.corners.size());
  for (std::size_t n = 0; n < 2 * mesh.corners.size(); ++n) edit.add_dart();
  for (std::size_t p = 0; p < mesh.polygons(); ++p) {
    const std::uint32_t begin = mesh.first[p], end = mesh.first[p + 1];
    for (std::uint32_t s = begin; s < end; ++s) {
      const std::uint32_t next = s + 1 < end ? s + 1 : begin;
      sides.end[s] = mesh.corners[next];
      sides.polygon[s] = static_cast<std::uint32_t>(p);
      edit.link(0, Dart{2 * s}, Dart{2 * s + 1});
      edit.link(1, Dart{2 * s + 1}, Dart{2 * next});
    }
  }
  return sides;
}

// Sews the sides that join the same two points: sides are bucketed by their smaller point and sorted by the
// other one. Linear, since few share a bucket, and n log n at worst.
void sew_sides(MapEdit& edit, const PolygonMesh& mesh, const PolygonSides& sides) {
  const std::size_t count = mesh.corners.size();
  std::vector<std::uint32_t> start(mesh.points.size() + 1, 0), bucket(count);
  const auto low = [&](std::size_t s) { return std::min(mesh.corners[s], sides.end[s]); };
  const auto high = [&](std::size_t s) { return std::max(mesh.corners[s], sides.end[s]); };
  for (std::size_t s = 0; s < count; ++s) ++start[low(s) + 1];
  for (std::size_t p = 0; p < mesh.points.size(); ++p) start[p + 1] += start[p];
  std::vector<std::uint32_t> at(start.begin(), start.end() - 1);
  for (std::size_t s = 0; s < count; ++s) bucket[at[low(s)]++] = static_cast<std::uint32_t>(s);
  for (std::size_t p = 0; p < mesh.points.size(); ++p) {
    const auto begin = bucket.begin() + start[p], end = bucket.begin() + start[p + 1];
    std::sort(begin, end,
              [&](std::uint32_t s, std::uint32_t t) { return std::pair(high(s), s) < std::pair(high(t), t); });
    for (auto n = begin; n != end;) {
      const std::uint32_t s = *n;
      const auto next = std::find_if(n, end, [&](std::uint32_t t) { return high(t) != high(s); });
      if (next - n > 2)
        refuse(sides.polygon[n[2]],
               fmt::format("shares the edge between points {} and {} with more than one other",
                           mesh.name(mesh.corners[n[2]]), mesh.name(sides.end[n[2]])));
      if (next - n == 2) {
        const bool turned = mesh.corners[s] != mesh.corners[n[1]];
        const Dart mine{2 * s}, theirs{2 * n[1] + (turned ? 1u : 0u)};
        edit.link(2, mine, theirs);
        edit.link(2, edit.map().alpha(0, mine), edit.map().alpha(0, theirs));
      }
      n = next;
    }
  }
}

// A corner has the dart that starts its side, and that which ends the side before.
void add_texture_coordinates(const PolygonMesh& mesh, EmbeddedMap& map) {
  CHECK(mesh.texture.size() == mesh.corners.size());
  Column<TextureCoordinates>& places = map.add(TextureCoordinates{});
  for (std::uint32_t s = 0; s < mesh.texture.size(); ++s)
    places[map.slot(VertexOfFace, Dart{2 * s})] = mesh.texture[s];
}

} // namespace

SewnSheet sew_polygons(const PolygonMesh& mesh) {
  check(mesh);
  GMap map(2);
  MapEdit edit(map);
  edit.reserve(2 * mesh.corners.size());
  const PolygonSides sides = link_polygons(edit, mesh);
  sew_sides(edit, mesh, sides);
  SewnSheet sheet;
  sheet.map = std::make_unique<EmbeddedMap>(std::move(map), [&](Dart d) {
    sheet.point.push_back(d.value % 2 == 0 ? mesh.corners[d.value / 2] : sides.end[d.value / 2]);
    const Vec3& x = mesh.points[sheet.point.back()];
    return Point{x, x, Vec3::Zero()};
  });
  if (!mesh.texture.empty()) add_texture_coordinates(mesh, *sheet.map);
  return sheet;
}

} // namespace rend
