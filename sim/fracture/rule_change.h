// Changes that are rules or scripts: <tear criterion="..." rule="NAME"/>.
//
// What the hook of a rule stands for is the kind of cell that the rule changes: an edge, a border between two
// elements, a vertex or an element. So a criterion is a precondition of the rule (thesis 7.1, p. 180): where it
// exceeds its threshold, the rule is tried from the cell's darts, the smallest of each orbit of the hook first,
// until it applies; if it does not apply there, at the other cells of that kind at the one that was measured. A
// rule of a whole component changes that of the element, once a step. Its expressions know what the law has
// found there (law_quantities.h). Where it does not apply, the reason is counted, that of the dart at which it
// came furthest. Where the body would grow beyond its budget (map_budget.h), it does not apply: the law waits,
// and the run goes on. Nor does it where what it would make is no element of the body, or would bring mass of
// its own (made_elements.h).
#pragma once

#include "sim/fracture/change.h"
#include "sim/rules/map_budget.h"
#include "sim/rules/script.h"

#include <memory>
#include <optional>
#include <string>

namespace rend {

// Why a rule cannot be a change of a body of that dimension, as a sentence; empty: it can.
std::string misfit_of(const RuleOrScript& what, int dimension);
std::string misfit_of(const RuleOrScript& what, const CriterionRequest& request); // of this body

// CHECK: it has no misfit. `request`: of the body, for stresses and strains; null: it asks for none.
std::shared_ptr<const ChangeType> change_by(const RuleOrScript& what, int dimension,
                                            const CriterionRequest* request = nullptr,
                                            const MapBudget& budget = {});

} // namespace rend
