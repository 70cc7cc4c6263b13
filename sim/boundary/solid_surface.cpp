#include "sim/boundary/solid_surface.h"

#include "sim/base/check.h"
#include "sim/boundary/hull.h"
#include "sim/topology/index_set.h"
#include "sim/topology/walk.h"

#include <algorithm>
#include <cmath>

namespace rend {
namespace {

constexpr double crease_cosine = 0.766; // of 40°

bool sharp(const Vec3& a, const Vec3& b) {
  return a.dot(b) < crease_cosine * std::sqrt(a.squaredNorm() * b.squaredNorm());
}

} // namespace

SolidSurface::SolidSurface(EmbeddedMap& map, const BorderColumn* border) : map_(map), border_(border) {
  CHECK(map.dimension() == 3);
  rebuild();
  map.subscribe(changes_);
}

SolidSurface::~SolidSurface() {
  map_.unsubscribe(changes_);
}

void SolidSurface::rebuild() {
  const GMap& map = map_.map();
  boundary_.resize(map.capacity());
  queued_.fit(map.capacity());
  map.for_each_dart([&](Dart d) { queue(d); });
  bind();
  empty_queue();
}

bool SolidSurface::update() {
  if (!changes_.any) return false;
  if (changes_.whole) {
    changes_.clear();
    boundary_ = {};
    rebuild();
    return true;
  }
  const GMap& map = map_.map();
  boundary_.resize(map.capacity());
  queued_.fit(map.capacity());
  in_volumes_.fit(map.capacity());
  for (const auto& touched : changes_.touched)
    for (Dart d : touched) boundary_.erase(d); // in case it was a key: it may no longer be one
  for (std::size_t i = 0; i < 4; ++i)
    for (Dart d : changes_.touched[i]) {
      if (!map.alive(d)) continue;
      if (i < 3 || d <= map.alpha(0, d)) queue_around_edge(d); // α3 changes at both ends of an edge
      if (i < 3) queue_volume(d);                              // the shape of an element changed
    }
  // Vertices with other slots; if vertices were merged, the rest shape of elements changed.
  for (Dart d : changes_.moved[Vertex.mask])
    if (map.alive(d)) queue_volume(d);
  for (Dart moved : changes_.reshaped)
    if (map.alive(moved))
      for (Dart d : darts_of(map, Vertex, moved)) queue_volume(d);
  changes_.clear();
  bind();
  empty_queue();
  return true;
}

void SolidSurface::empty_queue() {
  for (const Dart first : queue_)
    walk_two(map_.map(), 0, 1, first, [&](Dart d) { queued_.clear_word(d.value); });
  for (const Dart d : volumes_) in_volumes_.clear_word(d.value);
  queue_.clear();
  volumes_.clear();
}

void SolidSurface::queue(Dart d) {
  const GMap& map = map_.map();
  if (!map.is_free(3, d) || queued_.has(d.value)) return;
  Dart first = d;
  walk_two(map, 0, 1, d, [&](Dart e) {
    first = std::min(first, e);
    queued_.set(e.value);
  });
  queue_.push_back(first);
}

void SolidSurface::queue_around_edge(Dart d) {
  walk_two(map_.map(), 2, 3, d, [&](Dart e) { queue(e); });
}

void SolidSurface::queue_volume(Dart d) {
  const GMap& map = map_.map();
  if (in_volumes_.has(d.value)) return;
  const std::size_t begin = volumes_.size();
  collect_marked(map, Volume, d, volumes_, in_volumes_);
  for (std::size_t n = begin; n < volumes_.size(); ++n) {
    const Dart e = volumes_[n];
    if (map.alpha(0, e) < e || !map.is_free(3, e)) continue; // one end of an edge is enough
    if (e <= map.alpha(1, e)) queue(e);                      // as the smallest dart of its face is
    queue(across_hull_edge(map, e)); // their common edge may have become a crease, or ceased to be one
  }
}

void SolidSurface::bind() {
  const GMap& map = map_.map();
  for (Dart first : queue_) write_face(first);
  for (Dart first : queue_) {
    const BoundaryFaces::Found found = boundary_.find(first);
    if (!found.face) continue;
    Dart at = found.face->turned ? map.alpha(1, first) : first;
    for (const BoundaryFaces::Corner& corner : found.corners) {
      if (!corner.group) write_fan(at);
      at = map.follow(at, to_next_side);
    }
  }
  numbered_ = false;
}

bool SolidSurface::exposed(Dart d) const {
  return border_ && (*border_)[map_.slot(FaceOfVolume, d)] == 0;
}

// d: where the side starts; area: of its face, walked from d.
LineKind SolidSurface::line_kind_of(Dart d, const Vec3& area) const {
  const Dart other = across_hull_edge(map_.map(), d);
  if (other == d || exposed(d) != exposed(other)) return LineKind::Crease;
  return sharp(area, -rest_area_vector(map_, other)) ? LineKind::Crease : LineKind::Cell;
}

void SolidSurface::write_face(Dart first) {
  thread_local std::vector<BoundaryFaces::Corner> corners;
  corners.clear();
  const GMap& map = map_.map();
  bool closed = true;
  walk_two(map, 0, 1, first, [&](Dart d) {
    if (d != first) boundary_.erase(d); // the key of a face that was merged into this one
    closed = closed && !map.is_free(0, d) && !map.is_free(1, d);
  });
  const bool turned = closed && !winds_outward(map_, first), is_exposed = exposed(first);
  const Dart start = turned ? map.alpha(1, first) : first;
  const Vec3 area = rest_area_vector(map_, start);
  Dart at = start;
  do {
    corners.push_back({map_.vertex(at), is_exposed ? first : Dart{}, line_kind_of(at, area)});
    at = map.follow(at, to_next_side);
  } while (at != start);
  if (!closed || corners.size() < 3) { // a face without area
    boundary_.erase(first);
    return;
  }
  boundary_.set({first, turned, is_exposed, static_cast<std::uint32_t>(corners.size())}, corners);
}

SolidSurface::FanCorner SolidSurface::fan_corner(Dart even, Dart odd) const {
  return {even, odd, rest_area_vector(map_, even), exposed(even)};
}

// The corners around the vertex of d that are connected on the hull, in order; their areas have a consistent
// orientation.
void SolidSurface::collect_fan(Dart d) {
  const GMap& map = map_.map();
  fan_.clear();
  fan_closed_ = false;
  for (Dart even = d;;) {
    const Dart odd = map.alpha(1, even), next = across_hull_edge(map, odd);
    fan_.push_back(fan_corner(even, odd));
    fan_closed_ = next == d && odd != even;
    if (fan_closed_) return;
    if (odd == even || next == odd) break;
    even = next;
  }
  for (Dart even = d;;) { // an open volume: continue in the other direction
    const Dart odd = across_hull_edge(map, even);
    if (odd == even) return;
    even = map.alpha(1, odd);
    fan_.insert(fan_.begin(), fan_corner(even, odd));
    if (even == odd) return;
  }
}

void SolidSurface::write_fan(Dart d) {
  collect_fan(d);
  const std::size_t n = fan_.size();
  const auto breaks_after = [&](std::size_t k) {
    const FanCorner &a = fan_[k % n], &b = fan_[(k + 1) % n];
    return a.exposed || b.exposed || sharp(a.area, b.area);
  };
  std::size_t begin = 0; // where a group begins
  if (fan_closed_)
    while (begin < n && !breaks_after(begin + n - 1)) ++begin;
  if (begin == n) return write_group(0, n);
  for (std::size_t k = begin, from = begin; k < begin + n; ++k) {
    if (k + 1 < begin + n && !breaks_after(k)) continue;
    write_group(from, k + 1);
    from = k + 1;
  }
}

void SolidSurface::write_group(std::size_t begin, std::size_t end) {
  const GMap& map = map_.map();
  const auto at = [&](std::size_t k) -> const FanCorner& { return fan_[k % fan_.size()]; };
  if (at(begin).exposed) return; // a group of its own, named by its face
  Dart group = at(begin).even;
  for (std::size_t k = begin; k < end; ++k) group = std::min({group, at(k).even, at(k).odd});
  for (std::size_t k = begin; k < end; ++k) {
    const Dart first = smallest_of_face(map, at(k).even);
    const BoundaryFaces::Found found = boundary_.find(first);
    if (!found.face) continue;
    Dart d = found.face->turned ? map.alpha(1, first) : first;
    std::size_t corner = 0;
    for (; d != at(k).even && d != at(k).odd; d = map.follow(d, to_next_side)) ++corner;
    found.corners[corner].group = group;
  }
}

// Numbers the groups in the order of their first corners: a pure function of the boundary.
void SolidSurface::number_groups() {
  thread_local IndexMap numbers;
  numbers.clear();
  numbers_.clear();
  numbers_.reserve(boundary_.corner_count());
  boundary_.for_each([&](const BoundaryFaces::Face&, std::span<const BoundaryFaces::Corner> corners) {
    for (const BoundaryFaces::Corner& corner : corners)
      numbers_.push_back(numbers.insert(corner.group.value, static_cast<std::uint32_t>(numbers.size())));
  });
  groups_ = numbers.size();
  numbered_ = true;
}

void SolidSurface::normals(std::vector<Vec3>& out) {
  if (!numbered_) number_groups();
  const auto& x = map_.position().values();
  sums_.assign(groups_, Vec3::Zero());
  std::size_t c = 0;
  boundary_.for_each([&](const BoundaryFaces::Face& face, std::span<const BoundaryFaces::Corner> corners) {
    for (std::uint32_t k = 0; k < face.sides; ++k, ++c) {
      const Slot next = corners[k + 1 < face.sides ? k + 1 : 0].vertex;
      const Slot last = corners[k > 0 ? k - 1 : face.sides - 1].vertex;
      const Vec3 here = x[corners[k].vertex].vec(), a = x[next].vec() - here, b = x[last].vec() - here;
      const double weight = a.squaredNorm() * b.squaredNorm();
      if (weight > 0) sums_[numbers_[c]] += a.cross(b) / weight;
    }
  });
  for (Vec3& normal : sums_) {
    const double length = normal.norm();
    if (length > 0) normal /= length;
  }
  out.resize(numbers_.size());
  for (c = 0; c < out.size(); ++c) out[c] = sums_[numbers_[c]];
}

} // namespace rend
