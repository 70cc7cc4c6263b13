// The least mass of what a law tears off: a change after which something connected would be lighter is taken
// back, and counted as refused.
//
//   Σ m_e ≥ share · M      over the elements e of each connected part at the change; M: the body at its start
//
// Elements are connected across borders (edges of a sheet, faces of a solid). From the elements whose links
// the change has altered, the search goes from element to element until it has found that mass, and no
// further: its time is bounded by the share, not by the size of the body. Elements that the step itself has
// divided count nothing, since their parts have no masses before it ends: a part that consists of such elements
// and little else is refused, whatever its mass. So what a cut tears off has to be several elements wide.
#pragma once

#include "sim/fracture/criterion.h"
#include "sim/topology/index_set.h"

#include <vector>

namespace rend {

class LeastPiece {
public:
  explicit LeastPiece(double mass) : mass_(mass) {} // [kg], above 0

  // Whether all that is connected to what has changed since then, in the open edit, has that mass.
  bool is_kept(const Edit& edit, const Edit::Savepoint& since, const ForceView& view);

private:
  bool is_reached_from(Dart start, const Edit& edit, const ForceView& view);
  double enter(Dart d, const Edit& edit, const ForceView& view);

  double mass_;
  IndexMap seen_;             // dart → number of the search that has come to it
  std::uint32_t search_ = 0;  // each before this one has found that mass
  std::vector<Dart> element_; // scratch: its darts
  std::vector<Dart> queue_;   // of the search: darts of the elements that it has come to
};

} // namespace rend
