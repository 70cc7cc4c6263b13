#include "render/batch/available_memory.h"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <limits>
#include <optional>
#include <sstream>
#include <string>
#include <vector>

namespace rend {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t no_limit = std::numeric_limits<std::size_t>::max();

// The file names of one cgroup version.
struct Files {
  const char *limit, *usage, *inactive;
};
constexpr Files version_1{"memory.limit_in_bytes", "memory.usage_in_bytes", "total_inactive_file"};
constexpr Files version_2{"memory.max", "memory.current", "inactive_file"};

std::optional<std::size_t> number_in(const fs::path& path) { // none for "max" (no limit)
  std::ifstream file(path);
  std::size_t number = 0;
  if (file >> number) return number;
  return {};
}

// Reads a line such as "inactive_file 4096" or "MemAvailable:  4096 kB".
std::optional<std::size_t> number_called(const std::string& wanted, const fs::path& path) {
  std::ifstream file(path);
  std::string name;
  for (std::size_t number = 0; file >> name >> number; file.ignore(64, '\n'))
    if (name == wanted) return number;
  return {};
}

std::size_t room_in(const fs::path& group, const Files& files) {
  const auto limit = number_in(group / files.limit), usage = number_in(group / files.usage);
  if (!limit || !usage) return no_limit;
  const std::size_t inactive = number_called(files.inactive, group / "memory.stat").value_or(0);
  const std::size_t taken = *usage - std::min(inactive, *usage);
  return *limit - std::min(taken, *limit);
}

struct Mount {
  std::string root, point; // the cgroup that is mounted, and where
  bool is_2 = false;
};

// "ID PARENT DEVICE ROOT POINT OPTIONS ... - TYPE SOURCE OPTIONS", as of proc(5).
std::vector<Mount> mounts_of(const fs::path& root) {
  std::vector<Mount> all;
  std::ifstream file(root / "proc/self/mountinfo");
  for (std::string line; std::getline(file, line);) {
    std::istringstream words(line);
    std::string word, type, source, options;
    Mount mount;
    words >> word >> word >> word >> mount.root >> mount.point;
    while (words >> word && word != "-") {
    }
    words >> type >> source >> options;
    mount.is_2 = type == "cgroup2";
    const bool is_1 = type == "cgroup" && fmt::format(",{},", options).find(",memory,") != std::string::npos;
    if (mount.is_2 || is_1) all.push_back(mount);
  }
  return all;
}

// The folder of the cgroup below its mount point. A container sees its own cgroup as the root: a cgroup outside
// of what is mounted is taken as the mount point itself.
fs::path seen_in(const Mount& mount, const std::string& group) {
  const fs::path below = fs::path(group).lexically_relative(mount.root);
  return below.empty() || *below.begin() == ".." ? fs::path() : below;
}

// The least that the cgroup and its mounted parents leave.
std::size_t room_below(const fs::path& root, const Mount& mount, const std::string& group) {
  const Files& files = mount.is_2 ? version_2 : version_1;
  const fs::path point = root / fs::path(mount.point).relative_path();
  std::size_t least = room_in(point, files);
  fs::path at = point;
  for (const fs::path& part : seen_in(mount, group)) least = std::min(least, room_in(at /= part, files));
  return least;
}

std::size_t room_of_groups(const fs::path& root) {
  const std::vector<Mount> mounts = mounts_of(root);
  std::size_t least = no_limit;
  std::ifstream file(root / "proc/self/cgroup"); // "ID:CONTROLLERS:GROUP"
  for (std::string line; std::getline(file, line);) {
    const std::size_t first = line.find(':'), second = line.find(':', first + 1);
    if (second == std::string::npos) continue;
    const std::string controllers = fmt::format(",{},", line.substr(first + 1, second - first - 1));
    const bool is_2 = controllers == ",,", is_1 = controllers.find(",memory,") != std::string::npos;
    for (const Mount& mount : mounts)
      if (mount.is_2 ? is_2 : is_1) least = std::min(least, room_below(root, mount, line.substr(second + 1)));
  }
  return least;
}

} // namespace

std::size_t available_memory(const fs::path& root) {
  const auto kilobytes = number_called("MemAvailable:", root / "proc/meminfo");
  const std::size_t machine = kilobytes ? *kilobytes * 1024 : std::size_t{1} << 30U;
  return std::min(machine, room_of_groups(root));
}

} // namespace rend
