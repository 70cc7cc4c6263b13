// The largest values that criteria reach: of a law that never tears, and of all criteria by `rend run --reach`.
// Compared with runs that tear: a threshold just below a value tears, one just above does not.
#include "tests/render/commands/program_run.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace rend::reach_test {
namespace {

using nlohmann::json;
using program::TestFolder;
using testing::AllOf;
using testing::HasSubstr;

// A block that is pulled: springs and finite elements at once, so that every criterion of solids fits.
const char* const block = R"(<scene name="block">
  <body name="block">
    <bar cells="3 2 2" size="0.6 0.4 0.4"/>
    <mass total="1"/>
    <springs><stretch k="60"/><shear kind="isotropic" k="43"/></springs>
    <elasticity young="2e3"/>
    <viscosity value="0.4" per="body"/>
    <fix side="-x"/>
    <drive side="+x" velocity="1 0 0" until="0.1"/>
    <tear criterion="global-border" threshold="1e9"/>
  </body>
  <time step="1e-3" duration="0.25"/>
</scene>
)";

class Reach : public testing::TestWithParam<const char*> {
protected:
  Reach() {
    place.write("pulled.xml", program::pulled);
    place.write("block.xml", block);
  }
  json run(const std::string& words) const {
    const program::Outcome outcome = place.rend("run " + words + " --json -q");
    EXPECT_EQ(outcome.code, 0) << words << "\n" << outcome.err;
    return outcome.code == 0 ? outcome.json() : json{};
  }
  // Of the law with this criterion, called "atomic-spring stretch", and no other.
  json law(const std::string& name, double threshold) const {
    const std::size_t blank = name.find(' ');
    std::string words = fmt::format("{}.xml --set body.tear.criterion={} --set body.tear.threshold={:.17g}",
                                    GetParam(), name.substr(0, blank), threshold);
    if (blank != std::string::npos) words += " --set body.tear.kind=" + name.substr(blank + 1);
    return run(words)["laws"][0];
  }
  const TestFolder place;
};

TEST_P(Reach, is_the_threshold_at_which_the_first_tear_comes) {
  const json figures = run(std::string(GetParam()) + ".xml --reach --reach-every 1");
  EXPECT_EQ(figures["tears"], 0);
  ASSERT_GE(figures["reach"].size(), 6u);
  constexpr double slight = 1e-6;
  const double step = figures["step"];
  int torn = 0; // criteria
  for (const json& one : figures["reach"]) {
    const std::string name = one["criterion"];
    ASSERT_FALSE(one["reached"].is_null()) << name; // also of vertices: one that can be split is named
    const double value = one["reached"]["value"], time = one["reached"]["time"];
    const json below = law(name, value * (1 - slight)), above = law(name, value * (1 + slight));
    EXPECT_TRUE(above["first"].is_null()) << name << " reached " << value << " and tore above it";
    EXPECT_EQ(above["tears"], 0) << name;
    ++torn;
    ASSERT_FALSE(below["first"].is_null()) << name << " reached " << value;
    EXPECT_LE(below["first"], time + 0.1 * step) << name;
    EXPECT_GE(below["first"], time - 5.1 * step) << name; // within a millionth of its top already
  }
  EXPECT_GE(torn, 5);
}

TEST_P(Reach, is_told_of_a_law_that_never_tears) {
  const std::string words = std::string(GetParam()) + ".xml --set body.tear.threshold=1e9";
  const json figures = run(words), law = figures["laws"][0],
             all = run(words + " --reach --reach-every 1")["reach"];
  EXPECT_TRUE(law["first"].is_null());
  EXPECT_GT(law["look_every"], 1);
  for (const json& one : all) {
    if (one["criterion"] != law["criterion"]) continue;
    const double most = one["reached"]["value"], seen = law["reached"]["value"];
    EXPECT_LE(seen, most * (1 + 1e-12)); // it looks at every few steps alone
    EXPECT_GT(seen, 0.1 * most);
    const double steps = law["reached"]["time"].get<double>() / figures["step"].get<double>();
    EXPECT_NEAR(std::remainder(steps, law["look_every"].get<double>()), 0, 1e-6);
  }
  EXPECT_THAT(place.rend("run " + words).out,
              AllOf(HasSubstr("never; largest value, sampled every "), HasSubstr(" near (")));
}

