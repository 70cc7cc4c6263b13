// Geomview's .off, ASCII: the word OFF (or COFF, NOFF, CNOFF, STOFF: more numbers on a point's line, which are
// skipped), then the numbers of points, faces and edges, the points, and the faces: a number of corners, their
// points, and perhaps a colour. # starts a comment.
#include "sim/base/wording.h"
#include "sim/mesh/reader.h"
#include "sim/mesh/scanner.h"

#include <fmt/format.h>

namespace rend {
namespace {

void read_points(Scanner& in, std::uint64_t count, PolygonMesh& mesh) {
  for (std::uint64_t n = 0; n < count; ++n) {
    in.skip_comments('#');
    const double x = in.real("the coordinate of a point"), y = in.real("the coordinate of a point");
    mesh.points.emplace_back(x, y, in.real("the coordinate of a point"));
    in.rest_of_line(); // colours, normals
  }
}

void read_face(Scanner& in, PolygonMesh& mesh) {
  in.skip_comments('#');
  const std::uint64_t corners = in.size("the number of a face's corners");
  if (corners < 3) in.fail(fmt::format("a face of {} corners", corners), "a face has three or more");
  in.check_count(corners, 2, "corners");
  for (std::uint64_t k = 0; k < corners; ++k) {
    const std::uint64_t point = in.size("the point of a corner");
    if (point >= mesh.points.size())
      in.fail(
          fmt::format("a face has a corner {}, and there are {} points, from 0", point, mesh.points.size()));
    mesh.corners.push_back(static_cast<std::uint32_t>(point));
  }
  in.rest_of_line(); // a colour
  mesh.first.push_back(static_cast<std::uint32_t>(mesh.corners.size()));
}

void read_off(MeshFile& file) {
  Scanner in(file.source);
  in.skip_comments('#');
  const std::string_view head = in.token("the word OFF");
  bool known = false;
  for (const char* word : {"OFF", "COFF", "NOFF", "CNOFF", "STOFF", "STCOFF", "STNOFF", "STCNOFF"})
    known = known || head == word;
  if (!known) in.fail(fmt::format("the word OFF is expected, and {} is not read", in_quotes(head)));
  if (!in.line_ends() && in.source().bytes().substr(in.offset()).starts_with("BINARY"))
    in.fail("binary OFF is not read", "write it as ASCII");
  in.skip_comments('#');
  const std::uint64_t points = in.size("the number of points");
  in.check_count(points, 6, "points");
  const std::uint64_t faces = in.size("the number of faces");
  in.check_count(faces, 8, "faces");
  if (!in.line_ends()) in.size("the number of edges");
  PolygonMesh mesh;
  mesh.first.push_back(0);
  read_points(in, points, mesh);
  for (std::uint64_t n = 0; n < faces; ++n) {
    in.skip_comments('#');
    file.origins.push_back({in.offset(), n});
    read_face(in, mesh);
  }
  in.skip_comments('#');
  if (!in.at_end()) {
    in.token("nothing");
    in.fail(fmt::format("there is more after the {} faces that were announced", faces));
  }
  if (faces == 0) file.source.fail("holds no faces");
  file.mesh = std::move(mesh);
}

} // namespace

MeshReader off_reader() {
  return {"OFF", {".off"}, "polygons, ASCII", read_off};
}

} // namespace rend
