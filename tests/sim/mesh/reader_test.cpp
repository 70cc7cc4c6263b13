// Files of every format and variant, written by Gmsh, by rend and by the test, against the maps that they were
// made from.
#include "sim/mesh/reader.h"

#include "sim/mechanics/mass.h"
#include "sim/mesh/moka.h"
#include "sim/mesh/tube.h"
#include "sim/topology/count.h"
#include "sim/topology/isomorphism.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <set>

#include "sim/assets.h"
#include "sim/mesh/mesh_files.h"

namespace rend::reader_test {
namespace {

using files::Folder;

// The same links, and the same positions to 1e-12.
bool same(const EmbeddedMap& a, const EmbeddedMap& b) {
  if (a.dimension() != b.dimension()) return false;
  return isomorphism(a.map(), b.map(),
                     [&](Dart d, Dart e) { return (a.rest_of(d) - b.rest_of(e)).norm() < 1e-12; })
      .has_value();
}

struct Flavour {
  const char* name;
  const char* options;
};
constexpr std::array<Flavour, 4> flavours{{{"22.msh", "-format msh22"},
                                           {"22b.msh", "-format msh22 -bin"},
                                           {"41.msh", "-format msh41"},
                                           {"41b.msh", "-format msh41 -bin"}}};

TEST(MeshFiles, that_gmsh_converts_into_every_flavour_are_the_same_map) {
  for (const bool solid : {true, false}) {
    const auto map = solid ? files::mixed_bar() : files::mixed_sheet();
    const Folder folder;
    folder.write("in.msh", files::text_of(solid ? files::mixed_bar() : files::mixed_sheet()));
    for (const Flavour& flavour : flavours) {
      SCOPED_TRACE(flavour.name);
      folder.gmsh(std::string("in.msh -save -save_all ") + flavour.options + " -o " + flavour.name);
      const MeshBody body = sew(read_mesh(folder.path() / flavour.name));
      ASSERT_EQ(validate(*body.map), std::nullopt);
      EXPECT_TRUE(same(*map, *body.map));
    }
  }
}

constexpr const char* block_geo = R"(SetFactory("OpenCASCADE");
Box(1) = {0, 0, 0, 2, 1, 1};
Box(2) = {2, 0, 0, 1, 1, 1};
BooleanFragments{ Volume{1}; Delete; }{ Volume{2}; Delete; }
Mesh.MeshSizeMax = 0.6;
Physical Volume("left part") = {1};
Physical Volume(9) = {2};
Physical Volume("all") = {1, 2};
Physical Surface("end") = Surface In BoundingBox{-0.1, -0.1, -0.1, 0.1, 1.1, 1.1};
Physical Curve("edge") = Curve In BoundingBox{-0.1, -0.1, -0.1, 0.1, 0.1, 1.1};
Physical Point("corner") = Point In BoundingBox{-0.1, -0.1, -0.1, 0.1, 0.1, 0.1};
)";

TEST(MeshFiles, that_gmsh_meshes_have_the_same_map_and_groups_in_every_flavour) {
  const Folder folder;
  folder.write("block.geo", block_geo);
  folder.gmsh("block.geo -3 -format msh41 -o whole.msh");
  const MeshBody first = sew(read_mesh(folder.path() / "whole.msh"));
  EXPECT_EQ(count_cells(first.map->map()).euler, 1);
  EXPECT_EQ(count_cells(first.map->map()).fragments, 1u);
  const auto& mass = first.map->add(CornerMass{.density = 1}.on(*first.map));
  EXPECT_NEAR(total_mass(*first.map, mass), 3, 1e-12);
  for (const Flavour& flavour : flavours) {
    SCOPED_TRACE(flavour.name);
    folder.gmsh(std::string("block.geo -3 ") + flavour.options + " -o " + flavour.name);
    const MeshBody body = sew(read_mesh(folder.path() / flavour.name));
    ASSERT_EQ(validate(*body.map), std::nullopt);
    EXPECT_TRUE(same(*first.map, *body.map));
    std::set<std::string> names;
    for (const auto& [name, slots] : body.groups) names.insert(name);
    EXPECT_EQ(names, (std::set<std::string>{"left part", "9", "all", "end", "edge", "corner"}));
    const auto expect = [&](const std::string& name, auto&& inside) { // as a selector by position would select
      std::vector<Slot> slots;
      for (Slot v = 0; v < body.map->cells(Vertex).slots(); ++v)
        if (inside(body.map->rest()[v].vec())) slots.push_back(v);
      EXPECT_EQ(body.groups.at(name), slots) << name;
    };
    expect("left part", [](const Vec3& x) { return x.x() < 2 + 1e-9; });
    expect("9", [](const Vec3& x) { return x.x() > 2 - 1e-9; });
    expect("all", [](const Vec3&) { return true; });
    expect("end", [](const Vec3& x) { return x.x() < 1e-9; });
    expect("edge", [](const Vec3& x) { return x.x() < 1e-9 && x.y() < 1e-9; });
    expect("corner", [](const Vec3& x) { return x.norm() < 1e-9; });
  }
}

TEST(MeshFiles, of_obj_and_off_are_the_sheet_that_they_list) {
  SheetShape shape;
  shape.pattern = SheetPattern::Mixed;
  shape.nx = 3;
  shape.ny = 2;
  shape.size = {3, 2};
  const PolygonMesh mesh = sheet_polygons(shape);
  EXPECT_TRUE(same(*sheet_from(mesh), *files::read("a.obj", files::obj_text(mesh)).map));
  EXPECT_TRUE(same(*sheet_from(mesh), *files::read("a.off", files::off_text(mesh)).map));
}

// A corner has the place that its polygon says, also where another polygon has the same point elsewhere.
TEST(MeshFiles, of_obj_have_texture_coordinates_at_corners) {
  const std::string text = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 2 0 0\n"
                           "vt 0.1 0.2\nvt 0.3 0.7 0\nvt 0.123456789012345678 1e-3\nvt 2\n"
                           "f 1/1 2/2/1 3/-2 4/4\nf 5/1 3/2 2/-1\n";
  const MeshBody body = files::read("a.obj", text);
  const auto* places = find_texture_coordinates(*body.map);
  ASSERT_TRUE(places);
  const std::array<TexturePlace, 4> vt{{{0.1, 0.2}, {0.3, 0.7}, {0.123456789012345678, 1e-3}, {2, 0}}};
  const std::map<std::pair<int, std::pair<double, double>>, int> expected{
      {{0, {0, 0}}, 0}, {{0, {1, 0}}, 1}, {{0, {1, 1}}, 2}, {{0, {0, 1}}, 3},
      {{1, {2, 0}}, 0}, {{1, {1, 1}}, 1}, {{1, {1, 0}}, 3}};
  int corners = 0;
  body.map->map().for_each_dart([&](Dart d) { // of the quad are the first eight
    const Vec3 x = body.map->rest_of(d);
    EXPECT_EQ((*places)[body.map->slot(VertexOfFace, d)],
              vt[static_cast<std::size_t>(expected.at({d.value < 8 ? 0 : 1, {x.x(), x.y()}}))]);
    ++corners;
  });
  EXPECT_EQ(corners, 14);
  EXPECT_FALSE(
      find_texture_coordinates(*files::read("a.obj", "v 0 0 0\nv 1 0 0\nv 1 1 0\nvt 1 1\nf 1 2 3\n").map));
}

TEST(MeshFiles, of_obj_in_which_some_corners_have_no_texture_coordinates_say_so) {
  MeshFile file = read_mesh(MeshSource("a.obj", "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nvt 0 0\n"
                                                "f 1/1 2/1 3/1\nf 1 3//1 4/1\n"));
  EXPECT_THAT(file.texture_note,
              testing::HasSubstr("4 corners of polygons have texture coordinates (vt), and 2 "));
  EXPECT_TRUE(std::get<PolygonMesh>(file.mesh).texture.empty());
  EXPECT_TRUE(file.notes.empty());
}

TEST(MeshFiles, of_obj_keep_polygons_and_name_groups) {
  const MeshBody body =
      files::read("a.OBJ", "# a house\nmtllib none.mtl\nv 0 0 0\nv 1 0 0 1.0\nv 1 1 0\nv 0.5 2 0\n"
                           "v 0 1 0\nv 2 0 0\nvn 0 0 1\nvt 0 0\no house\nf 1//1 2//1 3 4 5/1\n"
                           "g shed left\nf -5 -1 -4\n");
  EXPECT_EQ(count_cells(body.map->map(), FaceOfVolume), 2u);
  EXPECT_EQ(body.map->map().dart_count(), 16u);
  EXPECT_EQ(body.map->cells(Vertex).count(), 6u);
  ASSERT_EQ(body.groups.size(), 3u);
  EXPECT_EQ(body.groups.at("house").size(), 5u);
  EXPECT_EQ(body.groups.at("shed").size(), 3u);
  EXPECT_EQ(body.groups.at("left"), body.groups.at("shed"));
}

TEST(MeshFiles, of_off_take_comments_colours_and_windows_line_ends) {
  const MeshBody body =
      files::read("a.off", "# x\r\nCOFF # y\r\n3 1 0\r\n0 0 0 255 0 0 255\r\n# z\r\n1 0 0 1 1 1 "
                           "1\r\n0 1 0 0 0 0 0\r\n3 0 1 2 0.5 0.5 0.5\r\n\r\n");
  EXPECT_EQ(body.map->map().dart_count(), 6u);
}

TEST(MeshFiles, of_moka_go_out_and_come_back_as_the_same_map) {
  std::vector<std::unique_ptr<EmbeddedMap>> bodies;
  for (auto pattern : {BarPattern::Hexahedra, BarPattern::Tetrahedra, BarPattern::Prisms, BarPattern::Mixed})
    bodies.push_back(solid_from(bar_cells({pattern, 4, 2, 2, Vec3(1, 0.3, 1. / 3)})));
  bodies.push_back(solid_from(tube_cells({8, 4, Vec3(1, 1, 3), 0.1})));
  bodies.push_back(files::mixed_sheet());
  bodies.push_back(assets::loop_of_quads(5, false));
  bodies.push_back(assets::row_of_cubes(1));
  bodies[3]->edit([&](Edit& edit) { // a bar in several pieces, with darts removed
    for (std::uint32_t d = 0; d < 300; d += 7) unsew(edit, 3, Dart{d});
    remove_orbit(edit, Volume, Dart{0u});
  });
  for (const auto& body : bodies) {
    const std::string text = moka_text(*body);
    const MeshBody back = files::read("a.moka", text);
    ASSERT_EQ(validate(*back.map), std::nullopt);
    EXPECT_TRUE(same(*body, *back.map));
    EXPECT_EQ(back.map->cells(Vertex).count(), body->cells(Vertex).count());
  }
  // darts of cells that are numbered as by sew_cells() keep their numbers
  for (std::size_t n : {0, 1, 2, 4})
    EXPECT_EQ(moka_text(*bodies[n]), moka_text(*files::read("a.moka", moka_text(*bodies[n])).map));
}

TEST(MeshFiles, of_moka_give_cells_the_order_of_darts_that_others_have) {
  const auto bar = solid_from(bar_cells({BarPattern::Mixed, 3, 2, 1, Vec3(1, 1, 1)}));
  MapMesh mesh;
  mesh.map = bar->map();
  std::vector<Dart> shuffled;
  bar->map().for_each_dart([&](Dart d) { shuffled.push_back(d); });
  std::shuffle(shuffled.begin(), shuffled.end(), std::mt19937(3));
  std::string text = "Moka file [ascii]\n64 7 0 0 0 0 0 0\n";
  std::vector<std::uint32_t> number(shuffled.size());
  for (std::uint32_t n = 0; n < shuffled.size(); ++n) number[shuffled[n].value] = n;
  for (const Dart d : shuffled) {
    for (int i = 0; i < 4; ++i) text += std::to_string(number[bar->map().alpha(i, d).value]) + " ";
    const Vec3 x = bar->rest_of(d);
    text +=
        "0 0 0 0 1 " + std::to_string(x.x()) + " " + std::to_string(x.y()) + " " + std::to_string(x.z()) + "\n";
  }
  // std::to_string rounds to 6 digits: only topology and orientation are compared
  const MeshBody back = files::read("a.moka", text);
  EXPECT_TRUE(isomorphism(bar->map(), back.map->map()).has_value());
  const CellIndex cells(back.map->map(), Volume);
  for (Slot c = 0; c < cells.slots(); ++c) {
    const Dart d = cells.first_dart(c);
    const GMap& map = back.map->map();
    const auto at = [&](const char* word) { return back.map->rest_of(map.follow(d, std::string(word))); };
    EXPECT_GT((at("0") - at("")).cross(at("10") - at("")).dot(at("210") - at("")), 0);
    const std::size_t darts = darts_of(map, Volume, d).size(),
                      sides = darts_of(map, FaceOfVolume, d).size() / 2;
    EXPECT_EQ(sides, darts == 24 || darts == 36 ? 3u : 4u);
  }
}

TEST(MeshFiles, written_as_msh_come_back_with_their_groups) {
  MeshBody body;
  body.map = files::mixed_bar();
  body.groups["low end"] = {0, 2, 3};
  const MeshBody back = files::read("a.msh", msh_text(body, "a"));
  EXPECT_TRUE(same(*body.map, *back.map));
  EXPECT_EQ(back.groups.at("low end").size(), 3u);
}

TEST(MeshFiles, with_cells_inside_out_say_so) {
  std::string text = files::text_of(files::mixed_bar());
  const MeshBody whole = files::read("a.msh", text);
  EXPECT_TRUE(whole.notes.empty());
  const std::size_t at = text.find(" 4 2 0 0 ") + 9; // swaps two nodes of the first tetrahedron
  const std::size_t second = text.find(' ', at), third = text.find(' ', second + 1);
  const std::string a = text.substr(at, second - at), b = text.substr(second + 1, third - second - 1);
  text.replace(at, third - at, fmt::format("{} {}", b, a));
  const MeshBody turned = files::read("a.msh", text);
  EXPECT_THAT(turned.notes, testing::ElementsAre(testing::HasSubstr("1 of ")));
  EXPECT_EQ(count_cells(turned.map->map()).euler, 1);
}

TEST(MeshFiles, may_have_tags_with_gaps) {
  const std::string huge = "18446744073709551"; // too sparse for a table
  const MeshBody body =
      files::read("a.msh", "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n3\n" + huge +
                               " 0 0 0\n7 1 0 0\n123456789 0 1 "
                               "0\n$EndNodes\n$Comments\nanything\n$EndComments\n$Elements\n1\n5 2 0 7 " +
                               huge + " 123456789\n$EndElements\n");
  EXPECT_EQ(body.map->map().dart_count(), 6u);
}

} // namespace
} // namespace rend::reader_test
