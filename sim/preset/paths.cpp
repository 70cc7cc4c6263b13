#include "sim/preset/paths.h"

#include "sim/base/wording.h"

#include <fmt/format.h>

#include <algorithm>
#include <system_error>

namespace rend {
namespace {

namespace fs = std::filesystem;

void check(const PresetNode& node) {
  if (stays_below(fs::path(node.place().file).parent_path(), node.text("file"))) return;
  node.fail("file", fmt::format("{} is outside of the preset's folder", in_quotes(node.text("file"))),
            fmt::format("put the {} beside the preset, or allow it with --allow-path",
                        node.name() == "mesh" ? "mesh" : "file"));
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

std::filesystem::path named_path(const PresetNode& node) {
  return mesh_path(node.place(), node.text("file"));
}

std::vector<const PresetNode*> files_of(const PresetNode& scene) {
  std::vector<const PresetNode*> files = scene.all("rules");
  for (const PresetNode* body : scene.all("body"))
    for (const PresetNode* mesh : body->all("mesh")) files.push_back(mesh);
  return files;
}

void check_paths(const PresetNode& scene) {
  for (const PresetNode* node : files_of(scene)) check(*node);
}

} // namespace rend
