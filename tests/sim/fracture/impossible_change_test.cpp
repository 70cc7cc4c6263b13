// Laws whose rules would make elements that cannot be simulated: such a change is refused and counted; where
// that is not known before, the run ends with the time and the rule.
#include "sim/presets.h"
#include "sim/rules/rest_measures.h"
#include "sim/rules/script_run.h"
#include "sim/topology/validate.h"
#include "sim/topology/walk.h"

#include <gtest/gtest.h>

namespace rend::impossible_change_test {
namespace {

// Each vertex that it finds goes to one line or plane: the last of an element would make it flat.
const std::string flatten = R"xml(<rule name="flatten" left="a*(1,2,3)" right="a(1,2,3)">
    <set node="a" position="point(x(a), 0.1, z(a))" rest="point(x(a), 0.1, z(a))"/></rule>
  <script name="flatten-by-script" hook="a*(1,2,3)"><for each="e*(1,2,3)" apply="flatten"/></script>)xml";

const std::string sheet = R"xml(<sheet pattern="triangles" cells="8 4" size="0.8 0.4"/>
    <mass density="1000" thickness="1e-3"/>)xml";
const std::string bar = R"xml(<bar pattern="tetrahedra" cells="8 4 4" size="0.8 0.4 0.4"/>
    <mass density="1000"/>)xml";

std::string pulled(const std::string& matter, const std::string& rule, const std::string& most = "3") {
  return "<scene>" + flatten + R"xml(
      <rule name="shift" left="a*(1,2,3)" right="a(1,2,3)">
        <set node="a" position="a + point(0.03, 0, 0)" rest="a + point(0.03, 0, 0)"/></rule>
      <body name="torn">)xml" +
         matter + R"xml(<drive side="-x" velocity="-0.3 0 0"/><drive side="+x" velocity="0.3 0 0"/>
      <tear criterion="atomic-vertex" threshold="0.02" max-per-step=")xml" +
         most + R"xml(" rule=")xml" + rule + R"xml("/></body>
      <world gravity="0 0 0"/><time step="1e-4" duration="1"/></scene>)xml";
}

// Of the smallest element at rest [m², m³].
double least_measure(EmbeddedMap& map) {
  double least = 1;
  map.edit([&](Edit& edit) {
    const CellIndex elements(edit.map(), element_orbit(edit.map().dimension()));
    for (Slot e = 0; e < elements.slots(); ++e) {
      const Dart d = elements.first_dart(e);
      least = std::min(least, edit.map().dimension() == 2 ? face_vector(edit, d).norm()
                                                          : std::abs(volume_at_rest(edit, d)));
    }
  });
  return least;
}

class ImpossibleChange : public testing::TestWithParam<std::tuple<const char*, const char*, const char*>> {};

TEST_P(ImpossibleChange, is_refused_and_counted) {
  const auto& [model, rule, most] = GetParam();
  const bool is_sheet = std::string(model) == "sheet";
  const std::string elasticity =
      is_sheet ? std::string(R"xml(<elasticity young="2e5" thickness="1e-3" damping-mass="50"/>)xml")
               : std::string("<elasticity model=\"") + model + R"xml(" young="2e5" damping-mass="50"/>)xml";
  auto scene = presets::load(pulled((is_sheet ? sheet : bar) + elasticity, rule, most));
  const Body& body = scene.body();
  std::uint64_t unfit = 0;
  for (int n = 0; n < 40; ++n) {
    ASSERT_NO_THROW(scene->step());
    ASSERT_GT(least_measure(*body.map), is_sheet ? 1e-6 : 1e-9); // of 5e-3 and 1.7e-4
  }
  const auto fault = validate(*body.map);
  EXPECT_FALSE(fault) << *fault;
  EXPECT_GT(body.events.size(), 10u);
  for (const auto& [reason, count] : body.tear_laws[0].refusals()) {
    EXPECT_EQ(reason, RuleOrScriptRunner::unfit);
    unfit = count;
  }
  EXPECT_GT(unfit, 0u);
}

INSTANTIATE_TEST_SUITE_P(Of, ImpossibleChange,
                         testing::Combine(testing::Values("sheet", "corotational", "linear", "mass-tensor"),
                                          testing::Values("flatten", "flatten-by-script"),
                                          testing::Values("20", "0")));

// Whether springs from young are possible is not known before the change is made.
TEST(ImpossibleChangeOfSprings, ends_the_run_with_its_time_and_rule_and_leaves_the_state) {
  auto scene = presets::load(pulled(
      sheet +
          R"xml(<springs young="2e5" poisson="0.3" thickness="1e-3"><stretch damping="0.01"/></springs>)xml",
      "shift"));
  const Body& body = scene.body();
  std::size_t events = 0;
  std::string told;
  for (int n = 0; n < 2000 && told.empty(); ++n) {
    events = body.events.size();
    try {
      scene->step();
    } catch (const Unstable& error) {
      EXPECT_EQ(error.code, Exit::Unstable);
      told = error.what();
    }
  }
  EXPECT_NE(told.find("test.xml:"), std::string::npos) << told;
  EXPECT_NE(told.find("the simulation was stopped at "), std::string::npos) << told;
  EXPECT_NE(told.find("in body 'torn', because 'shift' makes what it cannot go on with: "), std::string::npos)
      << told;
  EXPECT_NE(told.find("the formula gives the edge at"), std::string::npos) << told;
  EXPECT_GT(events, 0u);
  EXPECT_EQ(body.events.size(), events);
  const auto fault = validate(*body.map);
  EXPECT_FALSE(fault) << *fault;
  for (const Record& x : body.map->position().values()) EXPECT_TRUE(x.vec().allFinite());
}

} // namespace
} // namespace rend::impossible_change_test