TEST_P(Reach, is_looked_for_at_some_steps_and_at_the_last) {
  const std::string preset = std::string(GetParam()) + ".xml";
  const json every = run(preset + " --reach --reach-every 1"), some = run(preset + " --reach");
  ASSERT_EQ(some["reach"].size(), every["reach"].size());
  const long steps = some["steps"], between = some["reach"][0]["look_every"];
  EXPECT_EQ(between, std::clamp(steps / 32, 1L, 256L));
  const double step = some["step"];
  for (std::size_t n = 0; n < some["reach"].size(); ++n) {
    const json &one = some["reach"][n], all = every["reach"][n];
    if (one["reached"].is_null()) continue; // its place was possible at other steps
    EXPECT_LE(one["reached"]["value"].get<double>(), all["reached"]["value"].get<double>() * (1 + 1e-9));
    const long at = std::lround(one["reached"]["time"].get<double>() / step);
    EXPECT_TRUE(at % between == 0 || at == steps - 1) << one;
    // What is largest at the end is found.
    const long top = std::lround(all["reached"]["time"].get<double>() / step);
    EXPECT_TRUE(top != steps - 1 || at == top) << one;
  }
  // A run that is cut short looks as often.
  EXPECT_EQ(run(preset + " --reach --steps 64")["reach"][0]["look_every"], 2);
}

INSTANTIATE_TEST_SUITE_P(Scenes, Reach, testing::Values("pulled", "block"));

// A sheet and a solid that are stretched by a tenth at once, in cells of one size and of half of it.
TEST(ReachOfAMesh, falls_with_the_cells_for_forces_and_not_for_strain_and_stress) {
  TestFolder place;
  const auto stretched = [](const std::string& body) {
    return R"(<scene name="s"><body>)" + body +
           R"(<mass total="1"/><drive all="yes" gradient="0.1 0 0 0 0 0 0 0 0"/>
      </body><world gravity="0 0 0"/><time step="1e-4" duration="2e-3"/></scene>)";
  };
  place.write("sheet.xml", stretched(R"(<sheet cells="4 4" size="1 1"/>
    <springs><stretch k="60"/><shear kind="isotropic" k="43"/></springs>)"));
  place.write("solid.xml",
              stretched(R"(<bar cells="4 4 4" size="1 1 1"/><elasticity young="1e4" poisson="0.3"/>)"));
  const auto ratio = [&](const std::string& preset, const std::string& cells, const std::string& criterion) {
    std::vector<double> reached;
    for (const std::string& more : {std::string(), " --set " + cells}) {
      const json figures = place.rend("run " + preset + " --reach --json -q" + more).json();
      for (const json& one : figures["reach"])
        if (one["criterion"] == criterion) reached.push_back(one["reached"]["value"]);
    }
    return reached.size() == 2 ? reached[1] / reached[0] : 0;
  };
  const std::string sheet = "body.sheet.cells='8 8'", solid = "body.bar.cells='8 8 8'";
  EXPECT_NEAR(ratio("sheet.xml", sheet, "atomic-spring stretch"), 0.5, 1e-9);
  EXPECT_NEAR(ratio("sheet.xml", sheet, "atomic-border"), 0.5, 1e-9);
  EXPECT_NEAR(ratio("sheet.xml", sheet, "strain stretch"), 1, 1e-9);
  EXPECT_NEAR(ratio("solid.xml", solid, "atomic-border"), 0.25, 1e-9);
  EXPECT_NEAR(ratio("solid.xml", solid, "atomic-element"), 1, 1e-9);
  EXPECT_NEAR(ratio("solid.xml", solid, "strain"), 1, 1e-9);
}

// Looking changes nothing: neither the state nor what tears.
TEST(ReachOfALaw, leaves_the_run_as_it_is) {
  TestFolder place;
  place.write("pulled.xml", program::pulled);
  const json torn = place.rend("run pulled.xml --json -q").json();
  const json bare = place.rend("run pulled.xml --json -q --set body.tear.threshold=1e9").json();
  const json reach = place.rend("run pulled.xml --json -q --reach").json();
  EXPECT_GT(torn["tears"], 0);
  EXPECT_GT(torn["laws"][0]["reached"]["value"], torn["laws"][0]["threshold"]);
  EXPECT_LE(torn["laws"][0]["first"], torn["laws"][0]["reached"]["time"]);
  EXPECT_NEAR(reach["energy"]["kinetic"].get<double>(), bare["energy"]["kinetic"].get<double>(), 1e-9);
  EXPECT_EQ(place.rend("run pulled.xml --reach --events e.jsonl").code, 64);
}

} // namespace
} // namespace rend::reach_test
