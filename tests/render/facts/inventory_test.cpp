// rend info: the sum of its bytes against the growth of the heap, and what is left out against what is built.
#include "render/facts/inventory.h"
#include "sim/scene/memory.h"
#include "tests/render/commands/program_run.h"
#include "tests/test_paths.h"

#include <gmock/gmock.h>
#include <malloc.h>

#include <cmath>

namespace rend::inventory_test {
namespace {

using Json = nlohmann::ordered_json;
using testing::Contains;
using testing::HasSubstr;
using testing::Not;

// Bytes in use in the allocator.
std::size_t on_heap() {
  malloc_trim(0);
  const struct mallinfo2 info = mallinfo2();
  return info.uordblks + info.hblkhd;
}

std::string path_of(const std::string& preset) {
  return std::string(test::source_root) + "/presets/" + preset;
}

struct Built {
  explicit Built(const std::string& preset, std::vector<std::string> sets = {}) {
    SessionOptions options;
    options.preset = path_of(preset);
    options.sets = std::move(sets);
    options.quiet = true;
    options.threads = 1;
    { // libraries keep caches, which are allocated here
      Session first(options);
      first.scene().step();
    }
    const std::size_t before = on_heap();
    session = std::make_unique<Session>(options);
    session->scene().step();
    grown = static_cast<double>(on_heap() - before);
    listed = static_cast<double>(bytes_of_all(session->scene()));
  }
  std::unique_ptr<Session> session;
  double grown = 0, listed = 0; // [bytes]
};

// Fixed objects, names and the preset take some 50 kB; everything else must be listed.
void expect_all_is_listed(const Built& built) {
  EXPECT_GT(built.listed, 1e6); // so that 50 kB are little
  EXPECT_LT(std::abs(built.grown - built.listed), 5e4 + 0.005 * built.grown)
      << built.listed << " bytes are listed, and the heap has grown by " << built.grown;
}

TEST(Inventory, lists_all_of_a_cloth) {
  for (const char* integrator : {"symplectic", "verlet", "midpoint", "rk4"})
    expect_all_is_listed(
        Built("cloth/quads.xml",
              {"body.sheet.cells=64 64", std::string("time.integrator=") + integrator, "time.step=1e-5"}));
}

TEST(Inventory, lists_all_of_a_solid) {
  expect_all_is_listed(Built("elastic/bar-corotational.xml", {"body.bar.cells=20 8 8"}));
  expect_all_is_listed(Built("elastic/bar-mass-tensor.xml", {"body.bar.cells=20 8 8"}));
}

TEST(Inventory, lists_all_of_a_scheme_that_solves) {
  for (const char* integrator : {"implicit", "static"})
    expect_all_is_listed(
        Built("verify/cantilever-tip-load.xml", {std::string("time.integrator=") + integrator}));
}

TEST(Inventory, lists_all_of_wind_loads_and_contact) {
  expect_all_is_listed(Built("contact/drape.xml", {"body.sheet.cells=60 60"}));
}

// Sum over the arrays that are listed by name.
std::size_t listed(const Json& arrays) {
  std::size_t sum = 0;
  for (const Json& one : arrays) sum += one["bytes"].get<std::size_t>();
  return sum;
}

TEST(Inventory, sums_up_what_it_lists_in_every_preset) {
  namespace fs = std::filesystem;
  const program::TestFolder place;
  for (const char* folder : {"tear", "contact", "elastic"}) {
    for (const auto& entry : fs::directory_iterator(fs::path(test::source_root) / "presets" / folder)) {
      if (entry.path().extension() != ".xml") continue;
      const Json info = Json::parse(place.rend("info '" + entry.path().string() + "' --json").out);
      std::size_t sum = listed(info["arrays"]);
      for (const Json& body : info["bodies"]) {
        sum += listed(body["arrays"]);
        std::size_t tables = 0, parts = 0; // the two tables must agree
        for (const char* table : {"slots", "embeddings", "laws"}) tables += listed(body[table]);
        for (const char* part : {"slots", "embeddings", "laws"})
          parts += body["bytes"].value(part, std::size_t{0});
        EXPECT_EQ(tables, parts) << entry.path();
      }
      EXPECT_EQ(info["bytes"]["total"], sum) << entry.path();
    }
  }
}

TEST(Inventory, of_a_step_has_each_interaction_as_often_as_the_scheme_evaluates) {
  const program::TestFolder place;
  place.write("pulled.xml", program::pulled); // rk4
  const Json info = Json::parse(place.rend("info pulled.xml --json").out);
  std::map<std::string, double> evaluations;
  for (const Json& pass : info["step"])
    if (pass["of"] == "rows") evaluations[pass["what"]] += pass["times"].get<double>();
  EXPECT_EQ(evaluations,
            (std::map<std::string, double>{{"stretch", 4}, {"shear isotropic", 4}, {"bend provot", 4}}));
}

TEST(Inventory, of_a_step_names_what_contact_goes_through) {
  const Json info =
      Json::parse(program::TestFolder().rend("info '" + path_of("showcase/statue.xml") + "' --json").out);
  std::map<std::string, std::string> counted;
  for (const Json& pass : info["step"])
    if (pass["stage"] == "contact") counted[pass["what"]] = pass["of"];
  EXPECT_EQ(counted, (std::map<std::string, std::string>{{"the floor", "vertices"},
                                                         {"obstacles, and cloth", "triangles"},
                                                         {"obstacle 'statue'", "triangles"},
                                                         {"fragments and bodies", "pairs"},
                                                         {"edges", "pairs"},
                                                         {"edges, and those of obstacles", "pairs"}}));
}

TEST(Inventory, of_a_step_names_torn_sides_where_there_are_some) {
  const program::TestFolder place;
  place.write("slit.xml", R"xml(<scene name="slit"><body><sheet pattern="triangles" cells="4 4" size="1 1"/>
    <slit along="0.5 0.2 0  0.5 0.8 0"/><mass total="1"/><springs><stretch k="10"/></springs>
    <contact with="fragments"/></body><time duration="0.1"/></scene>)xml");
  const Json info = Json::parse(place.rend("info slit.xml --json").out);
  EXPECT_THAT(info["step"],
              Contains(testing::Truly([](const Json& pass) { return pass["what"] == "torn sides"; })));
}

// All of a sheet is one place of quarter-faces; then there are 16 faces, and 64.
TEST(Inventory, counts_where_each_rule_was_applied) {
  const program::TestFolder place;
  place.write("row.xml", R"xml(<scene name="row">
    <body name="a"><sheet cells="4 1" size="4 1"/><subdivide/>
      <apply rule="star-face" times="2"/><mass total="1"/></body>
    <body name="b"><sheet cells="2 1" size="2 1"/><mass total="1"/></body><time duration="0"/></scene>)xml");
  const Json bodies = Json::parse(place.rend("info row.xml --json").out)["bodies"];
  EXPECT_EQ(bodies[0]["applied"], Json::parse(R"([
    {"rule": "quarter-faces", "line": 2, "applied": 1, "skipped": 0},
    {"rule": "star-face", "line": 3, "applied": 80, "skipped": 0}])"));
  EXPECT_EQ(bodies[1]["applied"], Json::array());
  const std::string words = place.rend("info row.xml").out;
  EXPECT_THAT(words, testing::ContainsRegex("rules +line +applied at places"));
  EXPECT_THAT(words, testing::ContainsRegex("quarter-faces +2 +1\n +star-face +3 +80\n"));
}

TEST(Inventory, says_why_something_is_not_there) {
  const program::TestFolder place;
  place.write("pulled.xml", program::pulled);
  const Json body = Json::parse(place.rend("info pulled.xml --json").out)["bodies"][0];
  for (const char* why :
       {"'rk4' solves no system", "forces of single elements: no <tear> compares them",
        "fragments counted at each tear", "60 of stretch act between vertices that another one joins",
        "damping: none of stretch"})
    EXPECT_THAT(body["left_out"], Contains(HasSubstr(why)));
  const Json solves =
      Json::parse(place.rend("info pulled.xml --json --set time.integrator=implicit").out)["bodies"][0];
  EXPECT_THAT(solves["left_out"], Not(Contains(HasSubstr("does not solve"))));
  EXPECT_GT(solves["bytes"]["solver"], 0);
}

} // namespace
} // namespace rend::inventory_test
