// A file that settings name, opened.
#pragma once

#include "sim/base/settings.h"
#include "sim/mesh/source.h"

#include <string>

namespace rend {

// `file`: relative to the preset; of settings that a program made, to where it runs. UserError, at the
// attribute file.
MeshSource open_file_of(const SettingsSource& source, const std::string& file);

} // namespace rend
