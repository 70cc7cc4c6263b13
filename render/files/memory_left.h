// Whether there is memory left for what libraries take. Mesa and LLVM do not look everywhere whether they got
// what they asked for: without it they crash, or draw less than they were told.
#pragma once

#include <cstddef>

namespace rend {

// More than a library takes at once for itself: pictures and textures are asked for by name, and refused in
// words.
constexpr std::size_t enough_for_libraries = std::size_t{32} << 20U; // [bytes]

// Whether the system would give so much at once [bytes]. Tried, and given back; it may be asked in a signal
// handler.
bool is_memory_left(std::size_t bytes = enough_for_libraries);

// Throws UserError (OutOfBudget): "there is not enough memory to draw pictures".
[[noreturn]] void refuse_without_memory();

} // namespace rend
