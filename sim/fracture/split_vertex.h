// Whether split-vertex (change.h) would part anything; and how pieces of a body (piece.h) are parted instead.
#pragma once

#include "sim/fracture/change.h"

namespace rend {

// Whether elements lie on both sides of the plane at the vertex with these darts, and are connected across
// it.
bool can_be_split(const ForceView& view, const FoundPlace& found, std::span<const Dart> darts);

// Splits the vertex with these darts along walls between pieces alone. Of each piece there, all elements go
// to one side, by the mean of their heights
//
//   side of piece p = [h_p ≥ h],   h_p the mean of (c_e − x)·n over its elements at the vertex
//
// with h = 0 if there are pieces on both sides of the plane, and else between the lowest and the highest.
// False: no wall is left there, or elements at the vertex have been made in this edit; nothing changed.
bool part_pieces(Edit& edit, const ForceView& view, const FoundPlace& found, std::span<const Dart> darts);

// Whether a wall is among the borders of these darts; false where elements there were made in this edit.
bool parts_pieces(const Edit& edit, const ForceView& view, std::span<const Dart> darts);

} // namespace rend
