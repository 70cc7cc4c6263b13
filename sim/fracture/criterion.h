// Criteria: what is measured where, to be compared with a law's threshold (thesis 7.4; design: mechanics, section 4).
//
// A criterion binds its own rows to the body and looks at the true forces of a state. It must not change the map.
// Adding one: a file with a function `CriterionType my_criterion()`, and its name in all_criteria().
#pragma once

#include "sim/program/program.h"

#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace rend {

// Where a change may happen, and how badly.
struct Candidate {
  double value = 0; // in the criterion's unit, above the threshold
  Dart dart;        // the smallest of the cell
};

// The state a law looks at.
struct ForceView {
  const EmbeddedMap& map;
  const Record* position; // [m], one per vertex slot
  const Record* force;    // internal [N], one per vertex slot
  const Record* corner;   // internal [N], one per corner slot: the share of each element; null unless asked for
};

class Criterion {
public:
  virtual ~Criterion() = default;
  virtual void find(const ForceView& view, double threshold, std::vector<Candidate>& candidates) = 0;
  virtual void rebind(const Changes& changes) = 0;
  virtual void reserve_for_separations() = 0; // see EmbeddedMap
  virtual std::size_t bytes() const = 0;
};

// The cell that a criterion measures, or a change acts on.
enum class Cell { Borders, Vertices, Elements, Springs };

struct CriterionType {
  std::string name, what, unit;
  Cell cell;
  bool elementary; // needs the forces of each element by itself
  std::string default_change;
  std::unique_ptr<Criterion> (*make)(EmbeddedMap&);
};

const std::vector<CriterionType>& all_criteria();

CriterionType global_border();
CriterionType atomic_border();

} // namespace rend
