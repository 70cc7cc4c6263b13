// `rend run --export ply` and `obj`, read back by an independent reader and by tinyobjloader: the same points
// and faces, and the same data as in the .vtu files of the same run.
#include "sim/base/record.h"
#include "tests/render/commands/program_run.h"
#include "tests/test_paths.h"

#include <gmock/gmock.h>
#define TINYOBJLOADER_USE_DOUBLE // as the library is built
#include <tiny_obj_loader.h>

#include <set>
#include <sstream>

namespace rend::surface_export_test {
namespace {

using program::content;
using program::Outcome;
using program::TestFolder;
using testing::ElementsAre;
using testing::HasSubstr;
using Json = nlohmann::json;

const char* named_bar = R"(<scene name="bar"><body name="a bar">
  <bar pattern="mixed" cells="4 2 2" size="0.8 0.2 0.1"/><mass density="1000"/>
  <elasticity young="1e5" poisson="0.3"/><fix side="-x"/><load side="+x" force="0 0 -1"/>
  <probe name="tip" near="0.8 0.2 0.1"/></body>
  <time step="auto" integrator="symplectic" duration="0.2"/><image fps="10"/></scene>)";

class SurfaceExport : public testing::Test {
protected:
  Json run(const std::string& preset, const std::string& options) const {
    place.write("scene.xml", preset);
    const Outcome outcome = place.rend("run scene.xml --quiet --json " + options);
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    return outcome.json();
  }
  Json read(const std::string& reader, const std::string& name) const {
    const Outcome outcome = place.shell("/usr/bin/python3 " + std::string(test::source_root) +
                                        "/tests/render/clip/" + reader + " " + name);
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    return outcome.json();
  }
  Json ply(const std::string& name) const { return read("ply_to_json.py", name); }
  tinyobj::ObjReader obj(const std::string& name) const {
    tinyobj::ObjReader reader;
    tinyobj::ObjReaderConfig config;
    config.triangulate = false;
    EXPECT_TRUE(reader.ParseFromFile((place.path() / name).string(), config)) << reader.Error();
    EXPECT_EQ(reader.Warning(), "");
    return reader;
  }
  const TestFolder place;
};

// The faces of all shapes, as lists of points.
std::vector<std::vector<int>> faces_of(const tinyobj::ObjReader& reader) {
  std::vector<std::vector<int>> all;
  for (const tinyobj::shape_t& shape : reader.GetShapes()) {
    auto at = shape.mesh.indices.begin();
    for (const auto sides : shape.mesh.num_face_vertices) {
      all.emplace_back();
      for (std::size_t n = 0; n < sides; ++n) all.back().push_back((at++)->vertex_index);
    }
  }
  return all;
}

// The points of the lines that begin with v, read by strtod, which rounds correctly; tinyobjloader's parser
// does not.
std::vector<double> points_as_written(const std::string& obj) {
  std::vector<double> all;
  std::istringstream text(obj);
  for (std::string line; std::getline(text, line);) {
    if (!line.starts_with("v ")) continue;
    char* at = line.data() + 1;
    for (int axis = 0; axis < 3; ++axis) all.push_back(std::strtod(at, &at));
    EXPECT_EQ(*at, '\0') << line;
  }
  return all;
}

std::vector<double> points_of(const Json& ply) {
  std::vector<double> all;
  for (std::size_t p = 0; p < ply["vertex"]["x"].size(); ++p)
    for (const char* axis : {"x", "y", "z"}) all.push_back(ply["vertex"][axis][p]);
  return all;
}

TEST_F(SurfaceExport, as_ply_tells_of_its_points_and_faces_what_vtu_tells_of_vertices_and_cells) {
  run(named_bar, "--export vtu -o states");
  run(named_bar, "--export ply -o states");
  const Json ply = this->ply("states/00002.ply"), vtu = read("vtu_to_json.py", "states/00002.vtu");
  EXPECT_THAT(ply["comments"], ElementsAre("time 0.2 s, lengths in m, z is up", "body 0 is a_bar"));
  std::map<int, std::size_t> row_of; // of the .vtu file
  for (std::size_t p = 0; p < vtu["points"].size(); ++p) row_of[vtu["point_data"]["vertex"][p]] = p;
  const Json& vertex = ply["vertex"];
  EXPECT_LT(vertex["x"].size(), vtu["points"].size()); // inner points are missing
  for (std::size_t p = 0; p < vertex["x"].size(); ++p) {
    const std::size_t row = row_of.at(vertex["vertex"][p]);
    EXPECT_EQ(Json::array({vertex["x"][p], vertex["y"][p], vertex["z"][p]}), vtu["points"][row]);
    EXPECT_EQ(Json::array({vertex["vx"][p], vertex["vy"][p], vertex["vz"][p]}),
              vtu["point_data"]["velocity"][row]);
    EXPECT_EQ(vertex["body"][p], 0);
  }
  std::map<int, double> stress_of;
  for (std::size_t c = 0; c < vtu["cells"].size(); ++c)
    stress_of[vtu["cell_data"]["element"][c]] = vtu["cell_data"]["von Mises stress"][c];
  const Json& face = ply["face"];
  for (std::size_t f = 0; f < face["element"].size(); ++f)
    EXPECT_EQ(face["von_mises"][f].get<double>(), stress_of.at(face["element"][f]));
}

TEST_F(SurfaceExport, as_obj_is_that_of_ply_to_the_last_bit) {
  const Json figures = run(named_bar, "--export ply -o states");
  EXPECT_EQ(run(named_bar, "--export obj -o states")["hash"], figures["hash"]);
  for (const char* frame : {"states/00000", "states/00002"}) {
    const Json ply = this->ply(frame + std::string(".ply"));
    const tinyobj::ObjReader obj = this->obj(frame + std::string(".obj"));
    EXPECT_EQ(points_as_written(content(place.path() / (frame + std::string(".obj")))), points_of(ply));
    EXPECT_THAT(obj.GetAttrib().vertices, testing::Pointwise(testing::DoubleNear(1e-14), points_of(ply)));
    EXPECT_EQ(faces_of(obj), ply["face"]["vertex_indices"].get<std::vector<std::vector<int>>>());
    ASSERT_EQ(obj.GetShapes().size(), 1u);
    EXPECT_EQ(obj.GetShapes()[0].name, "a_bar");
  }
}

TEST_F(SurfaceExport, keeps_its_form_whatever_a_body_is_called) {
  std::string named = named_bar;
  named.replace(named.find("a bar"), 5, "c&#10;end_header&#10;v 1 1 1&#13;&#9;\u00e9");
  run(named, "--export ply -o states");
  run(named, "--export obj -o states");
  const Json ply = this->ply("states/00002.ply");
  EXPECT_EQ(ply["comments"][1], "body 0 is c_end_header_v_1_1_1__\u00e9");
  EXPECT_EQ(points_as_written(content(place.path() / "states/00002.obj")), points_of(ply));
  EXPECT_EQ(obj("states/00002.obj").GetShapes()[0].name, "c_end_header_v_1_1_1__\u00e9");
}

TEST_F(SurfaceExport, as_obj_has_an_object_per_body_and_a_group_per_fragment_of_one_that_tears) {
  std::string two = program::pulled;
  two.insert(two.find("  <time"), R"(<body name="ball"><bar cells="1 1 1" size="0.1 0.1 0.1"/><mass total="1"/>
    <springs><stretch k="1"/></springs></body>)");
  const Json figures = run(two, "--export obj -o states");
  run(two, "--export ply -o states");
  const int fragments = figures["fragments"];
  ASSERT_GT(fragments, 2);
  const tinyobj::ObjReader obj = this->obj("states/00006.obj");
  std::set<std::string> names, expected{"ball"};
  for (const tinyobj::shape_t& shape : obj.GetShapes()) names.insert(shape.name);
  for (int n = 0; n + 1 < fragments; ++n) expected.insert("cloth_" + std::to_string(n));
  EXPECT_EQ(names, expected);
  const Json ply = this->ply("states/00006.ply");
  EXPECT_EQ(faces_of(obj), ply["face"]["vertex_indices"].get<std::vector<std::vector<int>>>());
  EXPECT_EQ(ply["face"]["fragment"].get<std::vector<int>>().back(), fragments - 1);
  EXPECT_EQ(ply["face"]["body"].get<std::vector<int>>().back(), 1);
  EXPECT_EQ(ply["comments"][2], "body 1 is ball");
  EXPECT_THAT(content(place.path() / "states/00006.obj"), HasSubstr("\no cloth\n"));
}

TEST_F(SurfaceExport, is_numbered_as_frames_are_and_ply_has_a_list_with_times) {
  const std::string slow = "--set time.step=0.1 --fps 20 --set body.elasticity.young=1 -o states --export ";
  EXPECT_EQ(run(named_bar, slow + "obj")["export"]["files"], 5); // frames 1 and 2 show one state, as 3 and 4 do
  EXPECT_EQ(place.files(), (std::vector<std::string>{"scene.xml", "states", "states/00000.obj",
                                                     "states/00001.obj", "states/00002.obj", "states/00003.obj",
                                                     "states/00004.obj", "states/bar.scene.json"}));
  EXPECT_EQ(content(place.path() / "states/00001.obj"), content(place.path() / "states/00002.obj"));
  const Json figures = run(named_bar, slow + "ply --frames 2,4");
  EXPECT_EQ(figures["export"]["index"], "bar.ply.series");
  const Json list = Json::parse(content(place.path() / "states/bar.ply.series"));
  EXPECT_EQ(list["file-series-version"], "1.0");
  EXPECT_EQ(list["files"],
            Json::parse(R"([{"name": "00002.ply", "time": 0.1}, {"name": "00004.ply", "time": 0.2}])"));
}

const char* among_obstacles = R"(<scene name="among"><body name="bar">
  <bar cells="4 1 1" size="0.8 0.2 0.1"/><mass density="1000"/><elasticity young="1e5" poisson="0.3"/>
  <fix side="-x"/><look colour="#102030" inside="#405060"/></body>
  <world gravity="0 0 -10"><floor z="-9"/><sphere centre="0 3 0" radius="0.5" mass="1" colour="#708090"/>
  <box low="2 0 0" high="3 1 1"><key at="0.2" position="2.5 0.5 1.5" rotate="0 0 90"/></box></world>
  <time step="1e-3" integrator="verlet" duration="0.2"/>
  <camera eye="4 -4 2" target="0 0 0" fov="40" turn="90"/><image fps="10" size="640 360"/></scene>)";

