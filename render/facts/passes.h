// The passes of a step over the arrays, in order, with how often each is made.
//
// Bytes are those of the arrays that a pass traverses, each counted once: the memory traffic if nothing stays
// in the caches. They are computed, not measured.
#pragma once

#include "sim/scene/scene.h"

#include <nlohmann/json_fwd.hpp>

#include <optional>
#include <string>
#include <vector>

namespace rend {

enum class PassStage { Forces, FurtherForces, Loads, Laws, Solve, Integration, Contact };
const char* name_of(PassStage stage); // "further forces"

struct Pass {
  std::optional<std::string> body; // none: of all
  PassStage stage = PassStage::Forces;
  std::string what;
  std::size_t count = 0;
  std::string of;        // what `count` counts
  double times = 0;      // a step
  std::size_t bytes = 0; // each time
};

// The scene has made a step. Times of schemes that solve are those of that step.
std::vector<Pass> passes_of(const Scene& scene);

nlohmann::ordered_json json_of(const std::vector<Pass>& passes);
std::string passes_in_words(const std::vector<Pass>& passes); // at most 100 columns

} // namespace rend
