// The width of the terminal.
#pragma once

#include <cstddef>
#include <cstdio>
#include <optional>

namespace rend {

// Columns of the terminal that `stream` is, as it is now; nothing where it is none, or does not know.
std::optional<std::size_t> terminal_columns(std::FILE* stream);

// Columns of a page of text: the variable COLUMNS, or else those of the terminal, at most `most` and at least
// 20; `most` where neither is known.
std::size_t text_columns(std::FILE* stream, std::size_t most);

} // namespace rend
