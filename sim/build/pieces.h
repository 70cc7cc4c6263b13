// Pieces: a body that is weak along walls between cells of its rest shape, so that it breaks into them.
//
//   <body> <bar pattern="tetrahedra" .../> <pieces count="20" seed="7"/> ... <tear .../> </body>
//   <pieces count="30" pattern="radial" at="0.5 0.4 0" strength="0.2"/>       a pane that is hit there
//
// The elements are cut along the walls of the pattern (piece_pattern.h, cuts/wall_cutter.h), and each belongs
// to the cell in which its middle lies. Cells that fall apart, as in a body that is not convex, are several
// parts then. Until there are as many connected pieces as asked for, the smallest part is joined to the
// neighbour that has most border with it for its size, or the largest is divided by a plane across its
// longest side; so also while the largest is more than three times the smallest.
//
// Each element carries its piece (fracture/piece.h). What laws make of walls: fracture/strength.h.
#pragma once

#include "sim/build/piece_pattern.h"

namespace rend {

// Velocities are 0, positions those at rest. UserError: a body that is no sheet of triangles and no solid of
// tetrahedra; more pieces than its elements can make; what the pattern refuses.
void make_pieces(EmbeddedMap& map, const PiecesSettings& settings);

} // namespace rend
