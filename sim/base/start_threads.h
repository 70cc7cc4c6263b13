// The threads of in_parts() (threads.h), started before there is work for them.
#pragma once

namespace rend {

// Starts what in_parts() needs for so many parts, unless it is there. Returns how many threads there are, the
// calling one among them: fewer than `wanted` where the machine has fewer, or the system starts no more.
// in_parts() itself asks for those that it lacks; where several threads call it, their sum is to be asked for.
int start_threads(int wanted);

bool threads_refused(); // the system has started fewer than were wanted

} // namespace rend
