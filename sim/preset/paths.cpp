#include "sim/preset/paths.h"

#include "sim/base/wording.h"

#include <fmt/format.h>

#include <algorithm>
#include <system_error>

namespace rend {
namespace {

namespace fs = std::filesystem;

void check(const FileOfPreset& file) {
  if (stays_below(file.folder, file.name())) return;
  file.node->fail(file.attribute, fmt::format("{} is outside of the preset's folder", in_quotes(file.name())),
                  fmt::format("put the {} beside the preset, or allow it with --allow-path", file.noun()));
}

// Those of an element that names one by its `file`.
FileOfPreset file_of(const PresetNode& node) {
  return {&node, "file", fs::path(node.place().file).parent_path()};
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

const std::string& FileOfPreset::name() const {
  return node->text(attribute);
}

std::filesystem::path FileOfPreset::path() const {
  return (folder / name()).lexically_normal();
}

std::string FileOfPreset::noun() const {
  return node->name() == "mesh" || node->name() == "obstacle" ? "mesh"
         : node->name() == "outline"                          ? "drawing"
         : node->name() == "rules"                            ? "file"
                                                              : "picture";
}

// An attribute that names a picture may come from the command line alone: its file is relative to the scene's.
std::vector<FileOfPreset> files_of(const PresetNode& scene) {
  std::vector<FileOfPreset> files;
  const fs::path folder = fs::path(scene.place().file).parent_path();
  const auto add_picture = [&](const PresetNode& node, const char* attribute) {
    if (node.find(attribute) && !node.text(attribute).empty()) files.push_back({&node, attribute, folder});
  };
  for (const PresetNode* rules : scene.all("rules")) files.push_back(file_of(*rules));
  for (const PresetNode* body : scene.all("body")) {
    for (const PresetNode* mesh : body->all("mesh")) files.push_back(file_of(*mesh));
    for (const PresetNode* outline : body->all("outline"))
      if (outline->find("file") && !outline->text("file").empty()) files.push_back(file_of(*outline));
    for (const char* element : {"mass", "tear"})
      for (const PresetNode* node : body->all(element)) add_picture(*node, "picture");
    for (const PresetNode* look : body->all("look"))
      for (const char* attribute :
           {"texture", "texture-back", "texture-inside", "roughness", "roughness-inside"})
        add_picture(*look, attribute);
  }
  for (const PresetNode* world : scene.all("world"))
    for (const PresetNode* obstacle : world->all("obstacle")) files.push_back(file_of(*obstacle));
  return files;
}

void check_paths(const PresetNode& scene) {
  for (const FileOfPreset& file : files_of(scene)) check(file);
}

} // namespace rend
