// Work over ranges of vertices, on one thread or several. What is computed never depends on how many.
#pragma once

#include <cstddef>
#include <functional>

namespace rend {

// Calls work(begin, end) for `parts` ranges that together are [0, count), on as many threads (oneTBB) or as many as
// the machine has; with one part directly. Returns when all are done.
void in_parts(int parts, std::size_t count,
              const std::function<void(std::size_t begin, std::size_t end)>& work);

int hardware_threads();

} // namespace rend
