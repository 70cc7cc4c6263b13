// What a report was made on and with: without it, a figure in seconds says little.
#pragma once

#include <string>
#include <utility>
#include <vector>

namespace rend {

struct Machine {
  std::string processor; // "AMD EPYC 7B13"; as the system calls it
  int threads = 0;       // that it runs at once
  std::string system;    // "Linux 6.1.0 x86_64"
  std::string compiler;  // "g++ 12.2.0"
  std::string flags;     // that the program was compiled with
  std::string version;   // of rend
  std::string commit;    // "1a2b3c4d5e6f"; "-dirty": with changes that are not committed
  std::string date;      // of the commit: "2026-11-22"; empty: there is none
};
Machine this_machine();

std::vector<std::pair<std::string, std::string>>
described(const Machine& machine); // names and values, to be listed

} // namespace rend
