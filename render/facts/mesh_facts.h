// What `rend mesh info` tells of a mesh.
#pragma once

#include "sim/mesh/reader.h"

#include <nlohmann/json.hpp>

namespace rend {

nlohmann::ordered_json mesh_facts(const MeshBody& body, const std::string& file);
// A file may call its groups by any bytes: what is no UTF-8 is replaced, and control characters are not
// printed.
std::string facts_in_json(const nlohmann::ordered_json& facts);
std::string facts_in_words(const nlohmann::ordered_json& facts);

} // namespace rend
