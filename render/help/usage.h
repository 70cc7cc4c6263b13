// What help, manual and completions know of options and presets beside the commands' usage
// (render/console/command_usage.h).
#pragma once

#include "render/console/command_usage.h"

#include <string>
#include <vector>

namespace rend {

struct ElementType;

// A type name: "mp4|webm|mkv".
std::string choices(const std::vector<std::string>& names);

// An attribute that can be given to --set.
struct SettableAttribute {
  std::string path;                // "body.sheet.cells"
  std::vector<std::string> values; // of a keyword or a flag; empty: numbers or text
};

// of all elements at each of their positions; sorted
std::vector<SettableAttribute> settable_attributes(const ElementType& root);
std::vector<std::string> element_names(const ElementType& root); // as `rend help preset` takes them; sorted

} // namespace rend
