// The speed of this machine at this moment, to compare a run with: memory bandwidth in bytes a second, and
// arithmetic operations a second.
//
//   memory      a_i = b_i + s c_i over arrays larger than the caches: STREAM's triad (McCalpin 1995),
//               two arrays read and one written by non-temporal stores
//   arithmetic  x = x m + a, twelve independent chains in registers: a multiplication and
//               an addition, since the program uses no fused multiply-add
//
// Both at the program's SIMD width (sim/base/simd_width.h), on the given number of threads; the best of several
// tries.
#pragma once

namespace rend {

struct MachineSpeed {
  int threads = 1;
  double bytes = 0;      // per second, read and written
  double operations = 0; // per second
};
MachineSpeed measure_machine(int threads); // takes some tenths of a second and 192 MiB

} // namespace rend
