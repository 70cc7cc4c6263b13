// The machine and build that a report was made with: without them, run times mean little.
#pragma once

#include <string>
#include <utility>
#include <vector>

namespace rend {

struct Machine {
  std::string processor; // "AMD EPYC 7B13"; as the kernel names it
  int threads = 0;       // hardware threads
  std::string system;    // "Linux 6.1.0 x86_64"
  std::string compiler;  // "g++ 12.2.0"
  std::string flags;     // compiler flags of this build
  std::string version;   // of rend
  std::string commit;    // "1a2b3c4d5e6f"; "-dirty": with uncommitted changes
  std::string date;      // of the commit: "2026-11-22"; empty: unknown
};
Machine this_machine();

std::vector<std::pair<std::string, std::string>>
described(const Machine& machine); // names and values, for a list

} // namespace rend
