#include "sim/outside/patch.h"

#include "sim/boundary/outer_faces.h"
#include "sim/mechanics/winding.h"
#include "sim/topology/orientation.h"

#include <algorithm>

namespace rend {
namespace {

void quad_areas(std::span<const Vec3> x, std::span<Vec3> area) {
  const Vec3 a = 0.25 * (x[1] + x[2] - x[0] - x[3]), b = 0.25 * (x[2] + x[3] - x[0] - x[1]);
  const Vec3 c = 0.25 * (x[0] + x[2] - x[1] - x[3]);
  const Vec3 middle = a.cross(b), along = a.cross(c) / 3,
             across = c.cross(b) / 3; // x_ξ = a + c η, x_η = b + c ξ
  area[0] = middle - along - across;
  area[1] = middle + along - across;
  area[2] = middle + along + across;
  area[3] = middle - along + across;
}

void fan_areas(std::span<const Vec3> x, std::span<Vec3> area) {
  const double n = static_cast<double>(x.size());
  Vec3 centre = Vec3::Zero(), total = Vec3::Zero();
  for (const Vec3& p : x) centre += p / n;
  std::fill(area.begin(), area.end(), Vec3(0, 0, 0));
  for (std::size_t i = 0; i < x.size(); ++i) {
    const std::size_t j = (i + 1) % x.size();
    const Vec3 third = (x[i] - centre).cross(x[j] - centre) / 6;
    area[i] += third;
    area[j] += third;
    total += third;
  }
  for (Vec3& a : area) a += total / n;
}

} // namespace

void corner_areas(std::span<const Vec3> x, std::span<Vec3> area) {
  if (x.size() == 4) return quad_areas(x, area);
  if (x.size() != 3) return fan_areas(x, area);
  const Vec3 third = (x[1] - x[0]).cross(x[2] - x[0]) / 6;
  std::fill(area.begin(), area.end(), third);
}

void CellList::clear() {
  first_.assign(1, 0);
  vertices_.clear();
}

void CellList::add(std::span<const Slot> vertices) {
  vertices_.insert(vertices_.end(), vertices.begin(), vertices.end());
  first_.push_back(vertices_.size());
}

namespace {

std::vector<bool> chosen(const EmbeddedMap& map, const std::vector<Slot>& vertices) {
  std::vector<bool> is(map.cells(Vertex).slots());
  for (Slot v : vertices) is[v] = true;
  return is;
}

} // namespace

Patch Patch::of_cells(EmbeddedMap& map, const std::string& name, Orbit orbit, const Found& found) {
  ShareColumn& shares = map.add(Share{name, orbit});
  for (auto [slot, share] : found) shares[slot] = share;
  return {orbit == FaceOfVolume ? Kind::Faces : Kind::Edges, shares, map};
}

Patch::Found Patch::find_faces(EmbeddedMap& map, const std::vector<Slot>& vertices) {
  map.use(FaceOfVolume);
  const std::vector<bool> is = chosen(map, vertices);
  const bool sheet = map.dimension() == 2;
  // A face of a sheet is gone around as the smallest dart of its component leads.
  const Sides sides = sheet ? sides_of(map.map()) : Sides{};
  Found found;
  std::vector<Slot> face;
  for_each_outer_face(map, [&](Slot f, Dart d) {
    vertices_of_face(map, d, false, face);
    if (!std::all_of(face.begin(), face.end(), [&](Slot v) { return is[v]; })) return;
    found.emplace_back(f, (sheet ? sides.of_dart[d.value] == 2 : !winds_outward(map, d)) ? -1 : 1);
  });
  return found;
}

Patch::Found Patch::find_edges(EmbeddedMap& map, const std::vector<Slot>& vertices) {
  const CellIndex& edges = map.use(EdgeOfFace);
  const std::vector<bool> is = chosen(map, vertices);
  Found found;
  for (Slot e = 0; e < edges.slots(); ++e) {
    if (!edges.alive(e)) continue;
    const Dart d = edges.first_dart(e);
    if (map.map().is_free(2, d) && is[map.vertex(d)] && is[map.vertex(map.map().alpha(0, d))])
      found.emplace_back(e, 1);
  }
  return found;
}

Patch Patch::faces(EmbeddedMap& map, const std::string& name, const std::vector<Slot>& vertices) {
  return of_cells(map, name, FaceOfVolume, find_faces(map, vertices));
}

Patch Patch::boundary(EmbeddedMap& map, const std::string& name, const std::vector<Slot>& vertices) {
  const bool sheet = map.dimension() == 2;
  const Found found = sheet ? find_edges(map, vertices) : find_faces(map, vertices);
  if (!found.empty()) return of_cells(map, name, sheet ? EdgeOfFace : FaceOfVolume, found);
  return {Kind::Corners, share_equally(map, name, vertices), map};
}

void Patch::rebind(const EmbeddedMap& map) {
  cells_.clear();
  darts_.clear();
  const CellIndex& index = map.cells(shares_->orbit());
  std::vector<Slot> vertices;
  for (Slot s = 0; s < index.slots(); ++s) {
    if (!index.alive(s) || (*shares_)[s] == 0) continue;
    const Dart d = index.first_dart(s);
    if (of_ == Kind::Faces)
      vertices_of_face(map, d, (*shares_)[s] < 0, vertices);
    else if (of_ == Kind::Edges)
      vertices = {map.vertex(d), map.vertex(map.map().alpha(0, d))};
    else
      vertices = {map.vertex(d)};
    cells_.add(vertices);
    darts_.push_back(d);
  }
}

std::vector<double> Patch::measures(const EmbeddedMap& map) const {
  std::vector<double> out;
  std::vector<Vec3> x, area;
  for (std::size_t c = 0; c < cells_.size(); ++c) {
    x.clear();
    for (Slot v : cells_[c]) x.push_back(map.rest()[v].vec());
    if (of_ == Kind::Corners) {
      out.push_back((*shares_)[map.slot(shares_->orbit(), darts_[c])]);
    } else if (of_ == Kind::Edges) {
      out.insert(out.end(), 2, 0.5 * (x[1] - x[0]).norm());
    } else {
      area.resize(x.size());
      corner_areas(x, area);
      Vec3 normal = Vec3::Zero();
      for (const Vec3& a : area) normal += a;
      normal.normalize();
      for (const Vec3& a : area) out.push_back(a.dot(normal));
    }
  }
  return out;
}

} // namespace rend
