// All pairs of a criterion and a change: where the change is made, or why the pair has no meaning. What builds
// a law, the table of `rend help tear` and the tests ask here.
#pragma once

#include "sim/fracture/change.h"
#include "sim/fracture/criterion.h"
#include "sim/fracture/transfer.h"

#include <string>
#include <vector>

namespace rend {

// A criterion as a law names it: with a kind of springs, if it takes one.
struct NamedCriterion {
  const CriterionType* type;
  std::string kind; // "": none

  Cell cell() const { return type->cell(kind); }
  std::string name() const { return kind.empty() ? type->name : type->name + " " + kind; }
  // CriterionType::without_meaning: why it has no meaning in sheets (2) or solids (3); empty: it has one.
  std::string without_meaning(int dimension) const {
    return type->without_meaning ? type->without_meaning(kind, dimension) : std::string();
  }
};

// Every criterion with every kind that it takes, in the order of all_criteria().
std::vector<NamedCriterion> named_criteria();

// The change that acts on the cells that the criterion measures.
const ChangeType& default_change(Cell cell);

struct Pair {
  NamedCriterion criterion;
  const ChangeType* change;
  int dimension;
  const Transfer* transfer; // where the change is made
  std::string refusal;      // why the pair has no meaning, a sentence that goes on after the criterion's name;
                            // empty: it has one
};

Pair pair_of(const NamedCriterion& criterion, const ChangeType& change, int dimension);
std::vector<Pair> all_pairs(int dimension); // criterion by criterion, in the order of all_changes()

} // namespace rend
