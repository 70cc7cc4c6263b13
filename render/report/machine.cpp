#include "render/report/machine.h"

#include "render/report/commit.h" // made by commit.cmake
#include "sim/base/threads.h"

#include <fmt/format.h>

#include <fstream>
#include <sys/utsname.h>

namespace rend {
namespace {

std::string processor() {
  std::ifstream file("/proc/cpuinfo");
  for (std::string line; std::getline(file, line);) {
    const std::size_t colon = line.find(": ");
    if (line.starts_with("model name") && colon != std::string::npos) return line.substr(colon + 2);
  }
  return "unknown";
}

std::string system_name() {
  utsname name{};
  if (uname(&name) != 0) return "unknown";
  return fmt::format("{} {} {}", name.sysname, name.release, name.machine);
}

std::string compiler() {
#ifdef __clang__
  return "clang++ " __clang_version__;
#else
  return "g++ " __VERSION__;
#endif
}

} // namespace

Machine this_machine() {
  return {processor(), hardware_threads(), system_name(), compiler(),
          REND_FLAGS,  REND_VERSION,       rend_commit,   rend_commit_date};
}

std::vector<std::pair<std::string, std::string>> described(const Machine& machine) {
  return {{"processor",
           fmt::format("{}, {} thread{}", machine.processor, machine.threads, machine.threads == 1 ? "" : "s")},
          {"system", machine.system},
          {"compiler", fmt::format("{}, {}", machine.compiler, machine.flags)},
          {"rend", fmt::format("{} ({})", machine.version, machine.commit)}};
}

} // namespace rend
