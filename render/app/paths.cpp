#include "render/app/paths.h"

#include "sim/base/wording.h"
#include "sim/scene/shape.h"

#include <fmt/format.h>

#include <algorithm>

namespace rend {
namespace {

namespace fs = std::filesystem;

void check(const Node& mesh) {
  const fs::path name = mesh.text("file");
  const fs::path preset = mesh.place().file;
  const fs::path folder = preset.parent_path().empty() ? fs::path(".") : preset.parent_path();
  const bool up = std::find(name.begin(), name.end(), "..") != name.end();
  if (!name.is_absolute() && !up && lies_in(mesh_path(mesh), folder)) return;
  mesh.fail("file", fmt::format("{} is outside of the preset's folder", in_quotes(name.string())),
            "put the mesh beside the preset, or allow it with --allow-path");
}

} // namespace

bool lies_in(const fs::path& path, const fs::path& folder) {
  const fs::path inner = fs::weakly_canonical(fs::absolute(path)),
                 outer = fs::weakly_canonical(fs::absolute(folder));
  return std::mismatch(outer.begin(), outer.end(), inner.begin(), inner.end()).first == outer.end();
}

void check_paths(const Node& scene) {
  for (const Node* body : scene.all("body"))
    for (const Node* mesh : body->all("mesh")) check(*mesh);
}

} // namespace rend
