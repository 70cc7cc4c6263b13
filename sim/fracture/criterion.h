// Criteria: the quantity that a law compares with its threshold, and the cells on which it is evaluated (thesis
// 7.4; sim/README.md, "Tearing").
//
// A criterion binds its own rows to the body and evaluates the forces of a state. It must not change the map.
// To add one: a file with a function `CriterionType my_criterion()`, and its name in all_criteria().
#pragma once

#include "sim/cuts/least_part.h"
#include "sim/fracture/cell.h"
#include "sim/fracture/grain.h"
#include "sim/rows/program.h"

#include <functional>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace rend {

// A cell that exceeds the threshold, where a change may be made.
struct Candidate {
  double value = 0;           // in the criterion's unit, above the threshold
  Dart dart;                  // the smallest of the cell
  Vec3 normal = Vec3::Zero(); // of a vertex: unit normal of the plane along which it would be split
  double strength = 1;        // of the cell: what the threshold is multiplied by there (strength.h)
  bool wall = false;          // it is at a wall between pieces, and has that strength (strength.h)
  double relative() const { return value / strength; }
};

// The state that criteria evaluate.
struct ForceView {
  const EmbeddedMap& map;
  const Program& program;
  const MassColumn& mass;
  const Record* position; // [m], one per vertex slot
  const Record* velocity; // [m/s], one per vertex slot
  const Record* force;    // internal [N], one per vertex slot
  // internal [N], one per corner slot: the contribution of each element; null unless required
  const Record* corner;
  // Not null: instead of `corner`, the fourth lane of `force` holds Program::forces_with_sums(), and this is a
  // buffer for Program::corner_forces_at(), for the vertices where the sums do not rule out a candidate.
  Record* corner_buffer = nullptr;
  double time = 0;                 // [s]
  std::span<const Slot> held = {}; // vertices with a prescribed motion, increasing
};

// What a criterion has found where a change is made.
struct FoundPlace {
  Vec3 normal;      // of the plane along which a vertex would be split; 0: none
  double value = 0; // in the criterion's unit
  FoundPlace(const Vec3& normal_, double value_ = 0) : normal(normal_), value(value_) {}
};

class Criterion {
public:
  virtual ~Criterion() = default;
  // Appends the candidates above the threshold, in an order that is a function of the state and the map alone.
  virtual void find(const ForceView& view, double threshold, std::vector<Candidate>& candidates) = 0;
  virtual void rebind(const Changes&) {}    // for criteria with rows of their own
  virtual void reserve_for_separations() {} // see EmbeddedMap
  virtual std::size_t bytes() const { return 0; }
};

// The body and the settings for which a criterion is made.
struct CriterionRequest {
  EmbeddedMap& map;
  const std::vector<std::unique_ptr<Interaction>>& interactions;
  const MassColumn& mass;
  std::string kind;          // of springs: "stretch", "shear", "bend"; empty: not given
  bool compression = false;  // negative eigenvalues count too
  LeastPart least_part = {}; // that a cut leaves
  GrainSettings grain = {};  // of the body, as the law sees it
};

struct CriterionType {
  std::string name, what, unit;
  bool elementary = false; // needs the forces of each element by itself
  // The cell that it measures, with the kind that was given.
  Cell (*cell)(std::string_view kind);
  // Why the criterion cannot be made for this body and these settings, as a sentence; empty: it can.
  std::string (*lacking)(const CriterionRequest&);
  std::unique_ptr<Criterion> (*make)(const CriterionRequest&);
  bool by_sums = false;                // elementary, but works with ForceView::corner_buffer
  std::vector<std::string> kinds = {}; // of springs that it takes; "": may be left out; empty: none
  bool takes_compression = false;      // which settings of the request it uses
  bool takes_grain = false;            // likewise
  std::string (*unit_there)(const CriterionRequest&) = nullptr; // null: `unit` for every body
  // Why it has no meaning with this kind in sheets (2) or solids (3), whatever the body, as a sentence that
  // goes on after its name; empty: it has one. Null: it always has.
  std::string (*without_meaning)(std::string_view kind, int dimension) = nullptr;
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
