// Where the nodes of a rule's graph are drawn.
//
// Two nodes are to be as far from each other as arcs lie between them. The layout minimises the stress
//
//   Σ (|xi − xj| − dij)² / dij²
//
// by moving each node in turn to the weighted mean of where its terms place it (Kamada and Kawai 1989; Gansner,
// Koren and North 2004). Several starts on a circle are tried, in fixed orders; the result with the fewest
// crossings counts. No random numbers, and only operations that IEEE 754 fixes.
#pragma once

#include "render/diagram/drawing.h"
#include "sim/rules/rule_graph.h"

namespace rend {

// One spot a node; an arc is about 1 long. The longer side lies horizontally, the first node to the left.
std::vector<Spot> lay_out(const RuleGraph& graph);

} // namespace rend
