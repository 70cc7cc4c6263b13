// Topological changes: what a law does where its criterion says so (thesis 7.3; sim/README.md, "Tearing").
//
// Every change is made of one operation, the separation of two elements. Embeddings follow by their own
// policies. Adding one: a file with a function `ChangeType my_change()`, and its name in all_changes().
#pragma once

#include "sim/embedding/embedded_map.h"
#include "sim/fracture/criterion.h"

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace rend {

struct ChangeType {
  std::string name, what;
  Cell own; // of which it is the default
  bool (*fits)(Cell cell, int dimension);
  bool (*elementary)(Cell cell); // needs the forces of each element by itself
  // Applies the change at a candidate if it is still possible; false: it was not, and nothing was changed.
  // Slots and positions are those of before the edit, links those of now. `darts`: of the candidate's cell
  // before the edit, those that are left of them; the cell may have fallen apart since.
  bool (*apply)(Edit&, const ForceView&, Cell cell, const Candidate&, std::span<const Dart> darts);
};

const std::vector<ChangeType>& all_changes();
const ChangeType* find_change(std::string_view name); // null: there is none

ChangeType separate();
ChangeType delete_element();
ChangeType split_vertex();
ChangeType delete_edge();

// The element of d lets go of all its neighbours and is removed.
void remove_element_of(Edit& edit, Dart d);

} // namespace rend
