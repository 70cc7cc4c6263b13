// Topological changes: what a law does where its criterion says so (thesis 7.3; design: mechanics, section 4).
//
// Every change is made of one operation, the separation of two elements. Embeddings follow by their own policies.
#pragma once

#include "sim/embedding/embedded_map.h"
#include "sim/fracture/criterion.h"

#include <string>
#include <vector>

namespace rend {

struct ChangeType {
  std::string name, what;
  std::vector<Cell> cells; // it acts on
  // Applies the change at a candidate if it is still possible; false: it was not, and nothing was changed.
  bool (*apply)(Edit&, const ForceView&, const Candidate&);
};

const std::vector<ChangeType>& all_changes();

ChangeType separate();

} // namespace rend
