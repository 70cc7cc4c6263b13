// A body as expressions of its settings see it (mechanics/element_expression.h).
#pragma once

#include "sim/build/body_settings.h"

namespace rend {

// A body that has its shape, which lives as long as it. A picture lies on it as one of its look would
// (picture_frame.h), in the proportions of that of the expression; without one as a square.
BodyAtRest body_at_rest(const Body& body, const BodySettings& settings, const ExpressionSettings& expression);

// Whether an expression of these settings asks where an element lies in a picture.
bool asks_for_picture_place(const BodySettings& settings);

} // namespace rend
