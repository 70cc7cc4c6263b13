// Every tearing law under implicit and static schemes: bodies tear, the run continues, maps stay valid, and
// matrices equal those assembled from scratch, to the last bit.
#include "sim/fracture/torn_checks.h"
#include "sim/presets.h"
#include "sim/topology/count.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cstring>

namespace rend::torn_test {
namespace {

using namespace torn;

struct Asked {
  const char* law;     // attributes without the threshold
  double sheet, solid; // thresholds; 0: not applicable
};

// All criteria, each with every change that it allows.
const std::vector<Asked>& every_law() {
  static const std::vector<Asked> all{
      {R"(criterion="atomic-border" change="separate")", 1, 20},
      {R"(criterion="global-border" change="separate")", 0.1, 2},
      {R"(criterion="strain" kind="stretch" change="separate")", 0.05, 0},
      {R"(criterion="atomic-spring" kind="stretch" change="separate")", 1, 0},
      {R"(criterion="atomic-spring" kind="stretch" change="delete-edge")", 1, 0},
      {R"(criterion="atomic-vertex" change="split-vertex")", 1, 5},
      {R"(criterion="cumulative-vertex" change="split-vertex")", 0.01, 2},
      {R"(criterion="vertex-stress" change="split-vertex")", 0, 1e4},
      {R"(criterion="atomic-element" change="delete-element")", 0, 1e4},
      {R"(criterion="strain" change="delete-element")", 0, 0.1},
  };
  return all;
}

std::string time_of(const std::string& scheme) {
  return fmt::format(R"(<time step="0.02" integrator="{}" duration="1"/>)", scheme);
}

// Both are held at one end and pulled at the other: only the pull tears them.
presets::Loaded sheet(const std::string& law, double threshold, const std::string& scheme) {
  return presets::load(presets::cloth("quads", 6, fmt::format(R"(<tear {} threshold="{}"/>)", law, threshold),
                                      time_of(scheme), R"(<bend kind="provot" k="10"/>)",
                                      R"(<fix side="-z"/><drive side="+z" velocity="0.1 0.1 0.5"/>)"));
}
presets::Loaded solid(const std::string& law, double threshold, const std::string& scheme) {
  return presets::load(
      fmt::format(R"(<scene><body><bar pattern="mixed" cells="5 2 2" size="1 0.3 0.3"/><mass density="100"/>)"
                  R"(<elasticity young="1e5"/><fix side="-x"/><drive side="+x" velocity="1 0.1 0.2"/>)"
                  R"(<tear {} threshold="{}"/></body>{}</scene>)",
                  law, threshold, time_of(scheme)));
}

void expect_matrix_as_built_anew(Body& body) {
  Assembly fresh(*body.map, *body.program);
  ASSERT_TRUE(body.pattern()->same_as(*fresh.pattern()));
  BlockMatrix kept, made;
  kept.reset(body.pattern());
  made.reset(fresh.pattern());
  const Record *x = body.map->position().values().data(), *v = body.map->velocity().values().data();
  body.add_stiffness(x, v, Tangent::SemiDefinite, 1e-4, 1e-2, kept);
  fresh.add(x, v, Tangent::SemiDefinite, 1e-4, 1e-2, made);
  for (std::size_t n = 0; n < kept.pattern()->blocks(); ++n)
    ASSERT_EQ(std::memcmp(&kept.at(n), &made.at(n), sizeof(Block3)), 0) << "block " << n;
}

void expect_goes_on(const presets::Loaded& s, int steps) {
  Body& body = s.body();
  Seen seen(body);
  const bool failed = testing::Test::HasFailure(); // before
  std::size_t looked = 0;
  for (int n = 0; n < steps; ++n) {
    s->step();
    for (Slot v = 0; v < body.vertices(); ++v) ASSERT_TRUE(body.map->position()[v].vec().allFinite());
    if (s->tears() == looked) continue;
    looked = s->tears();
    seen.update();
    expect_as_built_anew(body, seen);
    expect_matrix_as_built_anew(body);
    if (testing::Test::HasFailure() && !failed) FAIL() << "in step " << n;
  }
  EXPECT_GT(s->tears(), 1u);
}

TEST(TornSolved, by_every_law_goes_on_with_the_matrix_of_a_body_built_anew) {
  for (const char* scheme : {"implicit", "tr-bdf2", "alpha", "static"}) {
    for (const Asked& asked : every_law()) {
      for (const bool flat : {true, false}) {
        const double threshold = flat ? asked.sheet : asked.solid;
        if (threshold == 0) continue;
        SCOPED_TRACE(fmt::format("{} of a {}: {}", scheme, flat ? "sheet" : "solid", asked.law));
        try {
          expect_goes_on(flat ? sheet(asked.law, threshold, scheme) : solid(asked.law, threshold, scheme), 25);
        } catch (const UserError& error) {
          ADD_FAILURE() << error.what() << " | " << error.hint;
        }
      }
    }
  }
}

// A strip is torn in two without gravity; both ends lose their load.
TEST(TornSolved, pieces_that_nothing_holds_take_their_own_shape_in_their_place_under_static) {
  for (const bool linear : {false, true}) {
    const auto s = presets::load(fmt::format(
        R"(<scene><body><bar pattern="hexahedra" cells="6 1 1" size="6 1 1"/><mass density="1"/>)"
        R"(<elasticity model="{}" young="1e5" poisson="0"/><fix side="-x"/>)"
        R"(<drive side="+x" velocity="1 0 0"/><tear criterion="atomic-border" threshold="1e4"/></body>)"
        R"(<world gravity="0 0 -9.81"/><time step="0.1" integrator="static" duration="3"/></scene>)",
        linear ? "linear" : "corotational"));
    EXPECT_FALSE(s.body().notes.empty());
    for (int n = 0; n < 30; ++n) s->step();
    const Body& body = s.body();
    EXPECT_GE(count_cells(body.map->map(), Component), 3u); // two held ends, and the piece between them
    // The piece between them has its length at rest.
    std::map<Dart, std::pair<double, double>> span;
    double low = 1e9, high = -1e9;
    for (Slot v = 0; v < body.vertices(); ++v) {
      const double rest = body.map->rest()[v].x;
      if (rest < 1.5 || rest > 4.5) continue;
      low = std::min(low, body.map->position()[v].z);
      high = std::max(high, body.map->position()[v].z);
    }
    EXPECT_NEAR(high - low, 1, 0.01);
  }
}

// Under implicit Euler they fall.
TEST(TornSolved, pieces_that_nothing_holds_fall_under_implicit) {
  const auto s = solid(R"(criterion="atomic-border" change="separate" until="0.2")", 20, "implicit");
  for (int n = 0; n < 50; ++n) s->step();
  double low = 0;
  for (const Record& x : s.body().map->position().values()) low = std::min(low, x.z);
  EXPECT_LT(low, -1);
}

} // namespace
} // namespace rend::torn_test
