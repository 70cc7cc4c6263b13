// Measures of cells while an edit is open, from the points that the edit knows, those of new darts included.
#pragma once

#include "sim/embedding/embedded_map.h"

#include <span>

namespace rend {

// The smallest dart of each distinct vertex of orbit(d), increasing.
std::vector<Dart> vertices_of_orbit(const GMap& map, Orbit orbit, Dart d);
void vertices_of_orbit(const GMap& map, Orbit orbit, Dart d, std::vector<Dart>& out);
void vertices_of_orbit(const Edit& edit, Orbit orbit, Dart d,
                       std::vector<Dart>& out); // faster, where points are known

// A dart at the other end of each edge at the vertex of d, in the order of the edges' smallest darts there;
// `border`: of edges that lie on the border of a sheet, or on the hull of a solid.
void ends_of_edges(const GMap& map, Dart d, bool border, std::vector<Dart>& out);

// The smallest dart at the vertex of d of each cell there (Face or Volume), increasing.
std::vector<Dart> cells_at_vertex(const GMap& map, Orbit cell, Dart d);

// The mean of the means of their vertices, and one dart of each of these.
Point mean_of_cells(const Edit& edit, Orbit cell, Dart d, std::vector<Dart>& vertices);

// The mean of the vertices of orbit(d), each counted once, in the order of their smallest dart in the orbit.
Point mean_point(const Edit& edit, Orbit orbit, Dart d);
Point mean_point(const Edit& edit, std::span<const Dart> vertices); // one dart each

// Half the sum of cross products around the face of d, from d by α0: its length is the area at rest [m²] of a
// planar face.
Vec3 face_vector(const Edit& edit, Dart d, Vec3 Point::*part = &Point::rest);
Vec3 face_vector_rate(const Edit& edit, Dart d); // of that of positions [m²/s]

double volume_at_rest(const Edit& edit, Dart d); // [m³], each face a fan around the mean of its corners

// Why the element of d (a face of a sheet, a volume of a solid) is flat or inverted at rest, as a sentence;
// empty: it is not, or is not closed yet. Corners where three edges meet must all turn the same way.
std::string shape_fault(const Edit& edit, Dart d);

} // namespace rend
