// rend mesh, and <mesh> in a preset, as a user runs them.
#include "sim/base/math.h"
#include "sim/base/wall_clock.h"
#include "tests/render/commands/program_run.h"
#include "tests/test_paths.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <gmock/gmock.h>

#include <array>
#include <cmath>
#include <map>
#include <tuple>

namespace rend::mesh_command_test {
namespace {

using program::Outcome;
using program::TestFolder;
using testing::HasSubstr;
namespace fs = std::filesystem;

const fs::path organ = fs::path(test::source_root) / "presets/meshes/organ-600.msh";

// A tetrahedron of four nodes, one of which is in a group.
constexpr const char* tetrahedron =
    "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n1\n0 4 \"top\"\n$EndPhysicalNames\n$Nodes\n4\n1 0 0 "
    "0\n"
    "2 1 0 0\n3 0 1 0\n4 0 0 1\n$EndNodes\n$Elements\n2\n1 15 2 4 0 4\n2 4 2 0 0 1 2 3 4\n$EndElements\n";

std::string preset(const std::string& file, const std::string& more = "") {
  return "<scene name=\"s\"><body name=\"b\"><mesh file=\"" + file + "\"/><mass total=\"2\"/>" + more +
         "</body><world gravity=\"0 0 -10\"/><time step=\"1e-3\" integrator=\"symplectic\" "
         "duration=\"0.01\"/></scene>";
}

// Two triangles, and one without area between them.
TEST(MeshCommand, repairs_polygons_without_area) {
  const TestFolder place;
  place.write("seam.obj", "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 1 0 0\nf 1 2 4\nf 5 3 4\nf 2 5 4\n");
  EXPECT_EQ(place.rend("mesh convert seam.obj whole.msh").code, 65);
  const Outcome outcome = place.rend("mesh convert seam.obj whole.msh --repair");
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_THAT(outcome.err,
              HasSubstr("of 3 polygons 1 without area and 0 copies of others are dropped; 1 point"));
  EXPECT_EQ(place.rend("mesh info whole.msh --json").json()["vertices"], 4);
  EXPECT_EQ(place.rend("mesh convert " + organ.string() + " other.msh --repair").code, 65);
}

TEST(MeshCommand, tells_what_a_mesh_holds) {
  const TestFolder place;
  const Outcome outcome = place.rend("mesh info " + organ.string() + " --json");
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  const auto facts = outcome.json();
  EXPECT_EQ(facts["kind"], "solid");
  EXPECT_EQ(facts["volumes"], facts["elements"]["tetrahedra"]);
  EXPECT_NEAR(facts["volumes"].get<double>(), 600, 50);
  EXPECT_EQ(facts["euler"], 1);
  EXPECT_EQ(facts["groups"]["organ"], facts["vertices"]);
  EXPECT_GE(facts["groups"]["base"].get<int>(), 6);
  EXPECT_THAT(place.rend("mesh info " + organ.string()).out, HasSubstr("group 'base'"));
}

TEST(MeshCommand, converts_to_moka_and_back_without_loss) {
  const TestFolder place;
  ASSERT_EQ(place.rend("mesh convert " + organ.string() + " a.msh").code, 0);
  ASSERT_EQ(place.rend("mesh convert a.msh a.moka").code, 0);
  ASSERT_EQ(place.rend("mesh convert a.moka b.moka").code, 0);
  EXPECT_EQ(program::content(place.path() / "a.moka"), program::content(place.path() / "b.moka"));
  const auto before = place.rend("mesh info " + organ.string() + " --json").json();
  const auto after = place.rend("mesh info a.msh --json").json();
  for (const char* key : {"vertices", "edges", "faces", "volumes", "volume", "groups"})
    EXPECT_EQ(before[key], after[key]) << key;
}

// A cube's sides, counter-clockwise from outside, or (inward) from inside.
std::string cube(bool inward) {
  std::string text = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0 0 1\nv 1 0 1\nv 1 1 1\nv 0 1 1\n";
  for (const auto& [a, b, c, d] : {std::array{1, 4, 3, 2}, std::array{5, 6, 7, 8}, std::array{1, 2, 6, 5},
                                   std::array{2, 3, 7, 6}, std::array{3, 4, 8, 7}, std::array{4, 1, 5, 8}})
    text += inward ? fmt::format("f {} {} {} {}\n", d, c, b, a) : fmt::format("f {} {} {} {}\n", a, b, c, d);
  return text;
}

// Nodes of two unit cubes, one on the other, and a thirteenth above; elements: Gmsh's type, tags, corners.
std::string cubes(const std::vector<std::string>& elements, const std::string& names = "") {
  constexpr std::array corners{"0 0", "1 0", "1 1", "0 1"};
  std::string text = "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n" + names + "$Nodes\n13\n";
  for (std::size_t n = 0; n < 12; ++n) text += fmt::format("{} {} {}\n", n + 1, corners[n % 4], n / 4);
  text += fmt::format("13 0.5 0.5 3\n$EndNodes\n$Elements\n{}\n", elements.size());
  for (std::size_t n = 0; n < elements.size(); ++n) text += fmt::format("{} {}\n", n + 1, elements[n]);
  return text + "$EndElements\n";
}

// Points and faces as a generalized map: of each side of a face two darts, one at each end.
std::string moka(const std::vector<std::string>& points, const std::vector<std::vector<int>>& faces) {
  std::map<std::tuple<int, int>, std::vector<std::size_t>>
      at; // from a point towards another: darts of both faces
  std::vector<std::array<std::size_t, 4>> links;
  std::vector<int> point;
  for (const std::vector<int>& ring : faces) {
    const std::size_t first = links.size(), sides = ring.size();
    for (std::size_t n = 0; n < 2 * sides; ++n) { // sides in turn, the start and the end of each
      const std::size_t side = n / 2, dart = first + n,
                        next = (n % 2 ? n + 1 : n + 2 * sides - 1) % (2 * sides);
      const int here = ring[(side + n % 2) % sides], there = ring[(side + 1 - n % 2) % sides];
      links.push_back({first + (n ^ 1U), first + next, dart, dart});
      point.push_back(here);
      at[{here, there}].push_back(dart);
    }
  }
  for (const auto& [ends, darts] : at)
    if (darts.size() == 2) links[darts[0]][2] = darts[1], links[darts[1]][2] = darts[0];
  std::string text = "Moka file [ascii]\n64 7 0 0 0 0 0 0\n";
  for (std::size_t d = 0; d < links.size(); ++d)
    text +=
        fmt::format("{} 0 0 0 0 1 {}\n", fmt::join(links[d], " "), points[static_cast<std::size_t>(point[d])]);
  return text;
}

// Of every kind of input and both outputs: the same mesh is read back, or nothing is written.
TEST(MeshCommand, what_it_writes_is_read_back_as_the_same_mesh) {
  const TestFolder place;
  const char* group = "$PhysicalNames\n1\n0 7 \"the \"top\" of it\"\n$EndPhysicalNames\n";
  place.write("triangles.obj",
              "g left right\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0.5\nf 1 2 3\ng a\"b\nf 1 3 4\n");
  place.write("quads.obj", "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 2 0 0.25\nv 2 1 0.1\nf 1 2 3 4\nf 2 5 6 3\n");
  place.write("cube.obj", cube(false));
  place.write("inward.obj", cube(true));
  place.write("two.obj", cube(false) + "v 5 5 5\nv 6 5 5\nv 5 6 5\nf 9 10 11\n");
  place.write("bow.obj",
              "v 0 0 0\nv 1 0 0\nv 0 1 0\nv -1 0 0\nv 0 -1 0\nf 1 2 3\nf 1 4 5\n"); // a point in common
  place.write("plane.obj", // projective: closed, with one side
              "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nv 1 1 2\nv 2 1 1\nf 1 2 3\nf 1 3 4\nf 1 4 5\nf 1 5 6\n"
              "f 1 6 2\nf 2 3 5\nf 3 4 6\nf 4 5 2\nf 5 6 3\nf 6 2 4\n");
  place.write("pentagon.off", "OFF\n5 1 0\n0 0 0\n2 0 0\n2 1 0\n1 2 0\n0 1 0\n5 0 1 2 3 4\n");
  place.write("quads.off", "OFF\n6 2 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n2 0 0\n2 1 0\n4 0 1 2 3\n4 1 4 5 2\n");
  place.write("mixed.msh", cubes({"15 2 7 0 13", "5 2 0 0 1 2 3 4 5 6 7 8", "6 2 0 0 5 8 9 6 7 10",
                                  "6 2 0 0 8 12 9 7 11 10", "7 2 0 0 9 10 11 12 13"},
                                 group));
  place.write("tetrahedra.msh", tetrahedron);
  place.write("shell.msh", cubes({"3 2 0 0 1 2 6 5", "2 2 0 0 2 3 7", "2 2 0 0 2 7 6"}));
  place.write("drum.moka",
              moka({"0 0 0", "2 0 0", "2 1 0", "1 2 0", "0 1 0", "0 0 1", "2 0 1", "2 1 1", "1 2 1", "0 1 1"},
                   {{4, 3, 2, 1, 0},
                    {5, 6, 7, 8, 9},
                    {0, 1, 6, 5},
                    {1, 2, 7, 6},
                    {2, 3, 8, 7},
                    {3, 4, 9, 8},
                    {4, 0, 5, 9}}));
  place.write("sheet.moka", moka({"0 0 0", "2 0 0", "2 1 0", "0 1 0", "3 0 1"}, {{0, 1, 2, 3}, {1, 4, 2}}));
  int refused = 0, written = 0;
  for (const std::string& in : place.files())
    for (const char* ending : {".moka", ".msh"}) {
      const Outcome outcome = place.rend("mesh convert " + in + " out" + ending);
      const bool there = fs::exists(place.path() / (std::string("out") + ending));
      EXPECT_EQ(there, outcome.code == 0) << in << ending << outcome.err;
      if (!there) {
        EXPECT_EQ(outcome.code, 65) << in << ending << outcome.err;
        ++refused;
        continue;
      }
      const auto before = place.rend("mesh info " + in + " --json").json(),
                 after = place.rend(std::string("mesh info out") + ending + " --json").json();
      for (const char* key : {"kind", "vertices", "edges", "faces", "volumes", "euler", "elements"})
        EXPECT_EQ(before[key], after[key]) << in << ending << " " << key;
      const char* extent = before["kind"] == "solid" ? "volume" : "area";
      EXPECT_NEAR(after[extent].get<double>(), before[extent].get<double>(), 1e-12) << in << ending;
      if (std::string(ending) == ".msh") {
        EXPECT_EQ(before["groups"], after["groups"]) << in;
      }
      fs::remove(place.path() / (std::string("out") + ending));
      ++written;
    }
  // Sheets without a border as .moka: cube, inward, plane; faces and volumes that Gmsh has not: pentagon, drum.
  EXPECT_EQ(refused, 5);
  EXPECT_EQ(written, 23);
  EXPECT_THAT(place.rend("mesh convert cube.obj out.moka").err,
              HasSubstr("cube.obj: a sheet without a border would be a solid in .moka"));
}

TEST(MeshCommand, refuses_by_the_table_of_exit_codes) {
  const TestFolder place;
  place.write("bad.msh", "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n1\n1 0 x 0\n");
  EXPECT_EQ(place.rend("mesh").code, 64);
  EXPECT_EQ(place.rend("mesh info none.msh").code, 66);
  const Outcome bad = place.rend("mesh info bad.msh");
  EXPECT_EQ(bad.code, 65);
  EXPECT_THAT(bad.err, HasSubstr("bad.msh:6:5: the coordinate of a node is expected, and 'x' is not one"));
  EXPECT_EQ(place.rend("mesh convert " + organ.string() + " a.stl").code, 64);
  EXPECT_EQ(place.rend("mesh convert " + organ.string() + " none/a.moka").code, 73);
  EXPECT_EQ(place.files(), std::vector<std::string>{"bad.msh"});
}

TEST(MeshCommand, tells_how_good_the_elements_are) {
  const TestFolder place;
  place.write("t.msh", tetrahedron);
  const auto quality = place.rend("mesh info t.msh --json").json()["quality"];
  // three right angles at the corner, and arctan √2 at the sides of the slope
  EXPECT_NEAR(quality["least_angle"]["degrees"].get<double>(), 54.735610317245, 1e-9);
  EXPECT_NEAR(quality["greatest_angle"]["degrees"].get<double>(), 90, 1e-9);
  EXPECT_EQ(quality["aspect"]["kind"], "tetrahedron");
  EXPECT_EQ(quality["smallest"]["of_mean"], 1);
  EXPECT_EQ(quality["smallest"]["element"], 0);
  EXPECT_EQ(quality["largest"]["centre"], nlohmann::json({0.25, 0.25, 0.25}));
  EXPECT_THAT(place.rend("mesh info t.msh").out,
              HasSubstr("smallest dihedral angle 54.74 degrees: tetrahedron 0 near (0.25, 0.25, 0.25)"));
}

// An octahedron of side √2, whose volume is 4/3.
constexpr const char* octahedron = "v 1 0 0\nv -1 0 0\nv 0 1 0\nv 0 -1 0\nv 0 0 1\nv 0 0 -1\n"
                                   "f 1 3 5\nf 3 2 5\nf 2 4 5\nf 4 1 5\nf 3 1 6\nf 2 3 6\nf 4 2 6\nf 1 4 6\n";

bool gmsh_is_there() {
  return std::system("command -v gmsh >/dev/null") == 0;
}

// A folder for work that a program may leave something in.
std::string own_tmp(const TestFolder& place) {
  fs::create_directories(place.path() / "tmp");
  return "TMPDIR='" + (place.path() / "tmp").string() + "' ";
}

TEST(MeshFill, a_closed_surface_is_told_to_be_hollow) {
  const TestFolder place;
  place.write("o.obj", octahedron);
  const auto notes = place.rend("mesh info o.obj --json").json()["notes"];
  ASSERT_EQ(notes.size(), 1u);
  EXPECT_THAT(notes[0].get<std::string>(), HasSubstr("hollow sheet; `rend mesh fill`"));
  EXPECT_TRUE(place
                  .rend("mesh info " +
                        (fs::path(test::source_root) / "presets/tear/meshes/notched-strip.obj").string() +
                        " --json")
                  .json()["notes"]
                  .empty());
}

TEST(MeshFill, makes_a_solid_with_the_surface_as_its_boundary) {
  if (!gmsh_is_there()) GTEST_SKIP() << "gmsh is not installed";
  const TestFolder place;
  place.write("o.obj", octahedron);
  const std::string tmp = own_tmp(place),
                    fill = tmp + std::string(test::rend_program) + " mesh fill o.obj --size 0.4 -o ";
  const Outcome outcome = place.shell(fill + "a.msh");
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  const auto facts = place.rend("mesh info a.msh --json").json();
  EXPECT_EQ(facts["kind"], "solid");
  EXPECT_NEAR(facts["volume"].get<double>(), 4.0 / 3, 1e-9);
  EXPECT_EQ(facts["elements"]["tetrahedra"], facts["volumes"]);
  EXPECT_EQ(facts["euler"], 1);
  EXPECT_GT(facts["volumes"].get<int>(), 4.0 / 3 / 0.4 / 0.4 / 0.4 * 6) << "a cube of that side has about 6";
  EXPECT_GT(facts["quality"]["least_angle"]["degrees"].get<double>(), 5);
  ASSERT_EQ(place.shell(fill + "b.msh").code, 0);
  EXPECT_EQ(program::content(place.path() / "a.msh"), program::content(place.path() / "b.msh"));
  EXPECT_TRUE(fs::is_empty(place.path() / "tmp"));
  place.write("s.xml", preset("a.msh", "<elasticity young=\"1e4\"/>"));
  EXPECT_EQ(place.rend("run s.xml --json").code, 0);
}

TEST(MeshFill, refuses_what_is_no_closed_surface) {
  const TestFolder place;
  place.write("open.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  place.write("t.msh", tetrahedron);
  place.write("o.obj", octahedron);
  const Outcome open = place.rend("mesh fill open.obj --size 1 -o a.msh");
  EXPECT_EQ(open.code, 65);
  EXPECT_THAT(open.err, HasSubstr("open.obj:4:1: the surface is not closed"));
  EXPECT_EQ(place.rend("mesh fill t.msh --size 1 -o a.msh").code, 65);
  EXPECT_EQ(place.rend("mesh fill none.obj --size 1 -o a.msh").code, 66);
  for (const char* arguments : {"o.obj -o a.msh", "o.obj --size 0 -o a.msh", "o.obj --size nan -o a.msh",
                                "o.obj --size 1", "o.obj --size 1 -o a.stl", "o.obj --size 1 -o o.obj"})
    EXPECT_EQ(place.rend("mesh fill " + std::string(arguments)).code, 64) << arguments;
  EXPECT_FALSE(fs::exists(place.path() / "a.msh"));
}

// Before anything is divided, or gmsh is started.
TEST(MeshFill, refuses_at_once_what_has_too_many_cells) {
  const TestFolder place;
  place.write("o.obj", octahedron);
  fs::create_directories(place.path() / "empty");
  for (const auto& [size, words] : {std::pair{"1e-9", "8e+27 tetrahedra of this size; at most 1e+07"},
                                    std::pair{"0.009", "1.1e+07 tetrahedra"}}) {
    const Outcome outcome = place.shell("PATH='" + (place.path() / "empty").string() + "' /usr/bin/timeout 5 " +
                                        test::rend_program + " mesh fill o.obj -o a.msh --size " + size);
    EXPECT_EQ(outcome.code, 64) << outcome.err;
    EXPECT_THAT(outcome.err, HasSubstr(words));
    EXPECT_THAT(outcome.err, HasSubstr("take a larger --size, of 0.0093 m or more"));
  }
  // A flat one has few cells, and a large surface.
  place.write("flat.obj", "v 0 0 0\nv 1e4 0 0\nv 0 1e4 0\nv 0 0 1e-3\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 3 1 4\n");
  const Outcome flat =
      place.shell("timeout 5 " + std::string(test::rend_program) + " mesh fill flat.obj -o a.msh --size 0.5");
  EXPECT_EQ(flat.code, 64);
  EXPECT_THAT(flat.err, HasSubstr("more than ten million triangles"));
}

// In place of gmsh a script that does the named thing.
TEST(MeshFill, survives_whatever_gmsh_does) {
  const TestFolder place;
  place.write("o.obj", octahedron);
  const std::string tmp = own_tmp(place);
  fs::create_directories(place.path() / "bin");
  const auto with = [&](const std::string& script, const std::string& more = "") {
    place.write("bin/gmsh", "#!/bin/sh\n" + script);
    fs::permissions(place.path() / "bin/gmsh", fs::perms::owner_all);
    const Outcome outcome = place.shell(tmp + "PATH='" + (place.path() / "bin").string() + "':$PATH " +
                                        test::rend_program + " mesh fill o.obj --size 3 -o a.msh " + more);
    EXPECT_TRUE(fs::is_empty(place.path() / "tmp")) << script << ": something is left";
    EXPECT_FALSE(fs::exists(place.path() / "a.msh")) << script;
    return outcome;
  };
  const auto expect = [&](int code, const std::string& says, const Outcome& outcome) {
    EXPECT_EQ(outcome.code, code) << outcome.err;
    EXPECT_THAT(outcome.err, HasSubstr(says));
  };
  expect(74, "exit code 3. Error   : No way out", with("echo Info; echo 'Error   : No way out' >&2; exit 3"));
  expect(74, "gmsh could not fill the surface", with("echo nothing is written"));
  expect(74, "cannot be read", with("echo rubbish >solid.msh"));
  expect(74, "exit code 139", with("kill -SEGV $$"));
  expect(74, "No way out", with("yes | head -c 30000000; echo 'Error   : No way out' >&2; exit 3"));
  expect(75, "filling the surface took longer than 0.3 s", with("yes", "--max-time 0.3"));
  expect(75, "took longer than 0.3 s", with("touch t; sleep 60 & sleep 60", "--max-time 0.3"));
  const std::string start = "cat >solid.msh <<END\n$MeshFormat\n2.2 0 8\n$EndMeshFormat\n",
                    nodes = "$Nodes\n6\n1 1 0 0\n2 -1 0 0\n3 0 1 0\n4 0 -1 0\n5 0 0 1\n6 0 0 -1\n$EndNodes\n",
                    half = "$Elements\n2\n1 4 2 1 1 1 3 4 5\n2 4 2 1 1 2 4 3 5\n$EndElements\nEND\n";
  const auto quoted = [](std::string text) {
    for (std::size_t at = 0; (at = text.find('$', at)) != std::string::npos; at += 2) text.insert(at, "\\");
    return text;
  };
  expect(74, "its boundary differs from the surface in", with(quoted(start + nodes + half)));
  std::string inverted = half;
  inverted.replace(inverted.find("1 3 4 5"), 7, "3 1 4 5");
  expect(74, "has the volume -", with(quoted(start + nodes + inverted)));
  std::string moved = nodes;
  moved.replace(moved.find("5 0 0 1"), 7, "5 0 0 1.01");
  expect(74, "its boundary differs from the surface in",
         with(quoted(start + moved +
                     "$Elements\n4\n1 4 2 1 1 1 3 6 5\n2 4 2 1 1 3 2 6 5\n3 4 2 1 1 2 4 6 5\n"
                     "4 4 2 1 1 4 1 6 5\n$EndElements\nEND\n")));
  // What fills it is taken: four tetrahedra around the axis.
  place.write("bin/gmsh", "#!/bin/sh\n" + quoted(start + nodes +
                                                 "$Elements\n4\n1 4 2 1 1 1 3 6 5\n2 4 2 1 1 3 2 6 5\n"
                                                 "3 4 2 1 1 2 4 6 5\n4 4 2 1 1 4 1 6 5\n$EndElements\nEND\n"));
  const Outcome good = place.shell(tmp + "PATH='" + (place.path() / "bin").string() + "':$PATH " +
                                   test::rend_program + " mesh fill o.obj --size 3 -o a.msh");
  EXPECT_EQ(good.code, 0) << good.err;
  // At the axis 90 degrees, at the octahedron's edges acos(-1/3), at the others acos(1/√3).
  EXPECT_THAT(good.err, HasSubstr("no slivers: dihedral angles from 54.7 to 109 degrees"));
  EXPECT_EQ(place.rend("mesh info a.msh --json").json()["volumes"], 4);
}

// A program that is killed can remove nothing: what it has started ends, and the next one removes its folder.
TEST(MeshFill, that_is_killed_leaves_neither_gmsh_nor_for_long_a_folder) {
  const TestFolder place;
  place.write("o.obj", octahedron);
  fs::create_directories(place.path() / "bin");
  const std::string here = place.path().string(), start = own_tmp(place) + "PATH='" + here + "/bin':$PATH " +
                                                          test::rend_program +
                                                          " mesh fill o.obj --size 3 -o a.msh";
  const auto gmsh = [&](const std::string& script) {
    place.write("bin/gmsh", "#!/bin/sh\n" + script);
    fs::permissions(place.path() / "bin/gmsh", fs::perms::owner_all);
  };
  for (const char* signal : {"KILL", "QUIT", "ABRT"}) {
    gmsh("echo $$ >'" + here + "/pid'; kill -" + signal + " $PPID; exec sleep 60");
    EXPECT_GT(place.shell("ulimit -c 0; " + start).code, 128) << signal;
    const Outcome left =
        place.shell("n=0; while grep -q '^State:.[^ZX]' /proc/$(cat pid)/status 2>/dev/null; do "
                    "n=$((n+1)); [ $n -lt 100 ] || exit 1; sleep 0.05; done");
    EXPECT_EQ(left.code, 0) << "gmsh is still there after " << signal;
    EXPECT_FALSE(fs::is_empty(place.path() / "tmp")) << signal;
    gmsh("exit 3");
    EXPECT_EQ(place.shell(start).code, 74);
    EXPECT_TRUE(fs::is_empty(place.path() / "tmp")) << signal;
  }
}

// Two runs at once: neither takes the other's folder for abandoned.
TEST(MeshFill, leaves_the_folder_of_another_run_alone) {
  const TestFolder place;
  place.write("o.obj", octahedron);
  fs::create_directories(place.path() / "bin");
  const std::string here = place.path().string(), start = own_tmp(place) + "PATH='" + here + "/bin':$PATH " +
                                                          test::rend_program +
                                                          " mesh fill o.obj --size 3 -o a.msh";
  place.write("bin/gmsh", "#!/bin/sh\ntouch '" + here + "/runs'\nwhile [ ! -e '" + here +
                              "/go' ]; do sleep 0.05; done\n[ -e surface.msh ] && touch '" + here +
                              "/kept'\nexit 3\n");
  fs::permissions(place.path() / "bin/gmsh", fs::perms::owner_all);
  place.shell(start + " & while [ ! -e runs ]; do sleep 0.05; done; PATH=/nowhere " +
              std::string(test::rend_program) + " mesh fill o.obj --size 3 -o b.msh; touch go; wait");
  EXPECT_TRUE(fs::exists(place.path() / "kept"));
  EXPECT_TRUE(fs::is_empty(place.path() / "tmp"));
}

TEST(MeshFill, needs_a_folder_for_temporary_files) {
  const TestFolder place;
  place.write("o.obj", octahedron);
  for (const char* folder : {"nowhere", "o.obj"}) {
    const Outcome outcome = place.shell(std::string("TMPDIR=") + folder + " " + test::rend_program +
                                        " mesh fill o.obj --size 3 -o a.msh");
    EXPECT_EQ(outcome.code, 73) << outcome.err;
    EXPECT_THAT(outcome.err, HasSubstr(std::string("TMPDIR is '") + folder + "', which is no folder"));
  }
}

// A cube with a pit in its upper side that reaches through the lower one.
TEST(MeshFill, a_surface_that_crosses_itself_is_bad_input) {
  if (!gmsh_is_there()) GTEST_SKIP() << "gmsh is not installed";
  const TestFolder place;
  place.write("pit.obj",
              "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0 0 1\nv 1 0 1\nv 1 1 1\nv 0 1 1\nv 0.4 0.4 -0.2\n"
              "f 1 4 3 2\nf 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8\nf 5 6 9\nf 6 7 9\nf 7 8 9\nf 8 5 9\n");
  const Outcome outcome = place.rend("mesh fill pit.obj --size 0.5 -o a.msh");
  EXPECT_EQ(outcome.code, 65) << outcome.err;
  EXPECT_THAT(outcome.err, HasSubstr("pit.obj: the surface crosses or touches itself near ("));
}

// Also while rend itself reads, orders and divides.
TEST(MeshFill, holds_its_time_with_all_that_it_does) {
  const TestFolder place;
  constexpr int n = 1500; // a tube of n rings of 200 quads, closed by two polygons
  std::string text;
  for (int z = 0; z <= n; ++z)
    for (int k = 0; k < 200; ++k)
      text += fmt::format("v {} {} {}\n", std::cos(k * pi / 100), std::sin(k * pi / 100), z * 0.01);
  for (int z = 0; z < n; ++z)
    for (int k = 0; k < 200; ++k)
      text += fmt::format("f {0} {1} {3} {2}\n", 200 * z + k + 1, 200 * z + (k + 1) % 200 + 1,
                          200 * z + k + 201, 200 * z + (k + 1) % 200 + 201);
  for (const int first : {1, 200 * n + 1}) {
    text += "f";
    for (int k = 0; k < 200; ++k) text += fmt::format(" {}", first + k);
    text += "\n";
  }
  place.write("tube.obj", text);
  const std::string tmp = own_tmp(place);
  const double start = wall_clock();
  const Outcome outcome =
      place.shell(tmp + test::rend_program + " mesh fill tube.obj --size 0.1 -o a.msh --max-time 0.5");
  EXPECT_EQ(outcome.code, 75) << outcome.err;
  EXPECT_LT(wall_clock() - start, 3);
  EXPECT_THAT(outcome.err, HasSubstr("filling the surface took longer than 0.5 s"));
  EXPECT_TRUE(fs::is_empty(place.path() / "tmp"));
}

TEST(MeshFill, tells_the_package_where_gmsh_is_not_installed) {
  const TestFolder place;
  place.write("o.obj", octahedron);
  fs::create_directories(place.path() / "empty");
  const Outcome outcome = place.shell("PATH='" + (place.path() / "empty").string() + "' " + test::rend_program +
                                      " mesh fill o.obj --size 1 -o a.msh");
  EXPECT_EQ(outcome.code, 64);
  EXPECT_THAT(outcome.err, HasSubstr("apt-get install gmsh"));
}

TEST(MeshOfAPreset, lies_in_its_folder_or_below) {
  const TestFolder place;
  fs::create_directories(place.path() / "scenes/meshes");
  fs::create_directories(place.path() / "elsewhere");
  place.write("scenes/meshes/t.msh", tetrahedron);
  place.write("elsewhere/t.msh", tetrahedron);
  fs::create_symlink("../elsewhere", place.path() / "scenes/link");
  const auto run = [&](const std::string& file, const std::string& options = "") {
    place.write("scenes/s.xml", preset(file));
    return place.rend("run scenes/s.xml --json " + options);
  };
  const Outcome inside = run("meshes/t.msh");
  ASSERT_EQ(inside.code, 0) << inside.err;
  EXPECT_NEAR(inside.json()["mass"].get<double>(), 2, 1e-12);
  for (const std::string& file : {std::string("../elsewhere/t.msh"), std::string("link/t.msh"),
                                  (place.path() / "scenes/meshes/t.msh").string()}) {
    const Outcome outside = run(file);
    EXPECT_EQ(outside.code, 65);
    EXPECT_THAT(outside.err, HasSubstr("outside of the preset's folder"));
    EXPECT_EQ(run(file, "--allow-path").code, 0);
    for (const char* command : {"check scenes/s.xml -q --only threads", "study --lean scenes/s.xml -q --quick",
                                "study scenes/s.xml -q", "info scenes/s.xml"}) {
      const Outcome other = place.rend(command);
      EXPECT_EQ(other.code, 65) << command;
      EXPECT_THAT(other.err, HasSubstr("outside of the preset's folder")) << command;
    }
    EXPECT_EQ(place.rend("check scenes/s.xml -q --only threads --allow-path").code, 0);
  }
  fs::create_symlink("circle", place.path() / "scenes/circle");
  EXPECT_EQ(run("circle/t.msh").code, 65);
}

TEST(MeshOfAPreset, has_groups_that_select) {
  const TestFolder place;
  place.write("t.msh", tetrahedron);
  place.write("s.xml", preset("t.msh", "<fix group=\"top\"/>"));
  const Outcome outcome = place.rend("run s.xml --json");
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_NEAR(outcome.json()["momentum"][2].get<double>(), -1.5 * 10 * 0.01, 1e-12); // three of four fall
  place.write("s.xml", preset("t.msh", "<fix group=\"tops\"/>"));
  EXPECT_THAT(place.rend("run s.xml").err, HasSubstr("did you mean 'top'?"));
}

TEST(MeshOfAPreset, of_hexagons_is_told_where_it_does_not_bend) {
  const TestFolder place;
  const std::string bend = R"(<springs><stretch k="1"/><bend kind="angular" k="1"/></springs>)";
  place.write("two.off", "OFF\n9 2 0\n0 0 0\n1 0 0\n2 0 0\n0 1 0\n1 1 0\n2 1 0\n0 2 0\n1 2 0\n2 2 0\n"
                         "6 0 1 2 5 4 3\n6 3 4 5 8 7 6\n");
  place.write("mixed.off", "OFF\n9 3 0\n0 0 0\n1 0 0\n2 0 0\n0 1 0\n1 1 0\n2 1 0\n0 2 0\n1 2 0\n2 2 0\n"
                           "6 0 1 2 5 4 3\n4 3 4 7 6\n4 4 5 8 7\n");
  for (const auto& [file, words] : {std::pair{"two.off", R"(bend kind="angular" was left out: at every edge)"},
                                    std::pair{"mixed.off", "has no effect on 2 of the 3 edges"}}) {
    place.write("s.xml", preset(file, bend));
    const Outcome ran = place.rend("run s.xml");
    ASSERT_EQ(ran.code, 0) << ran.err;
    EXPECT_THAT(ran.err, HasSubstr(words));
    const auto left_out = place.rend("info s.xml --json").json()["bodies"][0]["left_out"];
    EXPECT_THAT(left_out, testing::Contains(HasSubstr(words)));
  }
}

} // namespace
} // namespace rend::mesh_command_test
