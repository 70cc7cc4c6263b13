// Starts the threads of parallel_ranges() (threads.h) before there is work for them.
#pragma once

namespace rend {

// Starts the threads that parallel_ranges() needs for `wanted` parts, unless they run already. Returns the
// number of threads including the calling one: fewer than `wanted` if the machine has fewer, or the system
// refuses to start more. parallel_ranges() itself starts those that are missing; where several threads call it,
// ask here for the sum.
int start_threads(int wanted);

bool threads_refused(); // the system has started fewer threads than were wanted

} // namespace rend
