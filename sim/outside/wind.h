// Wind: pressure on faces by the speed of the air along their normals.
//
//   F = drag A |w_n| w_n n,   w_n = (w − v) · n        drag = ½ ρ C [kg/m³], v: the face's mean velocity
//
// the quadratic law of bluff bodies (Newton's resistance; Batchelor, An Introduction to Fluid Dynamics, 5.11),
// without friction along the face. It acts on every face of a sheet, from either side, and on the α3-free faces
// of a solid on the windward side (w_n < 0 along the outward normal). The body does not affect the air. Nodal
// shares are those of patch.h.
#pragma once

#include "sim/base/settings.h"
#include "sim/outside/patch.h"

namespace rend {

struct Wind {
  Vec3 velocity = Vec3::Zero(); // [m/s]
  double drag = 0.6;            // ½ ρ C [kg/m³]
  SettingsSource source = {};
};
template <> const Fields<Wind>& fields_of();

class WindLoad {
public:
  WindLoad(EmbeddedMap& map, const Wind& wind);
  void rebind(const EmbeddedMap& map);

  // Adds the force [N] on each vertex; [m], [m/s] and [N], one per vertex slot.
  void add(const Record* position, const Record* velocity, Record* force) const;
  // vertices of faces that it may act on
  const std::vector<Slot>& vertices() const { return faces_.vertices(); }
  std::size_t faces() const { return faces_.size(); }
  std::size_t bytes() const { return faces_.bytes(); }

  // An upper bound of the damping rate [1/s] of a body at rest: 2 drag |w| A_n/m_n. `inverse_mass` [1/kg], one
  // per vertex slot.
  double damping_rate(const EmbeddedMap& map, const double* inverse_mass) const;

private:
  Wind wind_;
  bool sheet_;
  CellList faces_;                            // of a solid, counter-clockwise as seen from outside
  mutable std::vector<Vec3> corners_, areas_; // [m], [m²]: scratch, one per corner of a face
};

} // namespace rend
