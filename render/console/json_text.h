// JSON as it is written: names of files come from outside, and may hold bytes that are no UTF-8, which JSON
// must be.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include <string>

namespace rend {

// On one line, or indented. What is no character of UTF-8 becomes U+FFFD; what could act on a terminal
// (sim/base/printable.h) stands as \u202e: a reader of JSON gets the name as it is.
std::string text_of(const nlohmann::ordered_json& json, int indent = -1);

} // namespace rend
