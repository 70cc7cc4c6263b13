// JSON as text. File names may contain bytes that are not UTF-8, which JSON requires.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include <string>

namespace rend {

// On one line, or indented. Invalid UTF-8 becomes U+FFFD; characters that could control a terminal
// (sim/base/printable.h) are escaped, such as \u202e, so a JSON reader gets the name unchanged.
std::string text_of(const nlohmann::ordered_json& json, int indent = -1);

} // namespace rend
