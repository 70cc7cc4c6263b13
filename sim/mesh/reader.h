// Mesh files: .msh, .obj, .off and .moka, read into points and elements, which are then sewn into a map.
//
// Readers check each number; errors of the mesh as a sheet or solid are found when it is sewn, and then
// reported with their place in the file as well.
//
// To add a format: a file with a function `MeshReader my_reader()`, and its name in all_readers().
#pragma once

#include "sim/mesh/cells.h"
#include "sim/mesh/polygons.h"
#include "sim/mesh/source.h"

#include <map>
#include <string>
#include <variant>
#include <vector>

namespace rend {

// A map with a point for every dart.
struct MapMesh {
  std::vector<Vec3> points; // [m]
  GMap map{3};
  std::vector<std::uint32_t> point; // index of each dart's point
};

// The place of an element in the file, and its name there.
struct Origin {
  std::size_t offset = 0; // [bytes]
  std::uint64_t tag = 0;
};

struct MeshFile {
  MeshSource source;
  std::variant<PolygonMesh, CellMesh, MapMesh> mesh;
  std::vector<Origin> origins;                              // one per element; for a MapMesh one per dart
  std::map<std::string, std::vector<std::uint32_t>> groups; // increasing indices of points
  std::vector<std::string> notes;                           // messages for the user
  std::string texture_note; // why texture coordinates are of no use; empty: they are, or there are none
  std::vector<Vec3>& points() {
    return std::visit([](auto& m) -> std::vector<Vec3>& { return m.points; }, mesh);
  }
};

struct MeshReader {
  std::string name;                    // "Gmsh"
  std::vector<std::string> extensions; // ".msh"
  std::string what;                    // one line
  void (*read)(MeshFile& file);        // fills in all but the source
};
const std::vector<MeshReader>& all_readers();

MeshReader msh_reader();
MeshReader obj_reader();
MeshReader off_reader();
MeshReader moka_reader();

// Chooses the reader by the file's extension. UserError, with file and line or byte: exit 66 if there is no
// such file, else 65.
MeshFile read_mesh(const std::filesystem::path& path);
MeshFile read_mesh(MeshSource source); // its name has the extension

// Reorders the elements and their origins if that improves locality in memory (sim/mesh/locality.h).
void order_for_locality(MeshFile& file);

struct MeshBody {
  std::unique_ptr<EmbeddedMap> map;
  std::map<std::string, std::vector<Slot>> groups; // increasing slots of vertices
  std::vector<std::string> notes;
};

// The points may have been moved since they were read. UserError (65), naming the element and its place, if it
// is no sheet or solid, and for elements without area or volume.
MeshBody sew(MeshFile file);

} // namespace rend
