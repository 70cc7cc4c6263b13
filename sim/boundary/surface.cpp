#include "sim/boundary/surface.h"

#include "sim/base/check.h"
#include "sim/mechanics/winding.h"
#include "sim/topology/walk.h"

#include <algorithm>

namespace rend {

Surface::Surface(EmbeddedMap& map, const BorderColumn* border)
    : map_(map), border_(border), sense_(find_face_sense(map)), triangles_(5, 0, 0), corners_(3, 0, 0) {
  CHECK(map.dimension() == 2);
  map.use(FaceOfVolume);
  map.use(VertexOfFace);
  rebuild();
  map.subscribe(changes_);
}

Surface::~Surface() {
  map_.unsubscribe(changes_);
}

std::size_t Surface::most_sides() const {
  const EmbeddedMap& map = map_;
  const CellIndex& faces = map.cells(FaceOfVolume);
  int most = 3;
  for (Slot f = 0; f < faces.slots(); ++f)
    if (faces.alive(f)) most = std::max(most, sides_of_face(map.map(), faces.first_dart(f)));
  return static_cast<std::size_t>(most);
}

void Surface::rebuild() {
  const EmbeddedMap& map = map_;
  fan_ = most_sides() - 2;
  full_ = 0;
  triangles_ = PackedRows(5, 0, 0);
  corners_ = PackedRows(3, 0, 0);
  triangles_.resize(map.cells(FaceOfVolume).slots() * fan_);
  corners_.resize(map.cells(VertexOfFace).slots());
  for (Slot face = 0; face < map.cells(FaceOfVolume).slots(); ++face) write_face(face);
  for (Slot vertex = 0; vertex < map.cells(Vertex).slots(); ++vertex) write_corners(vertex);
  triangles_.seal();
  corners_.seal();
}

LineKind Surface::line_kind_of(Dart d) const {
  const EmbeddedMap& map = map_;
  if (!map.map().is_free(2, d)) return LineKind::Cell;
  const bool torn = border_ && (*border_)[map.slot(EdgeOfFace, d)] == 0;
  return torn ? LineKind::Torn : LineKind::Border;
}

// In the order in which its front is walked; none: there is no such face, or it is not closed.
void Surface::collect_sides(Slot face) {
  const EmbeddedMap& map = map_;
  const CellIndex& faces = map.cells(FaceOfVolume);
  sides_.clear();
  if (!faces.alive(face)) return;
  const Dart smallest = faces.first_dart(face);
  Dart at = is_turned(sense_, face) ? map.map().alpha(1, smallest) : smallest;
  for (int left = sides_of_face(map.map(), smallest); left > 0; --left) {
    sides_.push_back(at);
    at = map.map().follow(at, to_next_side);
  }
}

void Surface::write_face(Slot face) {
  const EmbeddedMap& map = map_;
  collect_sides(face);
  const auto sides = static_cast<std::uint32_t>(sides_.size());
  if (triangles_.live(face * fan_ + fan_ - 1)) --full_;
  if (fan_size(sides) == fan_) ++full_;
  for (std::uint32_t number = 0; number < fan_; ++number) {
    const std::size_t key = face * fan_ + number;
    if (number >= fan_size(sides)) {
      triangles_.erase(key);
      continue;
    }
    const auto [a, b, c] = fan_corners(number);
    const std::array<LineKind, 3> lines =
        fan_lines(number, sides, [&](std::uint32_t k) { return line_kind_of(sides_[k]); });
    const std::array<std::uint32_t, 5> row{map.vertex(sides_[a]), map.vertex(sides_[b]), map.vertex(sides_[c]),
                                           static_cast<std::uint32_t>(lines[0]) |
                                               static_cast<std::uint32_t>(lines[1]) << 2 |
                                               static_cast<std::uint32_t>(lines[2]) << 4,
                                           face};
    triangles_.set(key, row.data(), nullptr);
  }
}

// All corners around a vertex: α1 and α2 alternately, in both directions from the smallest dart.
void Surface::write_corners(Slot vertex) {
  const EmbeddedMap& map = map_;
  const CellIndex& vertices = map.cells(Vertex);
  if (!vertices.alive(vertex)) return;
  const Dart first = vertices.first_dart(vertex);
  const auto write = [&](Dart even) {
    const Dart odd = map.map().alpha(1, even);
    const std::array<std::uint32_t, 3> row{vertex, map.vertex(map.map().alpha(0, even)),
                                           map.vertex(map.map().alpha(0, odd))};
    corners_.set(map.slot(VertexOfFace, even), row.data(), nullptr);
  };
  for (Dart even = first;;) { // even dart, its corner, the odd dart, across the edge to the next even dart
    write(even);
    const Dart odd = map.map().alpha(1, even), next = map.map().alpha(2, odd);
    if (next == first) return; // a full turn
    if (odd == even || next == odd) break;
    even = next;
  }
  // the other direction, if the vertex is on the boundary
  for (Dart odd = map.map().alpha(2, first); odd != first;) {
    const Dart even = map.map().alpha(1, odd);
    if (even == first || even == odd) break;
    write(even);
    const Dart next = map.map().alpha(2, even);
    if (next == even || next == map.map().alpha(2, first)) break;
    odd = next;
  }
}

void Surface::update() {
  if (!changes_.any) return;
  if (changes_.whole) {
    changes_.clear();
    return rebuild();
  }
  const EmbeddedMap& map = map_;
  thread_local IndexSet faces_seen, vertices_seen;
  faces_seen.clear();
  vertices_seen.clear();
  triangles_.resize(map.cells(FaceOfVolume).slots() * fan_);
  corners_.resize(map.cells(VertexOfFace).slots());
  const auto face = [&](Slot f) {
    if (faces_seen.insert(f)) write_face(f);
  };
  const auto vertex = [&](Slot v) {
    if (vertices_seen.insert(v)) write_corners(v);
  };
  for (const auto& touched : changes_.touched) {
    for (Dart d : touched) {
      if (!map.map().alive(d)) continue;
      if (static_cast<std::size_t>(sides_of_face(map.map(), d)) > fan_ + 2) {
        changes_.clear();
        return rebuild();
      }
      face(map.slot(FaceOfVolume, d));
      vertex(map.vertex(d));
    }
  }
  for (Slot f : changes_.slots[FaceOfVolume.mask]) face(f);
  for (Slot c : changes_.slots[VertexOfFace.mask])
    if (!map.cells(VertexOfFace).alive(c)) corners_.erase(c);
  for (Slot v : changes_.slots[Vertex.mask]) vertex(v);
  for (Dart d : changes_.moved[Vertex.mask]) {
    if (!map.map().alive(d)) continue;
    face(map.slot(FaceOfVolume, d));
    vertex(map.vertex(map.map().alpha(0, d)));
  }
  changes_.clear();
  if (full_ == 0 && fan_ > 1) return rebuild(); // the last face with so many sides was removed
  triangles_.seal();
  corners_.seal();
}

void Surface::normals(std::vector<Vec3>& out) const {
  const auto& x = map_.position().values();
  out.assign(x.size(), Vec3::Zero());
  corners_.for_each([&](std::size_t, std::size_t row) {
    const Slot v = corners_.index(0)[row];
    const Vec3 even = x[corners_.index(1)[row]].vec() - x[v].vec(),
               odd = x[corners_.index(2)[row]].vec() - x[v].vec();
    out[v] += even.cross(odd);
  });
  for (Vec3& normal : out) {
    const double length = normal.norm();
    if (length > 0) normal /= length;
  }
}

} // namespace rend
