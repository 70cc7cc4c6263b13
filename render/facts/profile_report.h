// Where the time and the bytes of a run went (rend run --profile): by stage of the step, by interaction, and as
// a share of what this machine can do at this moment.
//
// Bytes are those that must be read and written at least, each array once a pass (passes.h,
// sim/rows/row_cost.h): a share of the memory's bandwidth above 1 says that they came from caches. They are
// those of the state at the end.
#pragma once

#include "render/clip/session.h"

#include <nlohmann/json.hpp>
#include <string>

namespace rend {

// Of a session that was asked for a profile; measures the machine. stages, interactions, machine, clock.
nlohmann::ordered_json profile_json(const Session& session);
std::string profile_in_words(const nlohmann::ordered_json& profile); // at most 112 columns

} // namespace rend
