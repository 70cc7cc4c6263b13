// What a file that was given may name: files in its own folder or below it, so that one from elsewhere cannot
// look around.
#pragma once

#include "sim/base/parameters.h"

#include <filesystem>
#include <string>

namespace rend {

// Whether `name`, which a file in `folder` gives, leads there or below, links followed: false for an absolute
// name, for "..", and for a symbolic link that leads out.
bool stays_below(const std::filesystem::path& folder, const std::filesystem::path& name);

// UserError, at the attribute, for a <mesh> of a preset whose file does not.
void check_paths(const PresetNode& scene);

// Whether `path`, links followed, is `folder` or lies below it. A file that is not there lies where its name
// says.
bool lies_in(const std::filesystem::path& path, const std::filesystem::path& folder);

// A file that a preset names, at a place of it: relative to its folder. And that of a <mesh>.
std::filesystem::path mesh_path(const Place& preset, const std::string& file);
std::filesystem::path mesh_path(const PresetNode& mesh);

} // namespace rend
