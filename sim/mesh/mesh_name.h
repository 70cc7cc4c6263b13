// Whether a file is a mesh, judged by its name: for a hint where a preset is expected.
#pragma once

#include "sim/mesh/reader.h"

#include <algorithm>

namespace rend {

inline bool is_mesh_name(const std::filesystem::path& path) {
  const std::string extension = path.extension().string();
  return std::any_of(all_readers().begin(), all_readers().end(), [&](const MeshReader& reader) {
    const auto& known = reader.extensions;
    return std::find(known.begin(), known.end(), extension) != known.end();
  });
}

} // namespace rend
