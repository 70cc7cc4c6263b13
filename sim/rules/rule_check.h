// Whether a rule keeps the axioms of the map wherever it matches, decided from its graphs alone (thesis
// 3.4.1.1; Poudret 2009).
//
// 1. Labels: as long as the hook's; a hook drops no link; only the left graph has hooks, one in every connected
//    part of it, so that a match is unique.
// 2. Incident arcs: a created dart has each of its four links once; a kept dart has the links that it had on
//    the left, none gained and none lost; a removed dart has all four on the left, so that none is left
//    open.
// 3. Cycles: for j >= i+2, αiαj stays an involution wherever αi or αj changes. Two explicit links: the square
//    closes. One explicit, one implicit: the node across has the implicit one at the same position. Two
//    implicit: the *hook's* links at those positions commute, whatever they are renamed to.
// 4. Folding: a rule that may match where darts coincide only unlinks.
#pragma once

#include "sim/rules/rule_graph.h"

namespace rend {

// RuleFault: the first condition that does not hold, with node and link.
void check_graphs(const RuleGraph& left, const RuleGraph& right, bool may_fold);

// The link of a kept node is the same before and after, or neither graph speaks of it; and both ends are kept.
bool unchanged(const RuleGraph& left, int left_node, const RuleGraph& right, int right_node, int i);

} // namespace rend
