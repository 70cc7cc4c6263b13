#include "sim/outside/wind.h"

#include "sim/boundary/outer_faces.h"
#include "sim/mechanics/winding.h"

#include <algorithm>
#include <cmath>

namespace rend {

template <> const Fields<Wind>& fields_of() {
  using S = Wind;
  static const Fields<S> fields{
      field(&S::velocity, numbers("velocity", 3, "m/s", "velocity of the air").is_required()),
      field(&S::drag, number("drag", "kg/m3", "half its density times the drag coefficient").at_least(0))};
  return fields;
}

WindLoad::WindLoad(EmbeddedMap& map, const Wind& wind) : wind_(wind), sheet_(map.dimension() == 2) {
  map.use(FaceOfVolume);
  rebind(map);
}

void WindLoad::rebind(const EmbeddedMap& map) {
  faces_.clear();
  std::vector<Slot> vertices;
  for_each_outer_face(map, [&](Slot, Dart d) {
    vertices_of_face(map, d, !sheet_ && !winds_outward(map, d), vertices);
    faces_.add(vertices);
  });
}

void WindLoad::add(const Record* position, const Record* velocity, Record* force) const {
  std::vector<Vec3>&x = corners_, &area = areas_;
  for (std::size_t f = 0; f < faces_.size(); ++f) {
    const std::span<const Slot> vertices = faces_[f];
    x.clear();
    for (Slot v : vertices) x.push_back(position[v].vec());
    area.resize(x.size());
    corner_areas(x, area);
    Vec3 normal = Vec3::Zero();
    for (const Vec3& a : area) normal += a;
    const double whole = normal.norm();
    if (!(whole > 0)) continue; // a face without area
    normal /= whole;
    Vec3 air = wind_.velocity;
    for (std::size_t i = 0; i < vertices.size(); ++i)
      air -= area[i].dot(normal) / whole * velocity[vertices[i]].vec();
    const double along = air.dot(normal);
    if (!sheet_ && along >= 0) continue;
    const Vec3 pressure = wind_.drag * std::abs(along) * along * normal;
    for (std::size_t i = 0; i < vertices.size(); ++i)
      force[vertices[i]] = Record(force[vertices[i]].vec() + area[i].dot(normal) * pressure);
  }
}

double WindLoad::damping_rate(const EmbeddedMap& map, const double* inverse_mass) const {
  std::vector<double> seen(map.cells(Vertex).slots()); // area [m²] of each vertex
  std::vector<Vec3> x, area;
  for (std::size_t f = 0; f < faces_.size(); ++f) {
    x.clear();
    for (Slot v : faces_[f]) x.push_back(map.rest()[v].vec());
    area.resize(x.size());
    corner_areas(x, area);
    for (std::size_t i = 0; i < x.size(); ++i) seen[faces_[f][i]] += area[i].norm();
  }
  double most = 0;
  for (std::size_t v = 0; v < seen.size(); ++v) most = std::max(most, seen[v] * inverse_mass[v]);
  return 2 * wind_.drag * wind_.velocity.norm() * most;
}

} // namespace rend
