// What `rend mesh info` tells of a mesh.
#pragma once

#include "sim/mesh/reader.h"

#include <nlohmann/json.hpp>

namespace rend {

nlohmann::ordered_json mesh_facts(const MeshBody& body, const std::string& file);
std::string facts_in_words(const nlohmann::ordered_json& facts);

} // namespace rend
