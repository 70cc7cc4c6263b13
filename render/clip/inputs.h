// The files that a scene depends on besides its preset: meshes, rules and pictures.
#pragma once

#include "sim/base/parameters.h"

#include <string>

namespace rend {

// A line for each file that the scene names, with the hash of its content (of no bytes, where it cannot be
// read): for keys of what depends on them.
std::string hashes_of_files(const PresetNode& scene);

} // namespace rend
