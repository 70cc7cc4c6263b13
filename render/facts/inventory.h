// What a scene is made of: cells, arrays with their bytes, where the time step comes from, what a step goes
// through, and what is not there. Arrays are those of a scene that has made its first step, since some come
// with it.
#pragma once

#include "render/clip/session.h"

#include <nlohmann/json.hpp>
#include <string>

namespace rend {

nlohmann::ordered_json inventory_of(Session& session);                   // makes the first step
std::string inventory_in_words(const nlohmann::ordered_json& inventory); // at most 100 columns

} // namespace rend
