// `rend run --export vtu`, read back by meshio: cells are complete and have the right orientation, and their
// data are those that `rend run --json` reports.
#include "tests/render/commands/program_run.h"
#include "tests/test_paths.h"

#include <gmock/gmock.h>

#include <array>
#include <cmath>
#include <map>
#include <set>

namespace rend::export_test {
namespace {

using program::content;
using program::Outcome;
using program::TestFolder;
using testing::HasSubstr;
using Json = nlohmann::json;
using V = std::array<double, 3>;

V operator-(const V& a, const V& b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}
V cross(const V& a, const V& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
double dot(const V& a, const V& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

using Ring = std::vector<std::size_t>;

// The faces of each cell, counter-clockwise seen from outside, from the documentation of VTK and Gmsh.
std::vector<Ring> faces_of(const std::string& type) {
  if (type == "tetra") return {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}};
  if (type == "hexahedron")
    return {{0, 3, 2, 1}, {4, 5, 6, 7}, {0, 1, 5, 4}, {1, 2, 6, 5}, {2, 3, 7, 6}, {3, 0, 4, 7}};
  if (type == "wedge") return {{0, 2, 1}, {3, 4, 5}, {0, 1, 4, 3}, {1, 2, 5, 4}, {2, 0, 3, 5}};
  return {{0, 3, 2, 1}, {0, 1, 4}, {1, 2, 4}, {2, 3, 4}, {3, 0, 4}}; // a pyramid
}

// Twice the area vector of a ring of points.
V area_vector(const std::vector<V>& ring) {
  V sum{};
  for (std::size_t n = 1; n + 1 < ring.size(); ++n) {
    const V part = cross(ring[n] - ring[0], ring[n + 1] - ring[0]);
    for (std::size_t axis = 0; axis < 3; ++axis) sum[axis] += part[axis];
  }
  return sum;
}

// The content of one file.
struct File {
  explicit File(const Json& json)
      : all(json), points(json["points"].get<std::vector<V>>()),
        rest(json["point_data"]["rest"].get<std::vector<V>>()),
        velocity(json["point_data"]["velocity"].get<std::vector<V>>()), mass(scalars("point_data", "mass")) {}

  std::vector<double> scalars(const char* on, const char* name) const {
    return all[on][name].get<std::vector<double>>();
  }
  std::map<std::string, int> types() const {
    std::map<std::string, int> counts;
    for (const Json& cell : all["cells"]) ++counts[cell[0]];
    return counts;
  }
  std::size_t distinct(const char* name) const {
    const std::vector<double> values = scalars("cell_data", name);
    return std::set<double>(values.begin(), values.end()).size();
  }

  // [m³] of a solid's cell at rest: a sum of cones over the triangles of its faces.
  double rest_volume(const Json& cell) const {
    double sixfold = 0;
    const bool given = cell[0].get<std::string>().starts_with("polyhedron");
    const std::vector<Ring> rings = given ? cell[1].get<std::vector<Ring>>() : faces_of(cell[0]);
    for (const Ring& ring : rings) {
      std::vector<V> corners;
      for (const std::size_t c : ring) corners.push_back(rest[given ? c : cell[1][c].get<std::size_t>()]);
      for (std::size_t n = 1; n + 1 < corners.size(); ++n)
        sixfold += dot(corners[0], cross(corners[n], corners[n + 1]));
    }
    return sixfold / 6;
  }
  V rest_area(const Json& cell) const { // twice, of a sheet's cell
    std::vector<V> ring;
    for (const Json& c : cell[1]) ring.push_back(rest[c.get<std::size_t>()]);
    return area_vector(ring);
  }
  const V& place_of(const V& at_rest) const {
    const auto found = std::find_if(rest.begin(), rest.end(), [&](const V& r) {
      const V apart = r - at_rest;
      return dot(apart, apart) < 1e-18;
    });
    EXPECT_NE(found, rest.end());
    return points[static_cast<std::size_t>(found - rest.begin())];
  }

  Json all;
  std::vector<V> points, rest, velocity; // [m], [m], [m/s]
  std::vector<double> mass;              // [kg]
};

class Export : public testing::Test {
protected:
  Json run(const std::string& preset, const std::string& options) const {
    place.write("scene.xml", preset);
    const Outcome outcome = place.rend("run scene.xml --quiet --json --export vtu -o states " + options);
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    return outcome.json();
  }
  File read(const std::string& name) const {
    const Outcome outcome = place.shell(std::string("/usr/bin/python3 ") + test::source_root +
                                        "/tests/render/clip/vtu_to_json.py states/" + name);
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    return File(outcome.json());
  }
  const TestFolder place;
};

// Counts, mass, momentum and energy, computed from the file only.
void expect_same_state(const File& file, const Json& figures) {
  EXPECT_EQ(file.points.size(), figures["vertices"].get<std::size_t>());
  EXPECT_EQ(file.all["cells"].size(), figures["elements"].get<std::size_t>());
  EXPECT_EQ(file.distinct("fragment"), figures["fragments"].get<std::size_t>());
  EXPECT_EQ(file.distinct("element"), figures["elements"].get<std::size_t>());
  EXPECT_EQ(file.all["time"], figures["time"]);
  double mass = 0, kinetic = 0;
  V momentum{};
  for (std::size_t p = 0; p < file.points.size(); ++p) {
    mass += file.mass[p];
    kinetic += 0.5 * file.mass[p] * dot(file.velocity[p], file.velocity[p]);
    for (std::size_t axis = 0; axis < 3; ++axis) momentum[axis] += file.mass[p] * file.velocity[p][axis];
  }
  EXPECT_NEAR(mass, figures["mass"].get<double>(), 1e-12 * mass);
  EXPECT_NEAR(kinetic, figures["energy"]["kinetic"].get<double>(), 1e-12 * kinetic);
  for (std::size_t axis = 0; axis < 3; ++axis)
    EXPECT_NEAR(momentum[axis], figures["momentum"][axis].get<double>(), 1e-12 * mass);
}

std::string with(std::string preset, const std::string& what, const std::string& instead) {
  const std::size_t at = preset.find(what);
  EXPECT_NE(at, std::string::npos) << what;
  return preset.replace(at, what.size(), instead);
}

TEST_F(Export, of_a_mixed_sheet_that_tears_has_its_faces_whole_and_on_one_side) {
  const std::string mixed = with(program::pulled, R"(cells="6 6")", R"(pattern="mixed" cells="6 6")");
  const Json figures = run(mixed, "");
  EXPECT_GT(figures["tears"].get<int>(), 0);
  EXPECT_GT(figures["fragments"].get<int>(), 1);
  EXPECT_EQ(figures["export"]["files"], 7);
  const File file = read("00006.vtu");
  expect_same_state(file, figures);
  EXPECT_EQ(file.types(), (std::map<std::string, int>{{"quad", 18}, {"triangle", 72}}));
  double area = 0; // the sheet was turned about x: y points to -y
  for (const Json& cell : file.all["cells"]) {
    EXPECT_LT(file.rest_area(cell)[1], 0);
    area -= 0.5 * file.rest_area(cell)[1];
  }
  EXPECT_NEAR(area, 1, 1e-12);
  const std::vector<double> prescribed = file.scalars("point_data", "prescribed");
  EXPECT_GE(std::count(prescribed.begin(), prescribed.end(), 7), 14); // both ends, along x, y and z
}

const char* bar = R"(<scene name="bar"><body name="bar">
  <bar pattern="mixed" cells="4 2 2" size="0.8 0.2 0.1"/><mass density="1000"/>
  <elasticity young="1e5" poisson="0.3"/><fix side="-x"/><load side="+x" force="0 0 -1"/>
  <probe name="tip" near="0.8 0.2 0.1"/></body>
  <time step="auto" integrator="symplectic" duration="0.2"/><image fps="10"/></scene>)";

TEST_F(Export, of_a_mixed_bar_has_cells_of_positive_volume_and_their_stress) {
  const Json figures = run(bar, "");
  const File file = read("00002.vtu");
  expect_same_state(file, figures);
  const std::map<std::string, int> types = file.types();
  for (const char* type : {"tetra", "hexahedron", "wedge", "pyramid"}) EXPECT_GT(types.at(type), 0);
  double volume = 0;
  for (const Json& cell : file.all["cells"]) {
    EXPECT_GT(file.rest_volume(cell), 0) << cell;
    volume += file.rest_volume(cell);
  }
  EXPECT_NEAR(volume, 0.016, 1e-14);
  const V tip = file.place_of({0.8, 0.2, 0.1});
  for (std::size_t axis = 0; axis < 3; ++axis)
    EXPECT_EQ(tip[axis], figures["probes"]["tip"]["position"][axis].get<double>());
  const Json& stress = file.all["cell_data"]["stress"];
  const std::vector<double> equivalent = file.scalars("cell_data", "von Mises stress");
  // von Mises, from the components: 2 σ² = Σ (σii − σjj)² + 6 Σ τ²
  for (std::size_t c = 0; c < stress.size(); ++c) {
    const auto s = stress[c].get<std::array<double, 9>>();
    const auto square = [](double x) { return x * x; };
    const double twice = square(s[0] - s[4]) + square(s[4] - s[8]) + square(s[8] - s[0]) +
                         6 * (square(s[1]) + square(s[2]) + square(s[5]));
    EXPECT_NEAR(equivalent[c], std::sqrt(twice / 2), 1e-9 * equivalent[c]);
    EXPECT_GT(equivalent[c], 0);
  }
}

TEST_F(Export, of_a_patch_test_has_the_stress_that_is_known) {
  const std::string preset = std::string(test::source_root) + "/presets/verify/patch-hexahedra.xml";
  ASSERT_EQ(place.rend("run '" + preset + "' --quiet --export vtu -o states").code, 0);
  const File file = read("00001.vtu");
  for (const Json& one : file.all["cell_data"]["stress"])
    for (std::size_t k = 0; k < 9; ++k) EXPECT_NEAR(one[k].get<double>(), k % 4 == 0 ? 2000 : 400, 1e-6);
}

// A Moka file of the volume with these faces, counter-clockwise seen from outside.
std::string moka(const std::vector<V>& points, const std::vector<Ring>& faces) {
  std::map<std::pair<std::size_t, std::size_t>, std::size_t> side; // from a corner to the next: its first dart
  std::size_t darts = 0;
  for (const Ring& ring : faces)
    for (std::size_t n = 0; n < ring.size(); ++n, darts += 2)
      side[{ring[n], ring[(n + 1) % ring.size()]}] = darts;
  std::string text = "Moka file [ascii]\n64 7 0 0 0 0 0 0\n";
  std::size_t first = 0;
  for (const Ring& ring : faces) {
    const std::size_t count = 2 * ring.size();
    for (std::size_t n = 0; n < count; ++n) {
      const std::size_t from = ring[n / 2], to = ring[(n / 2 + 1) % ring.size()], d = first + n;
      const V& p = points[n % 2 ? to : from];
      const std::size_t next = n % 2 ? first + (n + 1) % count : first + (n + count - 1) % count;
      text += std::to_string(d ^ 1) + " " + std::to_string(next) + " " +
              std::to_string(side[{to, from}] + 1 - n % 2) + " " + std::to_string(d) + " 0 0 0 0 1 " +
              std::to_string(p[0]) + " " + std::to_string(p[1]) + " " + std::to_string(p[2]) + "\n";
    }
    first += count;
  }
  return text;
}

TEST_F(Export, of_an_octahedron_is_a_polyhedron_whose_faces_look_outward) {
  place.write("octahedron.moka",
              moka({{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {-1, 0, 0}, {0, -1, 0}, {0, 0, -1}},
                   {{0, 1, 2}, {1, 3, 2}, {3, 4, 2}, {4, 0, 2}, {1, 0, 5}, {3, 1, 5}, {4, 3, 5}, {0, 4, 5}}));
  const Json figures = run(R"(<scene name="o"><body><mesh file="octahedron.moka"/><mass total="1"/>
    <springs><stretch k="10"/></springs></body><time step="0.01" duration="0.01"/></scene>)",
                           "");
  const File file = read("00000.vtu");
  EXPECT_EQ(file.points.size(), 6u);
  ASSERT_EQ(file.all["cells"].size(), 1u);
  EXPECT_EQ(file.all["cells"][0][0], "polyhedron6");
  EXPECT_NEAR(file.rest_volume(file.all["cells"][0]), 4.0 / 3, 1e-14);
}

TEST_F(Export, lists_its_files_with_their_times) {
  run(bar, "--frames 0,2 --steps 2 --set time.step=0.1 --set body.elasticity.young=1");
  EXPECT_EQ(place.files(),
            (std::vector<std::string>{"scene.xml", "states", "states/00000.vtu", "states/00002.vtu",
                                      "states/bar.pvd", "states/bar.scene.json"}));
  EXPECT_THAT(content(place.path() / "states/bar.pvd"),
              testing::AllOf(HasSubstr(R"(<DataSet timestep="0" part="0" file="00000.vtu"/>)"),
                             HasSubstr(R"(<DataSet timestep="0.2" part="0" file="00002.vtu"/>)")));
  EXPECT_EQ(place.shell("xmllint --noout states/bar.pvd").code, 0);
}

TEST_F(Export, of_a_state_that_several_frames_show_is_one_file) {
  const Json figures = run(bar, "--set time.step=0.1 --fps 30 --set body.elasticity.young=1");
  EXPECT_EQ(figures["export"]["files"], 3); // of 7 frames
  EXPECT_EQ(place.files(),
            (std::vector<std::string>{"scene.xml", "states", "states/00000.vtu", "states/00001.vtu",
                                      "states/00004.vtu", "states/bar.pvd", "states/bar.scene.json"}));
}

TEST_F(Export, of_a_run_that_went_wrong_ends_with_a_state_that_is_certain) {
  std::string torn_off = bar; // faster than any substep can resolve
  torn_off.replace(torn_off.find("<probe"), 0, R"(<drive side="+x" velocity="1e12 0 0" from="0.15"/>)");
  torn_off.erase(torn_off.find("<load"),
                 torn_off.find("/>", torn_off.find("<load")) + 2 - torn_off.find("<load"));
  place.write("scene.xml", torn_off);
  const Outcome outcome = place.rend("run scene.xml --quiet --export vtu -o states --fps 100");
  EXPECT_EQ(outcome.code, 76);
  const auto files = place.files();
  ASSERT_GT(files.size(), 3u);
  EXPECT_EQ(files[files.size() - 2], "states/bar.pvd");
  EXPECT_EQ(place
                .shell("/usr/bin/python3 " + std::string(test::source_root) +
                       "/tests/render/clip/vtu_to_json.py states/*.vtu")
                .code,
            0);
}

TEST_F(Export, that_cannot_be_is_refused_before_anything_is_done) {
  place.write("scene.xml", bar);
  const Outcome unknown = place.rend("run scene.xml --export vtk");
  EXPECT_EQ(unknown.code, 64);
  EXPECT_THAT(unknown.err, HasSubstr("did you mean 'vtu'?"));
  EXPECT_EQ(place.rend("run scene.xml -o states").code, 64);
  EXPECT_EQ(place.rend("run scene.xml --frames 3").code, 64);
  EXPECT_EQ(place.rend("run scene.xml --export vtu --frames 100-200").code, 64);
  EXPECT_EQ(place.rend("run scene.xml --export vtu -o scene.xml/states").code, 73);
  EXPECT_EQ(place.files(), std::vector<std::string>{"scene.xml"});
}

} // namespace
} // namespace rend::export_test
