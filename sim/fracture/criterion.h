// Criteria: what is measured where, to be compared with a law's threshold (thesis 7.4;
// sim/README.md, "Tearing").
//
// A criterion binds its own rows to the body and looks at the true forces of a state. It must not change the
// map. Adding one: a file with a function `CriterionType my_criterion()`, and its name in all_criteria().
#pragma once

#include "sim/fracture/cell.h"
#include "sim/rows/program.h"

#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace rend {

// Where a change may happen, and how badly.
struct Candidate {
  double value = 0;           // in the criterion's unit, above the threshold
  Dart dart;                  // the smallest of the cell
  Vec3 normal = Vec3::Zero(); // of a vertex: unit, of the plane that would part it
};

// The state a law looks at.
struct ForceView {
  const EmbeddedMap& map;
  const Program& program;
  const MassColumn& mass;
  const Record* position; // [m], one per vertex slot
  const Record* velocity; // [m/s], one per vertex slot
  const Record* force;    // internal [N], one per vertex slot
  const Record* corner;   // internal [N], one per corner slot: the share of each element; null unless asked for
  // Not null: in its place the fourth lane of `force` holds Program::forces_with_sums(), and this has room for
  // Program::corner_forces_at() where that says too little.
  Record* corner_room = nullptr;
};

class Criterion {
public:
  virtual ~Criterion() = default;
  // Appends what exceeds the threshold, in any order that is a function of the state and the map alone.
  virtual void find(const ForceView& view, double threshold, std::vector<Candidate>& candidates) = 0;
  virtual void rebind(const Changes&) {}    // of those that carry rows
  virtual void reserve_for_separations() {} // see EmbeddedMap
  virtual std::size_t bytes() const { return 0; }
};

// The body and the law that a criterion is made for.
struct CriterionRequest {
  EmbeddedMap& map;
  const std::vector<std::unique_ptr<Interaction>>& interactions;
  const MassColumn& mass;
  std::string kind;         // of springs: "stretch", "shear", "bend"; empty: not said
  bool compression = false; // negative eigenvalues count as well
};

struct CriterionType {
  std::string name, what, unit;
  bool elementary = false; // needs the forces of each element by itself
  // The cell that it measures there.
  Cell (*cell)(const CriterionRequest&);
  // What the body, or what was said of it, lacks for this criterion, as a sentence; empty: nothing.
  std::string (*lacking)(const CriterionRequest&);
  std::unique_ptr<Criterion> (*make)(const CriterionRequest&);
  bool by_sums = false;                               // elementary, and takes ForceView::corner_room instead
  bool takes_kind = false, takes_compression = false; // what of the request it heeds
  std::string (*unit_there)(const CriterionRequest&) = nullptr; // where it is not `unit` on every body
};

const std::vector<CriterionType>& all_criteria();
const CriterionType* find_criterion(std::string_view name); // null: there is none

CriterionType atomic_spring();
CriterionType atomic_element();
CriterionType atomic_vertex();
CriterionType cumulative_vertex();
CriterionType vertex_stress_criterion();
CriterionType atomic_border();
CriterionType global_border();
CriterionType strain();

} // namespace rend
