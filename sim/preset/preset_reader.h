// Reads a preset: a file or a text becomes checked PresetNodes, or an error with its place and a hint.
//
// Stages: file -> raw elements (sim/preset/raw_preset.h) -> --set (sim/preset/override.h) -> PresetNodes with
// typed values -> defaults -> completeness. This code does not know the contents of presets: everything but the
// version of the format follows from the table `root`.
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

// `root` must outlive the nodes. Throws UserError: NoInput if there is no such file (the hint suggests similar
// names), BadInput for its content, Usage for an override whose path does not exist, ReadWrite if reading
// fails.
std::unique_ptr<PresetNode> read_preset(const std::filesystem::path& path, const ElementType& root,
                                        std::span<const Override> overrides = {});

// The same for a text; `file` is its name in messages.
std::unique_ptr<PresetNode> read_preset_text(std::string_view text, const std::string& file,
                                             const ElementType& root, std::span<const Override> overrides = {});

// The file's text, for callers that parse it several times. The same errors.
std::string read_preset_file(const std::filesystem::path& path);

} // namespace rend
