// How much memory a program may still take: what the machine has left, and what the control groups leave that
// it runs in, by which Slurm (--mem), containers and systemd bound it; each group's limit holds for those
// below, too.
//
//   the least of MemAvailable and, over the group and its parents, limit - (usage - inactive file pages)
//
// Inactive file pages count as usage, and go where memory is wanted. Limit and usage are memory.max and
// memory.current of version 2 of the groups, memory.limit_in_bytes and memory.usage_in_bytes of version 1.
#pragma once

#include <cstddef>
#include <filesystem>

namespace rend {

// [bytes]. `root` is the folder that /proc and the mounted groups are looked for in. A machine that tells
// nothing: 1 GiB.
std::size_t available_memory(const std::filesystem::path& root = "/");

} // namespace rend
