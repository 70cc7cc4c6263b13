// A rule as a drawing, in the style of the thesis (figs. 3.20, 3.22): its left and its right graph, and below
// them a small map before and after.
//
// A node is a circle with its name and label; a hook has two circles. Created nodes are green, removed ones
// red. A link is a line in its colour (rule_colours.h), with its number; a free one a small loop.
#pragma once

#include "render/diagram/drawing.h"
#include "render/diagram/sample_maps.h"
#include "sim/rules/rule.h"

namespace rend {

Drawing diagram_of(const Rule& rule, const RuleShown& shown);

// One graph. `other`: that of the other side, which tells what is kept.
Drawing diagram_of(const RuleGraph& graph, const RuleGraph& other, RuleSide side);

} // namespace rend
