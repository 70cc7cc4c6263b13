// The files that a preset may refer to: those in its own folder or below, so that a preset from elsewhere
// cannot read other files.
#pragma once

#include "sim/base/parameters.h"

#include <filesystem>
#include <string>
#include <vector>

namespace rend {

// Whether `name`, given by a file in `folder`, refers to a file in or below that folder after following
// links: false for an absolute name, for "..", and for a symbolic link that leads out.
bool stays_below(const std::filesystem::path& folder, const std::filesystem::path& name);

// UserError, at the attribute, for an element of a preset that names a file which does not stay below its
// folder (files_of).
void check_paths(const PresetNode& scene);

// Whether `path`, after following links, is `folder` or is below it. A file that does not exist is located by
// its name.
bool lies_in(const std::filesystem::path& path, const std::filesystem::path& folder);

// A file that a preset names, at a place of it: relative to its folder. And the `file` of an
// element.
std::filesystem::path mesh_path(const Place& preset, const std::string& file);
std::filesystem::path named_path(const PresetNode& node);

// A file that an element of a scene names: a mesh, a drawing, a file of rules, or a picture of a look, a mass
// or a law.
struct FileOfPreset {
  const PresetNode* node = nullptr;
  std::string attribute;        // that names it
  std::filesystem::path folder; // to which the name is relative

  const std::string& name() const; // as the preset has it
  std::filesystem::path path() const;
  std::string noun() const; // mesh, picture, drawing, file
};
std::vector<FileOfPreset> files_of(const PresetNode& scene);

} // namespace rend
