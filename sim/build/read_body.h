// A body's settings from a checked <body> of a preset.
#pragma once

#include "sim/base/parameters.h"
#include "sim/build/body_settings.h"

namespace rend {

// Its settings read their places from the node for as long as they live. UserError: no shape, or several.
BodySettings read_body(const PresetNode& node);

} // namespace rend
