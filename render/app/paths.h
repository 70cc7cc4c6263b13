// What a preset may read: files in its own folder or below it, so that a preset from elsewhere cannot look
// around.
#pragma once

#include "sim/base/parameters.h"

#include <filesystem>

namespace rend {

// UserError, at the attribute, for a <mesh> whose file is outside: by an absolute name, by "..", by a symbolic
// link.
void check_paths(const Node& scene);

// Whether `path`, links followed, is `folder` or lies below it. A file that is not there lies where its name
// says.
bool lies_in(const std::filesystem::path& path, const std::filesystem::path& folder);

} // namespace rend
