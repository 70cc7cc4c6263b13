// rend mesh, and <mesh> in a preset, as a user runs them.
#include "tests/render/commands/program_run.h"

#include <gmock/gmock.h>

namespace rend {
namespace {

using program::Outcome;
using program::TestFolder;
using testing::HasSubstr;
namespace fs = std::filesystem;

const fs::path organ = fs::path(REND_ROOT) / "presets/meshes/organ-600.msh";

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
} // namespace rend
