// Wavefront's .obj: points and polygons, and the groups and objects that polygons belong to; the rest is
// ignored.
//
// The parser is tinyobjloader. It accepts malformed numbers as 0 and any index, and reports no line numbers; so
// the statements that matter here are checked first: v, f, g, o.
#include "sim/base/wording.h"
#include "sim/mesh/reader.h"
#include "sim/mesh/scanner.h"

#define TINYOBJLOADER_USE_DOUBLE
#include <fmt/format.h>
#include <tiny_obj_loader.h>

#include <charconv>
#include <sstream>

namespace rend {
namespace {

constexpr std::size_t most_corners = 255; // of a polygon, in tinyobjloader

// A corner such as 3, -1, 3/1, 3//2, 3/1/2, of which only the first number is used.
void check_corner(const Scanner& in, std::string_view corner, std::size_t points) {
  std::int64_t value = 0;
  const auto [stop, error] = std::from_chars(corner.data(), corner.data() + corner.size(), value);
  const std::string_view rest = corner.substr(static_cast<std::size_t>(stop - corner.data()));
  if (error != std::errc() || (!rest.empty() && rest[0] != '/') ||
      rest.find_first_not_of("/-0123456789") != std::string_view::npos)
    in.fail(fmt::format("{} is no corner of a polygon", in_quotes(corner)), "f 1 2 3, or f 1/1/1 2/2/2 3/3/3");
  const auto count = static_cast<std::int64_t>(points);
  if (value == 0 || value > count || value < -count)
    in.fail(fmt::format("a polygon has a corner {}, and there are {} points so far, from 1", value, points));
}

void check_polygon(Scanner& in, std::size_t points, MeshFile& file) {
  const Origin origin{in.last(), file.origins.size() + 1};
  std::size_t corners = 0;
  for (; !in.line_ends(); ++corners) check_corner(in, in.token("a corner"), points);
  if (corners < 3)
    in.source().fail(origin.offset, fmt::format("a polygon of {} corners", corners), "it has three or more");
  if (corners > most_corners)
    in.source().fail(origin.offset,
                     fmt::format("a polygon of {} corners, and {} is the most", corners, most_corners));
  file.origins.push_back(origin);
}

// The relevant statements, all of them well formed. tinyobjloader gets no others: for tags (t) it allocates
// what they announce, up to a hundred kilobytes per line.
std::string checked(MeshFile& file) {
  Scanner in(file.source);
  std::string kept;
  std::size_t points = 0;
  while (!in.at_end()) {
    const std::string_view head = in.token("a statement");
    const std::size_t begin = in.last();
    if (head == "v") {
      for (int k = 0; k < 3; ++k) {
        if (in.line_ends()) in.fail("a point of fewer than three coordinates");
        in.real("the coordinate of a point");
      }
      ++points;
    } else if (head == "f") {
      check_polygon(in, points, file);
    } else if (head.ends_with('\\')) {
      in.fail("lines that go on in the next one are not read");
    }
    in.rest_of_line();
    if (head == "v" || head == "f" || head == "g" || head == "o")
      kept.append(file.source.bytes().substr(begin, in.offset() - begin));
  }
  if (file.origins.empty()) file.source.fail("holds no polygons");
  return kept;
}

// A shape's name is what g or o gave: "g left arm" puts polygons into two groups. `members`: of all groups so
// far, limited because a small file could put each polygon into very many.
void add_to_groups(MeshFile& file, const std::string& names, std::span<const std::uint32_t> corners,
                   std::size_t& members) {
  std::istringstream words(names);
  for (std::string name; words >> name;) {
    members += corners.size();
    if (members > 8 * file.source.bytes().size() + 1000000)
      file.source.fail(
          fmt::format("the polygons of group {} are in one group too many: there is a limit on how "
                      "many polygons are in how many groups, of 8 corners a byte of the file",
                      in_quotes(name)));
    auto& group = file.groups[name];
    group.insert(group.end(), corners.begin(), corners.end());
  }
}

void read_obj(MeshFile& file) {
  std::istringstream text(checked(file));
  tinyobj::attrib_t attributes;
  std::vector<tinyobj::shape_t> shapes;
  std::vector<tinyobj::material_t> materials;
  std::string warnings, errors;
  if (!tinyobj::LoadObj(&attributes, &shapes, &materials, &warnings, &errors, &text, nullptr, false))
    file.source.fail("cannot be read: " + in_quotes(errors));
  PolygonMesh mesh;
  std::size_t members = 0;
  mesh.first.push_back(0);
  for (std::size_t n = 0; n + 2 < attributes.vertices.size(); n += 3) {
    mesh.points.emplace_back(attributes.vertices[n], attributes.vertices[n + 1], attributes.vertices[n + 2]);
    mesh.names.push_back(mesh.points.size());
  }
  for (const tinyobj::shape_t& shape : shapes) {
    const std::size_t begin = mesh.corners.size();
    for (const tinyobj::index_t& index : shape.mesh.indices)
      mesh.corners.push_back(static_cast<std::uint32_t>(index.vertex_index));
    for (const unsigned char corners : shape.mesh.num_face_vertices)
      mesh.first.push_back(mesh.first.back() + corners);
    add_to_groups(file, shape.name, std::span(mesh.corners).subspan(begin), members);
  }
  if (mesh.polygons() != file.origins.size())
    file.source.fail(fmt::format("{} polygons were read of {}", mesh.polygons(), file.origins.size()));
  file.mesh = std::move(mesh);
}

} // namespace

MeshReader obj_reader() {
  return {"Wavefront", {".obj"}, "points and polygons; g and o name groups", read_obj};
}

} // namespace rend
