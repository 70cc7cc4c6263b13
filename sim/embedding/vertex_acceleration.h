// The acceleration that a time scheme hands on from step to step [m/s²], where it does (generalised-α,
// sim/integrate/alpha.cpp); 0: none, the scheme begins with that of the forces.
//
// So it does wherever the map changes around a vertex, since forces jump there: after a split (both fragments),
// after a merge, at a new vertex. Numbering anew, checkpoints and the guard's rollback take it along like
// positions and velocities.
#pragma once

#include "sim/embedding/column.h"

namespace rend {

struct VertexAcceleration {
  using Value = Record;
  std::string name = "acceleration";
  Orbit orbit = Vertex;
  Orbit support = Vertex; // a change of any link around the vertex makes the value anew
  Value birth(const EmbeddedMap&, Dart) const { return {}; }
  Value split(const Value&) const { return {}; }
  Value merge(const Value&, const Value&) const { return {}; }
};
using AccelerationColumn = Column<VertexAcceleration>;

} // namespace rend
