// Whether memory is left for libraries. Mesa and LLVM do not check every allocation: without memory they crash,
// or draw less than they were told.
#pragma once

#include <cstddef>

namespace rend {

// More than a library allocates at once for itself; pictures and textures are allocated explicitly, and their
// failure is reported.
constexpr std::size_t enough_for_libraries = std::size_t{32} << 20U; // [bytes]

// Whether the system would give so much at once [bytes]: allocates it, and frees it again. Safe in a signal
// handler.
bool is_memory_left(std::size_t bytes = enough_for_libraries);

// Throws UserError (OutOfBudget): "there is not enough memory to draw pictures".
[[noreturn]] void refuse_without_memory();

} // namespace rend
