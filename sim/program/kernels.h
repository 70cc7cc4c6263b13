// The inner loops: forces of packed rows, added in the order of the rows.
//
// A kernel runs over the blocks of a table and writes to vertices (or to element corners) in [low, high) alone. A
// block that reaches beyond is run by every part it touches, and each part writes what it owns: the sum at a vertex
// is that of its rows in their order, whatever the number of parts, and no atomics are needed.
#pragma once

#include "sim/base/record.h"
#include "sim/program/packed_rows.h"

namespace rend {

struct KernelArguments {
  const PackedRows& rows;
  const Record* position;  // [m], one per vertex slot
  const Record* velocity;  // [m/s], one per vertex slot
  Record* force;           // [N], one per vertex slot; with corners: one per corner slot
  std::uint32_t low, high; // vertex slots to write; ignored with corners
  std::size_t first, last; // blocks of rows to run: [first, last)
};

// Springs (spring_law.h), four rows at a time: 2.3 ns a spring where a plain loop over x, y, z takes 4.2 to 4.9.
void spring_forces(const KernelArguments& a, bool damped);
void spring_corner_forces(const KernelArguments& a, bool damped); // index columns 2, 3: corners

// Hinges (hinge_law.h).
void hinge_forces(const KernelArguments& a);
void hinge_corner_forces(const KernelArguments& a); // index columns 8..15: corners

} // namespace rend