TEST_F(SurfaceExport, has_spheres_and_boxes_as_further_bodies) {
  for (const char* format : {"ply", "obj", "vtu"})
    run(among_obstacles, std::string("-o states --export ") + format);
  const Json ply = this->ply("states/00002.ply"), vtu = read("vtu_to_json.py", "states/00002.vtu");
  EXPECT_THAT(ply["comments"], ElementsAre("time 0.2 s, lengths in m, z is up", "body 0 is bar",
                                           "body 1 is sphere_1", "body 2 is box_1"));
  const std::vector<int> bodies = ply["face"]["body"];
  EXPECT_EQ(std::count(bodies.begin(), bodies.end(), 0), 18); // sides of four cells
  EXPECT_EQ(std::count(bodies.begin(), bodies.end(), 2), 6);
  const std::vector<int> bodies_of_points = ply["vertex"]["body"];
  for (std::size_t p = 0; p < bodies_of_points.size(); ++p) {
    const Vec3 x(ply["vertex"]["x"][p], ply["vertex"]["y"][p], ply["vertex"]["z"][p]);
    if (bodies_of_points[p] == 1) { // it has fallen for 0.2 s, by symplectic Euler in steps of 1 ms
      EXPECT_NEAR((x - Vec3(0, 3, -0.5 * 10 * 0.2 * 0.201)).norm(), 0.5, 1e-12);
      EXPECT_NEAR(ply["vertex"]["vz"][p].get<double>(), -10 * 0.2, 1e-8);
    }
    if (bodies_of_points[p] == 2) {
      EXPECT_NEAR((x - Vec3(2.5, 0.5, 1.5)).cwiseAbs().maxCoeff(), 0.5, 1e-12);
    }
  }
  const tinyobj::ObjReader obj = this->obj("states/00002.obj");
  ASSERT_EQ(obj.GetShapes().size(), 3u);
  EXPECT_EQ(obj.GetShapes()[1].name, "sphere_1");
  EXPECT_EQ(obj.GetShapes()[2].name, "box_1");
  EXPECT_EQ(faces_of(obj), ply["face"]["vertex_indices"].get<std::vector<std::vector<int>>>());
  const std::vector<int> bodies_of_cells = vtu["cell_data"]["body"];
  for (int body : {1, 2})
    EXPECT_EQ(std::count(bodies_of_cells.begin(), bodies_of_cells.end(), body),
              std::count(bodies.begin(), bodies.end(), body));
  EXPECT_EQ(vtu["points"].back()[2].get<double>(), ply["vertex"]["z"].back().get<double>());
}

