// Reads a preset: a file, or a text, becomes checked Nodes, or an error that says where and what would work.
//
// The way: file -> raw elements (sim/preset/raw_preset.h) -> --set (sim/preset/override.h) -> Nodes with values
// of their types -> defaults -> completeness. Nothing here knows what a preset is about: the table `root` says
// it all, but for the format's version.
#pragma once

#include "sim/base/parameters.h"
#include "sim/preset/override.h"

#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <string_view>

namespace rend {

// Larger files are refused: a preset of some thousand elements has about 1e5 bytes.
inline constexpr std::size_t max_preset_bytes = std::size_t{16} << 20U;

// `root` must outlive the Nodes. Throws UserError: NoInput where there is no such file (the hint tells near
// names), BadInput for what is in it, Usage for a path of an override that is not there, ReadWrite if reading
// fails.
std::unique_ptr<PresetNode> read_preset(const std::filesystem::path& path, const ElementType& root,
                                        std::span<const Override> overrides = {});

// The same for a text; `file` is what its places are called by.
std::unique_ptr<PresetNode> read_preset_text(std::string_view text, const std::string& file,
                                             const ElementType& root, std::span<const Override> overrides = {});

// The file's text, for those who read it several times. The same errors.
std::string read_preset_file(const std::filesystem::path& path);

} // namespace rend
