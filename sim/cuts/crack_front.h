// The border around a vertex v of a solid of tetrahedra, and where a crack front passes through it. A front
// edge is a border edge around which there is matter over more than 300° at rest: the tip of a crack that was
// torn, or of a notch that the mesh has from the start. The border edges at v form cycles: one around v on the
// outer surface, one more for each crack that does not reach it.
#pragma once

#include "sim/embedding/embedded_map.h"

#include <span>
#include <vector>

namespace rend {

class CrackFront {
public:
  struct BorderEdge {   // at v
    Dart before, after; // of v, in the border face before it in its cycle, and the one after it
    double angle;       // of the matter around it, at rest
  };
  struct Cycle {
    std::vector<BorderEdge> edges;   // in order
    std::vector<std::size_t> fronts; // indices of the front edges among them, increasing
  };

  // `darts`: of v.
  CrackFront(const EmbeddedMap& map, std::span<const Dart> darts);

  const std::vector<Cycle>& cycles() const { return cycles_; }
  bool passes() const; // there is a front edge

private:
  BorderEdge edge_after(Dart d) const;

  const EmbeddedMap& map_;
  std::vector<Cycle> cycles_;
};

} // namespace rend
