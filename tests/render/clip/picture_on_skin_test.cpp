// Texture coordinates and material libraries of exported .obj files, read back by another parser: against those
// of the mesh file, and against formulas of the presets' own numbers.
#include "render/files/png.h"
#include "tests/render/commands/program_run.h"
#include "tests/render/needs.h"
#include "tests/render/pictures.h"

#include <fmt/format.h>
#include <gmock/gmock.h>

#include <map>
#include <set>

namespace rend::picture_on_skin_test {
namespace {

using program::content;
using program::Outcome;
using program::TestFolder;
using Json = nlohmann::json;

class PictureOnSkin : public testing::Test {
protected:
  void SetUp() override {
    NEEDS_PNG;
    std::filesystem::create_directories(place.path() / "pictures");
    write_png(place.path() / "pictures" / "wide one.png", test::pattern(20, 10));
    write_png(place.path() / "pictures" / "other.png", test::pattern(30, 20));
  }
  // The states of these frames, of one second in ten frames.
  void run(const std::string& scene, const std::string& frames, const std::string& format = "obj") const {
    place.write("s.xml",
                R"(<scene name="s">)" + scene + R"(<time step="1e-3" duration="1"/><image fps="10"/></scene>)");
    const Outcome outcome =
        place.rend("run s.xml --quiet --export " + format + " -o out/states --frames " + frames);
    EXPECT_EQ(outcome.code, 0) << outcome.err;
  }
  Json read(const std::string& name, const std::string& reader = "obj_to_json.py") const {
    const Outcome outcome = place.shell("/usr/bin/python3 " + std::string(test::source_root) +
                                        "/tests/render/clip/" + reader + " " + name);
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    return outcome.json();
  }
  const TestFolder place;
};

constexpr const char* matter = R"(<mass total="0.1"/><springs><stretch k="60"/></springs>)";

// A strip of four quads, with a seam in its middle; numbers with many digits.
constexpr const char* strip =
    "v 0 0 0\nv 1 0 0\nv 2 0 0\nv 3 0 0\nv 4 0 0\n"
    "v 0 1 0\nv 1 1 0\nv 2 1 0\nv 3 1 0\nv 4 1 0\n"
    "vt 0 0.1\nvt 0.12345678901234567 0.1\nvt 0.3 0.1\nvt 0 0.9\n"
    "vt 0.12345678901234567 0.98765432109876543\nvt 0.3 0.9\n"
    "vt 1 1\nvt 0.7 1\nvt 0.41 1\nvt 1 0.33\nvt 0.7 0.333\nvt 0.41 0.3333\n"
    "f 1/1 2/2 7/5 6/4\nf 2/2 3/3 8/6 7/5\nf 3/7 4/8 9/11 8/10\nf 4/8 5/9 10/12 9/11\n";

// The places of each face, its corners in cyclic order from the least on, either way round.
std::multiset<std::vector<std::vector<double>>> places_of_faces(const Json& obj) {
  std::multiset<std::vector<std::vector<double>>> all;
  for (const Json& face : obj["faces"]) {
    auto ring = face["places"].get<std::vector<std::vector<double>>>();
    std::vector<std::vector<double>> least = ring;
    for (int way = 0; way < 2; ++way) {
      for (std::size_t n = 0; n < ring.size(); ++n) {
        std::rotate(ring.begin(), ring.begin() + 1, ring.end());
        least = std::min(least, ring);
      }
      std::reverse(ring.begin(), ring.end());
    }
    all.insert(least);
  }
  return all;
}

TEST_F(PictureOnSkin, has_the_texture_coordinates_of_the_mesh_to_the_last_bit_before_and_after_it_tears) {
  place.write("strip.obj", strip);
  const Json mesh = read("strip.obj");
  run(R"(<body name="the strip"><mesh file="strip.obj"/>)" + std::string(matter) +
          R"(<fix side="-x"/><drive side="+x" velocity="1 0 0"/>)"
          R"(<tear criterion="global-border" threshold="0.1"/>)"
          R"(<look texture="pictures/wide one.png"/></body>)",
      "0,9");
  const Json start = read("out/states/00000.obj"), torn = read("out/states/00009.obj");
  EXPECT_EQ(start["library"], "s.mtl");
  EXPECT_EQ(start["materials"],
            Json::parse(R"({"1_the_strip": {"Kd": [1, 1, 1], "map_Kd": "../../pictures/wide one.png"}})"));
  ASSERT_EQ(start["faces"].size(), 4U);
  std::map<std::vector<std::vector<double>>, std::vector<std::vector<double>>> expected; // of points
  for (const Json& face : mesh["faces"]) expected[face["points"]] = face["places"];
  for (const Json& face : start["faces"]) {
    ASSERT_TRUE(expected.contains(face["points"])) << face;
    EXPECT_EQ(face["places"].get<std::vector<std::vector<double>>>(), expected[face["points"]]);
    EXPECT_EQ(face["material"], "1_the_strip");
  }
  std::set<std::vector<double>> points;
  for (const Json& face : torn["faces"])
    for (const Json& point : face["points"]) points.insert(point.get<std::vector<double>>());
  EXPECT_GT(points.size(), 10U) << "it is torn";
  EXPECT_EQ(places_of_faces(torn), places_of_faces(mesh));
}

TEST_F(PictureOnSkin, has_the_places_that_pictures_show_where_the_mesh_has_none) {
  const std::string flag = R"(<body name="flag"><sheet pattern="triangles" cells="3 2" size="2 1"/>)" +
                           std::string(matter) +
                           R"(<look texture="pictures/wide one.png" scale="2 0.5"/></body>)";
  const std::string bar = R"(<body name="bar"><bar cells="2 2 2" size="2 1 0.5"/><place translate="5 6 7"/>)" +
                          std::string(matter) +
                          R"(<look texture="pictures/wide one.png" colour="#ff0000"/></body>)";
  const std::string plain = R"(<body name="plain"><sheet cells="1 1" size="1 1"/><place translate="0 9 0"/>)" +
                            std::string(matter) + R"(<look colour="#336699"/></body>)";
  run(flag + bar + plain +
          R"(<world gravity="0 0 0"><sphere centre="0 0 9" radius="1" colour="#ffffff"/></world>)",
      "0");
  const Json obj = read("out/states/00000.obj");
  EXPECT_EQ(obj["materials"].size(), 5U);
  EXPECT_EQ(obj["materials"]["3_plain"], Json::parse(R"({"Kd": [0.2, 0.4, 0.6]})"));
  std::map<std::string, int> faces;
  for (const Json& face : obj["faces"]) {
    const std::string name = face["object"];
    ++faces[name];
    EXPECT_EQ(obj["materials"].count(face["material"]), 1U);
    EXPECT_EQ(face["places"].is_null(), name != "flag" && name != "bar");
    if (face["places"].is_null()) continue;
    const auto points = face["points"].get<std::vector<std::vector<double>>>();
    const auto places = face["places"].get<std::vector<std::vector<double>>>();
    const auto flat = [&](std::size_t axis) {
      return std::ranges::all_of(points, [&](const auto& x) { return x[axis] == points[0][axis]; });
    };
    for (std::size_t k = 0; k < points.size(); ++k) {
      const double x = points[k][0], y = points[k][1], z = points[k][2];
      std::array<double, 2> at{0.5 + (x / 2 - 0.5) / 2, 0.5 + (y - 0.5) / 0.5};
      if (name == "bar") { // 2 m wide and 1 m high, upright for who looks from outside
        if (flat(0)) at = {0.5 + (x > 6 ? 1 : -1) * (y - 6.5) / 2, 0.5 + (z - 7.25)};
        if (flat(1)) at = {0.5 + (y > 6.5 ? -1 : 1) * (x - 6) / 2, 0.5 + (z - 7.25)};
        if (flat(2)) at = {0.5 + (z > 7.25 ? 1 : -1) * (x - 6) / 2, 0.5 + (y - 6.5)};
      }
      EXPECT_NEAR(places[k][0], at[0], 1e-12) << face;
      EXPECT_NEAR(places[k][1], at[1], 1e-12) << face;
    }
  }
  EXPECT_EQ(faces["flag"], 12);
  EXPECT_EQ(faces["bar"], 24);
  EXPECT_EQ(faces["plain"], 1);
}

TEST_F(PictureOnSkin, of_what_breaks_open_is_another) {
  run(R"(<body name="bar"><bar cells="6 1 1" size="3 0.5 0.5"/><mass total="1"/>)"
      R"(<springs><stretch k="100"/><shear kind="isotropic" where="volume" k="50"/></springs>)"
      R"(<fix side="-x"/><drive side="+x" velocity="2 0 0"/>)"
      R"(<tear criterion="atomic-border" threshold="10" change="separate" max-per-step="1"/>)"
      R"(<look colour="#00ff00" texture-inside="pictures/other.png"/></body><world gravity="0 0 0"/>)",
      "0,9");
  EXPECT_EQ(read("out/states/00000.obj")["materials"], Json::parse(R"({"1_bar": {"Kd": [0, 1, 0]},
    "1_bar_inside": {"Kd": [1, 1, 1], "map_Kd": "../../pictures/other.png"}})"));
  int outside = 0, inside = 0;
  const Json torn = read("out/states/00009.obj");
  for (const Json& face : torn["faces"]) {
    const bool open = face["material"] == "1_bar_inside";
    ++(open ? inside : outside);
    ASSERT_EQ(face["places"].is_null(), !open);
    if (!open) continue;
    for (const Json& at : face["places"]) { // corners of 0.5 m in a picture of 3 m x 2 m
      EXPECT_NEAR(std::abs(at[0].get<double>() - 0.5), 0.25 / 3, 1e-12);
      EXPECT_NEAR(std::abs(at[1].get<double>() - 0.5), 0.25 / 2, 1e-12);
    }
  }
  EXPECT_EQ(outside, 26);
  EXPECT_GE(inside, 2);
}

// Points on the seam are two, and a sphere beside the strip has the middle of the picture.
TEST_F(PictureOnSkin, is_on_points_of_ply_which_are_split_at_seams) {
  place.write("strip.obj", strip);
  run(R"(<body><mesh file="strip.obj"/>)" + std::string(matter) +
          R"(<look texture="pictures/wide one.png"/></body>)"
          R"(<world><sphere centre="0 0 9" radius="1"/></world>)",
      "0", "ply");
  const Json mesh = read("strip.obj"), ply = read("out/states/00000.ply", "ply_to_json.py");
  const Json& points = ply["vertex"];
  std::map<std::vector<double>, int> vertices; // of the strip: position → points there
  const auto place_of = [&](std::size_t p) {
    return std::vector<double>{points["s"][p].get<double>(), points["t"][p].get<double>()};
  };
  const auto position_of = [&](std::size_t p) {
    return std::vector<double>{points["x"][p], points["y"][p], points["z"][p]};
  };
  for (std::size_t p = 0; p < points["x"].size(); ++p)
    if (points["body"][p] == 0)
      ++vertices[position_of(p)];
    else
      EXPECT_EQ(place_of(p), (std::vector<double>{0.5, 0.5}));
  EXPECT_EQ(vertices.size(), 10U);
  for (const auto& [x, count] : vertices) EXPECT_EQ(count, x[0] == 2 ? 2 : 1);
  for (std::size_t face = 0; face < 4; ++face)
    for (std::size_t k = 0; k < 4; ++k) {
      const auto p = ply["face"]["vertex_indices"][face][k].get<std::size_t>();
      EXPECT_EQ(position_of(p), mesh["faces"][face]["points"][k].get<std::vector<double>>());
      EXPECT_EQ(place_of(p), mesh["faces"][face]["places"][k].get<std::vector<double>>());
    }
}

// The cells of one body, as faces of an .obj file have them.
Json faces_of_body(const Json& vtu, int body) {
  Json faces = Json::array();
  for (std::size_t c = 0; c < vtu["cells"].size(); ++c) {
    if (vtu["cell_data"]["body"][c] != body) continue;
    Json face{{"points", Json::array()}, {"places", Json::array()}};
    for (const Json& corner : vtu["cells"][c][1]) {
      const auto p = corner.get<std::size_t>();
      face["points"].push_back(vtu["points"][p]);
      face["places"].push_back(vtu["point_data"]["TextureCoordinates"][p]);
    }
    faces.push_back(face);
  }
  return faces;
}

// Of each face, the place of each of its points.
std::multiset<std::map<std::vector<double>, std::vector<double>>> places_by_points(const Json& faces) {
  std::multiset<std::map<std::vector<double>, std::vector<double>>> all;
  for (const Json& face : faces) {
    const auto points = face["points"].get<std::vector<std::vector<double>>>();
    const auto places = face["places"].get<std::vector<std::vector<double>>>();
    std::map<std::vector<double>, std::vector<double>> by_points;
    for (std::size_t k = 0; k < points.size(); ++k) by_points[points[k]] = places[k];
    all.insert(by_points);
  }
  return all;
}

// The volumes of a bar with the same picture have none.
TEST_F(PictureOnSkin, is_on_points_of_vtu_in_sheets_which_are_split_at_seams_before_and_after_they_tear) {
  place.write("strip.obj", strip);
  const std::string look = R"(<look texture="pictures/wide one.png"/></body>)";
  const std::string bodies = R"(<body name="bar"><bar cells="2 1 1" size="2 1 1"/><place translate="0 9 0"/>)" +
                             std::string(matter) + look + R"(<body name="strip"><mesh file="strip.obj"/>)" +
                             std::string(matter) +
                             R"(<fix side="-x"/><drive side="+x" velocity="1 0 0"/>)"
                             R"(<tear criterion="global-border" threshold="0.1"/>)" +
                             look + R"(<world gravity="0 0 0"><sphere centre="0 0 9" radius="1"/></world>)";
  run(bodies, "0,9", "vtu");
  const std::string text = content(place.path() / "out/states/00000.vtu");
  EXPECT_THAT(text, testing::HasSubstr(R"(<PointData TCoords="TextureCoordinates">)"));
  const Json mesh = read("strip.obj");
  const Json start = read("out/states/00000.vtu", "vtu_to_json.py");
  EXPECT_EQ(places_by_points(faces_of_body(start, 1)), places_by_points(mesh["faces"]));
  const Json torn = read("out/states/00009.vtu", "vtu_to_json.py");
  EXPECT_EQ(places_of_faces(Json{{"faces", faces_of_body(torn, 1)}}), places_of_faces(mesh));
  for (const Json* file : {&start, &torn}) {
    const Json& on = (*file)["point_data"];
    std::map<int, int> points, vertices; // of each body
    std::set<std::pair<int, int>> seen;
    for (std::size_t p = 0; p < on["body"].size(); ++p) {
      const int body = on["body"][p], vertex = on["vertex"][p];
      ++points[body];
      vertices[body] += seen.insert({body, vertex}).second;
      if (body != 1) {
        EXPECT_EQ(on["TextureCoordinates"][p], Json({0.5, 0.5}));
      }
    }
    EXPECT_EQ(points[0], 12);
    EXPECT_EQ(points[0], vertices[0]);
    EXPECT_EQ(points[2], vertices[2]);
    if (file == &start) {
      EXPECT_EQ(vertices[1], 10);
      EXPECT_EQ(points[1], 12);
    } else {
      EXPECT_GT(vertices[1], 10) << "it is torn";
    }
  }
}

TEST_F(PictureOnSkin, is_not_on_points_of_vtu_where_solids_alone_have_one) {
  run(R"(<body><bar cells="2 1 1" size="2 1 1"/>)" + std::string(matter) +
          R"(<look texture="pictures/other.png"/></body>)",
      "0", "vtu");
  EXPECT_EQ(content(place.path() / "out/states/00000.vtu").find("TCoords"), std::string::npos);
}

TEST_F(PictureOnSkin, is_not_there_where_no_body_has_one) {
  place.write("strip.obj", strip);
  run(R"(<body><mesh file="strip.obj"/>)" + std::string(matter) + R"(<look back="#ffffff"/></body>)", "0");
  const std::string text = content(place.path() / "out/states/00000.obj");
  EXPECT_EQ(text.find("vt "), std::string::npos);
  EXPECT_EQ(text.find("mtl"), std::string::npos);
  EXPECT_FALSE(std::filesystem::exists(place.path() / "out/states/s.mtl"));
}

TEST_F(PictureOnSkin, leaves_a_material_library_that_another_output_is_called) {
  run(R"(<body><sheet cells="1 1" size="1 1"/>)" + std::string(matter) +
          R"(<look texture="pictures/other.png"/></body>)",
      "0");
  const Outcome outcome = place.rend("run s.xml --quiet --export obj -o out/states --events out/states/s.mtl");
  EXPECT_EQ(outcome.code, 64) << outcome.err;
  EXPECT_THAT(outcome.err, testing::HasSubstr("--export obj"));
}

} // namespace
} // namespace rend::picture_on_skin_test
