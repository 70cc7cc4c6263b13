// Uses only the libraries of the simulation: six squares sewn into a cube. Prints its vertices, edges, faces,
// and V - E + F.
#include "sim/mesh/polygons.h"
#include "sim/topology/count.h"

#include <cstdio>

int main() {
  rend::PolygonMesh mesh;
  for (int n = 0; n < 8; ++n) mesh.points.push_back({double(n & 1), double(n >> 1 & 1), double(n >> 2)});
  mesh.add({0, 1, 3, 2});
  mesh.add({4, 5, 7, 6});
  mesh.add({0, 1, 5, 4});
  mesh.add({2, 3, 7, 6});
  mesh.add({0, 2, 6, 4});
  mesh.add({1, 3, 7, 5});
  const rend::CellCounts counts = rend::count_cells(rend::sheet_from(mesh)->map());
  std::printf("%zu %zu %zu %ld\n", counts.vertices, counts.edges, counts.faces, counts.euler);
}
