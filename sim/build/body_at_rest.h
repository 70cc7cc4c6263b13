// A body as expressions of its settings see it (mechanics/element_expression.h).
#pragma once

#include "sim/build/body_settings.h"

namespace rend {

// Of a body that has its map, and lives at least as long. The picture of the expression lies on it as
// picture_frame.h says, in its proportions; u and v without a picture are those of a square one.
BodyAtRest body_at_rest(const Body& body, const BodySettings& settings, const ExpressionSettings& expression);

// Whether an expression of these settings asks where an element lies in a picture.
bool asks_for_picture_place(const BodySettings& settings);

} // namespace rend