TEST_F(SurfaceExport, tells_of_camera_colours_and_obstacles_beside_its_meshes) {
  run(among_obstacles, "-o states --export ply --frames 0-2x2");
  const Json scene = Json::parse(content(place.path() / "states/among.scene.json"));
  EXPECT_EQ(scene["size"], Json({640, 360}));
  EXPECT_EQ(scene["floor"], -9);
  EXPECT_EQ(scene["bodies"][0],
            Json::parse(R"({"name": "bar", "solid": true, "colour": "#102030", "inside": "#405060"})"));
  EXPECT_EQ(scene["obstacles"][0],
            Json::parse(R"({"name": "sphere 1", "kind": "sphere", "radius": 0.5, "colour": "#708090"})"));
  EXPECT_EQ(scene["obstacles"][1]["size"], Json({1, 1, 1}));
  ASSERT_EQ(scene["frames"].size(), 2u);
  const Json &first = scene["frames"][0], &last = scene["frames"][1];
  EXPECT_EQ(last["frame"], 2);
  EXPECT_EQ(last["file"], "00002.ply");
  EXPECT_EQ(first["camera"]["eye"], Json({4, -4, 2}));
  EXPECT_EQ(last["camera"]["fov"], 40);
  for (std::size_t axis = 0; axis < 3; ++axis) { // it has walked around by a right angle
    const std::array<double, 3> eye{4, 4, 2}, middle{0, 3, -0.201};
    EXPECT_NEAR(last["camera"]["eye"][axis].get<double>(), eye[axis], 1e-12);
    EXPECT_NEAR(last["obstacles"][0]["middle"][axis].get<double>(), middle[axis], 1e-12);
  }
  EXPECT_THAT(last["obstacles"][1]["turn"].get<std::vector<double>>(),
              testing::Pointwise(testing::DoubleNear(1e-14), {0., -1., 0., 1., 0., 0., 0., 0., 1.}));
}

TEST_F(SurfaceExport, is_the_same_for_any_number_of_threads) {
  for (const char* format : {"ply", "obj"}) {
    const std::string name = std::string("00006.") + format;
    run(program::pulled, std::string("--threads 1 -o one --export ") + format);
    run(program::pulled, std::string("--threads 3 -o three --export ") + format);
    EXPECT_EQ(content(place.path() / "one" / name), content(place.path() / "three" / name));
  }
}

TEST_F(SurfaceExport, that_cannot_be_is_refused_before_anything_is_done) {
  place.write("scene.xml", named_bar);
  const Outcome unknown = place.rend("run scene.xml --export stl");
  EXPECT_EQ(unknown.code, 64);
  EXPECT_THAT(unknown.err, HasSubstr("vtu, ply, obj"));
  EXPECT_EQ(place.rend("run scene.xml --export ply -o scene.xml").code, 73);
  EXPECT_EQ(place.files(), std::vector<std::string>{"scene.xml"});
}

} // namespace
} // namespace rend::surface_export_test
