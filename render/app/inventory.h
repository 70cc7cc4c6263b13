// What a scene is made of: cells, arrays with their bytes, where the time step comes from, and what is not
// there.
#pragma once

#include "render/app/session.h"

#include <nlohmann/json.hpp>
#include <string>

namespace rend {

nlohmann::ordered_json inventory_of(const Session& session);
std::string inventory_in_words(const nlohmann::ordered_json& inventory); // at most 100 columns

} // namespace rend
