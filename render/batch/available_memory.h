// How much memory a program may still take, given what the machine has left and the limits of the control
// groups (cgroups) that it runs in: Slurm (--mem), containers and systemd set them. A cgroup's limit also binds
// the cgroups below it.
//
//   min of MemAvailable and, over the cgroup and its parents, limit - (usage - inactive file pages)
//
// Inactive file pages count as usage, but the kernel reclaims them when memory is needed. Limit and usage are
// memory.max and memory.current in cgroup version 2, memory.limit_in_bytes and memory.usage_in_bytes in version
// 1.
#pragma once

#include <cstddef>
#include <filesystem>

namespace rend {

// [bytes]. `root` is the folder below which /proc and the mounted cgroups are looked for. 1 GiB where the
// machine gives no figure.
std::size_t available_memory(const std::filesystem::path& root = "/");

} // namespace rend
