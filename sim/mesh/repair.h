// Mends polygons that cannot be sewn, as models from elsewhere have them:
//
//   1. a side without length: its two points become one, so that what lies around it closes up;
//   2. a corner that repeats the one before it is dropped;
//   3. a polygon is dropped that has fewer than three corners left, meets a point twice or has no area;
//   4. of polygons with the same corners, all but the first are dropped.
//
// Where a polygon without area had three different points on a line, a slit of no width is left: its neighbours
// on the long side and on the two short ones do not share an edge.
#pragma once

#include "sim/mesh/reader.h"

namespace rend {

struct Repairs {
  std::size_t polygons = 0; // there were
  std::size_t merged = 0;   // points that became others
  std::size_t corners = 0;  // dropped from polygons that stay
  std::size_t flat = 0;     // polygons dropped: no area, too few corners, or a point met twice
  std::size_t copies = 0;   // polygons dropped: as others
};

// Changes the file's mesh, origins and groups. UserError (65) if it holds no polygons, or none that is left.
Repairs repair(MeshFile& file);

// One line for a reader: how many polygons were dropped and points merged, or that none needed it.
std::string in_words(const Repairs& repairs);

} // namespace rend
