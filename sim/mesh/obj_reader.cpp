// Wavefront's .obj: points and polygons, texture coordinates of their corners, and the groups and objects that
// polygons belong to; the rest is ignored.
//
// The parser is tinyobjloader. It accepts malformed numbers as 0 and any index, and reports no line numbers; so
// the statements that matter here are checked first: v, vt, f, g, o. Texture coordinates are of use if all
// corners have them; those of a file where only some have are left out, and a note is there for who asks.
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

// What the statements so far have made.
struct Content {
  std::string statements; // the relevant ones, all of them well formed
  std::size_t points = 0;
  std::vector<TexturePlace> places; // of vt
  std::size_t placed = 0, bare = 0; // corners with texture coordinates, and without
};

bool is_among(std::int64_t index, std::size_t size) {
  const auto count = static_cast<std::int64_t>(size);
  return index != 0 && index <= count && index >= -count;
}

// A corner such as 3, -1, 3/1, 3//2, 3/1/2, of which the last number is not used.
void check_corner(const Scanner& in, std::string_view corner, Content& content) {
  const auto read = [&corner](std::int64_t& value) {
    const auto [stop, error] = std::from_chars(corner.data(), corner.data() + corner.size(), value);
    corner.remove_prefix(static_cast<std::size_t>(stop - corner.data()));
    return error == std::errc() && (corner.empty() || corner[0] == '/');
  };
  const std::string_view whole = corner;
  std::int64_t point = 0, place = 0;
  bool well_formed = read(point) && corner.find_first_not_of("/-0123456789") == std::string_view::npos;
  const bool placed = corner.size() > 1 && corner[1] != '/';
  if (placed && well_formed) {
    corner.remove_prefix(1);
    well_formed = read(place);
  }
  if (!well_formed)
    in.fail(fmt::format("{} is no corner of a polygon", in_quotes(whole)), "f 1 2 3, or f 1/1/1 2/2/2 3/3/3");
  if (!is_among(point, content.points))
    in.fail(fmt::format("a polygon has a corner {}, and there are {} points so far, from 1", point,
                        content.points));
  if (placed && !is_among(place, content.places.size()))
    in.fail(fmt::format("a corner has the texture coordinates {}, and there are {} so far, from 1", place,
                        content.places.size()));
  ++(placed ? content.placed : content.bare);
}

void check_polygon(Scanner& in, Content& content, MeshFile& file) {
  const Origin origin{in.last(), file.origins.size() + 1};
  std::size_t corners = 0;
  for (; !in.line_ends(); ++corners) check_corner(in, in.token("a corner"), content);
  if (corners < 3)
    in.source().fail(origin.offset, fmt::format("a polygon of {} corners", corners), "it has three or more");
  if (corners > most_corners)
    in.source().fail(origin.offset,
                     fmt::format("a polygon of {} corners, and {} is the most", corners, most_corners));
  file.origins.push_back(origin);
}

// Texture coordinates: u, and v, which is 0 where it is not given. tinyobjloader rounds numbers: these are kept
// as they are read here.
TexturePlace texture_place(Scanner& in) {
  constexpr double most = 1e6; // pictures away from the picture
  const auto coordinate = [&] {
    const double x = in.real("a texture coordinate");
    if (std::abs(x) > most)
      in.fail(fmt::format("the texture coordinate {:g}, and {:g} is the largest", x, most), "vt 0.5 0.25");
    return x;
  };
  TexturePlace place{0, 0};
  if (in.line_ends()) in.fail("texture coordinates without numbers", "vt 0.5 0.25");
  place.u = coordinate();
  if (!in.line_ends()) place.v = coordinate();
  return place;
}

// tinyobjloader gets no other statements: for tags (t) it allocates what they announce, up to a hundred
// kilobytes per line.
Content checked(MeshFile& file) {
  Scanner in(file.source);
  Content content;
  while (!in.at_end()) {
    const std::string_view head = in.token("a statement");
    const std::size_t begin = in.last();
    if (head == "v") {
      for (int k = 0; k < 3; ++k) {
        if (in.line_ends()) in.fail("a point of fewer than three coordinates");
        in.real("the coordinate of a point");
      }
      ++content.points;
    } else if (head == "vt") {
      content.places.push_back(texture_place(in));
    } else if (head == "f") {
      check_polygon(in, content, file);
    } else if (head.ends_with('\\')) {
      in.fail("lines that go on in the next one are not read");
    }
    in.rest_of_line();
    if (head == "v" || head == "vt" || head == "f" || head == "g" || head == "o")
      content.statements.append(file.source.bytes().substr(begin, in.offset() - begin));
  }
  if (file.origins.empty()) file.source.fail("holds no polygons");
  if (content.placed > 0 && content.bare > 0)
    file.texture_note =
        fmt::format("{}: {} corners of polygons have texture coordinates (vt), and {} have none: they are not "
                    "used, and the picture lies as on a mesh without them",
                    file.source.name(), content.placed, content.bare);
  return content;
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
  const Content content = checked(file);
  std::istringstream text(content.statements);
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
    for (const tinyobj::index_t& index : shape.mesh.indices) {
      mesh.corners.push_back(static_cast<std::uint32_t>(index.vertex_index));
      if (content.bare == 0)
        mesh.texture.push_back(content.places.at(static_cast<std::size_t>(index.texcoord_index)));
    }
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
  return {"Wavefront", {".obj"}, "points, polygons and texture coordinates; g and o name groups", read_obj};
}

} // namespace rend
