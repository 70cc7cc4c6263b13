// What this machine can do at this moment, to compare a run with: bytes a second to and from memory, and
// operations a second.
//
//   memory      a_i = b_i + s c_i over arrays that no cache of one user holds: STREAM's triad (McCalpin 1995),
//               two arrays read and one written past the caches
//   arithmetic  x = x m + a, twelve of them that do not wait for each other, in registers: a multiplication and
//               an addition, since the program contracts none
//
// Both with the program's own vectors (sim/base/simd_width.h) on so many threads at once, the best of several
// tries.
#pragma once

namespace rend {

struct MachineSpeed {
  int threads = 1;
  double bytes = 0;      // a second, read and written
  double operations = 0; // a second
};
MachineSpeed measure_machine(int threads); // takes some tenths of a second and 192 MiB

} // namespace rend
