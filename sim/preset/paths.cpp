#include "sim/preset/paths.h"

#include "sim/base/wording.h"

#include <fmt/format.h>

#include <algorithm>
#include <system_error>

namespace rend {
namespace {

namespace fs = std::filesystem;

void check(const PresetNode& mesh) {
  if (stays_below(fs::path(mesh.place().file).parent_path(), mesh.text("file"))) return;
  mesh.fail("file", fmt::format("{} is outside of the preset's folder", in_quotes(mesh.text("file"))),
            "put the mesh beside the preset, or allow it with --allow-path");
}

} // namespace

// A file that does not exist is located by its name; a cycle of links leads nowhere.
bool stays_below(const fs::path& folder, const fs::path& name) {
  if (name.is_absolute() || std::find(name.begin(), name.end(), "..") != name.end()) return false;
  const fs::path here = folder.empty() ? fs::path(".") : folder;
  std::error_code error, other;
  const fs::path outer = fs::weakly_canonical(fs::absolute(here, error), error),
                 inner = fs::weakly_canonical(fs::absolute(here / name, other), other);
  if (error || other) return false;
  const auto [rest, end] = std::mismatch(outer.begin(), outer.end(), inner.begin(), inner.end());
  return rest == outer.end() && end != inner.end();
}

bool lies_in(const fs::path& path, const fs::path& folder) {
  const fs::path inner = fs::weakly_canonical(fs::absolute(path)),
                 outer = fs::weakly_canonical(fs::absolute(folder));
  return std::mismatch(outer.begin(), outer.end(), inner.begin(), inner.end()).first == outer.end();
}

std::filesystem::path mesh_path(const Place& preset, const std::string& file) {
  return (fs::path(preset.file).parent_path() / file).lexically_normal();
}

std::filesystem::path mesh_path(const PresetNode& mesh) {
  return mesh_path(mesh.place(), mesh.text("file"));
}

void check_paths(const PresetNode& scene) {
  for (const PresetNode* body : scene.all("body"))
    for (const PresetNode* mesh : body->all("mesh")) check(*mesh);
}

} // namespace rend
