// What a step does, in its order: which arrays are gone through how often.
//
// Bytes are those of the arrays that a pass goes through, each once: what must come from memory where nothing
// stays in the caches. They are no measurement.
#pragma once

#include "sim/scene/scene.h"

#include <nlohmann/json.hpp>

namespace rend {

// One object a pass: body (null: of all), stage, what, count, of (what `count` counts), times (a step), bytes
// (each time). The scene has made a step. Times of schemes that solve are those of that step.
nlohmann::ordered_json passes_of(const Scene& scene);

} // namespace rend
