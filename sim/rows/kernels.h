// The inner loops: forces of packed rows, added in the order of the rows.
//
// A kernel runs over the blocks of a table and writes only to vertices in [low, high) (or to element corners).
// A block that writes to several parts is run by each of them, and each writes the vertices that it owns: the
// sum at a vertex is that of its rows in their order, whatever the number of parts, and no atomics are needed.
//
// A law needs no kernel of its own: the plain one gathers a unit's particles and calls the law. To add one: a
// file with a function `Kernel my_kernel()`, and its name in kernel_of().
#pragma once

#include "sim/base/record.h"
#include "sim/mechanics/force_law.h"
#include "sim/rows/packed_rows.h"

namespace rend {

struct KernelArguments {
  const ForceLaw& law;
  const PackedRows& rows;
  const Record* position;  // [m], one per vertex slot
  const Record* velocity;  // [m/s], one per vertex slot
  const Record* rest;      // [m], one per vertex slot
  Record* force;           // [N], one per vertex slot; with corners: one per corner slot
  std::uint32_t low, high; // vertex slots that may be written; ignored with corners
  std::size_t first, last; // blocks of rows to run: [first, last)
  bool damped;             // some row has damping; otherwise springs and hinges have no column for it
};

struct Kernel {
  bool (*fits)(const ForceLaw& law);
  void (*forces)(const KernelArguments& a);        // into vertices: index columns 0 .. particles − 1
  void (*corner_forces)(const KernelArguments& a); // into corners: index columns particles .. 2 particles − 1
};

const Kernel& kernel_of(const ForceLaw& law); // the first that fits

// spring_law.h, four rows at a time: 2.3 ns per spring instead of 4.2 to 4.9 in a plain loop
Kernel spring_kernel();
Kernel hinge_kernel();   // hinge_law.h, four rows at a time: 18 ns per hinge instead of 130 in the law
Kernel element_kernel(); // element_law.h: element_kernel.h
Kernel tensor_kernel();  // mass_tensor.h, four rows at a time
Kernel plain_kernel();   // any law, unit by unit

} // namespace rend
