// `rend COMMAND --help`: a command with its arguments and options, folded to the width of the terminal.
#pragma once

#include "render/help/usage.h"

#include <cstddef>
#include <string>

namespace rend {

// `name`: as it is typed, "rend mesh info". No line is wider than `columns`, unless a single word is.
std::string command_page(const CommandUsage& command, const std::string& name, std::size_t columns);

// What `rend` alone prints: a line a command, and where to read on.
std::string short_help(const CommandUsage& program, std::size_t columns);

} // namespace rend
