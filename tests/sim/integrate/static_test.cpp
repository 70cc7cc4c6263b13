// The static solve on whole scenes: equilibria that are known.
#include "sim/integrate/solved_scenes.h"

#include <cmath>
#include <gtest/gtest.h>

namespace rend::static_test {
namespace {

using namespace solved;

TEST(StaticSolve, lengthens_hanging_springs_as_the_formula_says) {
  for (const double k : {1e3, 1e9}) {
    const auto s = presets::load(scene(hanging(k), "static", 1, 1, "-9.81 0 0"));
    s->step();
    EXPECT_NEAR(-lowest(s, 0) / (0.2 * 9.81 / k * 10 * 11 / 2), 1, 1e-6) << k;
    EXPECT_EQ(s->kinetic_energy(), 0);
  }
}

TEST(StaticSolve, needs_neither_step_nor_duration) {
  const auto with = [](const std::string& time) {
    return presets::load(fmt::format(
        R"(<scene>{}<world gravity="-9.81 0 0"/><time integrator="static"{}/></scene>)", hanging(1e3), time));
  };
  const auto whole = with(R"( step="1" duration="1")"), alone = with("");
  EXPECT_EQ(alone->duration(), 1);
  EXPECT_EQ(alone->step_size(), 1);
  whole->step();
  alone->step();
  EXPECT_EQ(alone->hash(), whole->hash());
  EXPECT_EQ(with(R"( duration="4")")->step_size(), 4); // one equilibrium still
  EXPECT_EQ(with(R"( duration="4" step="auto")")->step_size(), 4);
  EXPECT_EQ(with(R"( step="0.25")")->duration(), 1);
  EXPECT_EQ(with(R"( duration="0")")->duration(), 0);
}

// a cosh(x/a) through both ends. The chain starts straight, and its right end comes nearer.
TEST(StaticSolve, finds_the_catenary) {
  struct Answer {
    double length, sag;
    int links;
  };
  for (const Answer& a : {Answer{1.2, 0.292344, 60}, Answer{2, 0.796388, 100}}) {
    const std::string ends =
        fmt::format(R"(<fix box="-0.01 -1 -1 0.01 1 1"/>)"
                    R"(<drive box="{} -1 -1 9 1 1" displacement="{} 0 0" from="0" until="1"/>)",
                    a.length - 0.01, 1 - a.length);
    const auto s = presets::load(scene(chain(a.links, a.length, 0.1, 1e6, ends), "static", 1, 1));
    s->step();
    EXPECT_NEAR(-lowest(s, 2), a.sag, 1e-3 * a.sag) << a.length;
    RecordProperty(fmt::format("newton {}", a.length), fmt::format("{}", s.body().integrator->solver().newton));
  }
}

// A bar of hexahedra along x, 1 m × 0.05 m × 0.02 m, held at x = 0; more: loads at the other end.
presets::Loaded cantilever(const std::string& model, int cells, double steps, const std::string& more) {
  return presets::load(fmt::format(
      R"(<scene><body><bar pattern="hexahedra" cells="{} 1 2" size="1 0.05 0.02"/><mass density="1000"/>)"
      R"(<elasticity model="{}" young="1e7" poisson="0"/><fix side="-x"/>{}</body><world gravity="0 0 0"/>)"
      R"(<time step="1" integrator="static" duration="{}"/></scene>)",
      cells, model, more, steps));
}
constexpr double bending_stiffness = 1e7 * 0.05 * 0.02 * 0.02 * 0.02 / 12; // EI [N·m²]

TEST(StaticSolve, solves_a_linear_model_in_one_iteration) {
  const auto s = cantilever("linear", 20, 1, R"(<load side="+x" force="0 0.1 -0.01"/>)");
  s->step();
  EXPECT_EQ(s.body().integrator->solver().newton, 1);
  EXPECT_LT(lowest(s, 2), -1e-3);
}

// Tip load, PL²/EI = 5 (tests/README.md, "Closed forms"): v/L = 0.71379, u/L = 0.38763.
TEST(StaticSolve, bends_the_elastica) {
  const auto s = cantilever("corotational", 240, 1,
                            fmt::format(R"(<load side="+x" force="0 0 {}"/>)", -5 * bending_stiffness));
  s->step();
  Vec3 tip = Vec3::Zero();
  int count = 0;
  for (Slot v = 0; v < s.body().vertices(); ++v) {
    if (s.body().map->rest()[v].x < 1 - 1e-9) continue;
    tip += s.body().map->position()[v].vec() - s.body().map->rest()[v].vec();
    ++count;
  }
  tip /= count;
  EXPECT_NEAR(-tip.z(), 0.71379, 0.02 * 0.71379);
  EXPECT_NEAR(-tip.x(), 0.38763, 0.02 * 0.38763);
  EXPECT_LT(s.body().integrator->solver().newton, 20);
}

// A cloth that starts level and comes to hang from an edge, each row bearing what is below it, as in a hanging
// rod. Each square has springs of its own along its sides: a column of squares is two springs, half in a column
// of vertices at the sides, where the mass is half as well.
TEST(StaticSolve, lets_a_cloth_hang_from_its_edge) {
  constexpr int n = 12;
  constexpr double mass = 0.1, k = 60, g = 9.81;
  const auto s = presets::load(
      scene(fmt::format(R"(<body><sheet pattern="quads" cells="{0} {0}" size="1 1"/><mass total="{1}"/>)"
                        R"(<springs><stretch k="{2}"/></springs><fix side="+y"/></body>)",
                        n, mass, k),
            "static", 1, 1));
  s->step();
  double low = -1;
  for (int row = 1; row <= n; ++row) low -= (n - row + 0.5) * mass / (n * n) * g / (2 * k);
  for (Slot v = 0; v < s.body().vertices(); ++v) {
    if (s.body().map->rest()[v].y > 1e-9) continue;
    EXPECT_NEAR(s.body().map->position()[v].z, low, 1e-7);
  }
}

// 30 × 30 cells without bending stiffness: wrinkles, singular where it starts.
TEST(StaticSolve, lets_cloths_hang_that_resist_no_bending) {
  for (const char* bend : {"", R"(<bend kind="provot" k="10"/>)"}) {
    const auto s = presets::load(scene(
        fmt::format(R"(<body><sheet pattern="quads" cells="30 30" size="1 1"/><mass total="0.1"/><springs>)"
                    R"(<stretch k="60"/><shear kind="isotropic" k="43"/>{}</springs><fix side="+y"/></body>)",
                    bend),
        "static", 1, 1));
    s->step();
    EXPECT_NEAR(lowest(s, 2), -1.003, 1e-3);
    EXPECT_LT(s.body().integrator->solver().newton, 400);
  }
}

// Nearly incompressible: the symmetrised tangent is far from the tangent.
TEST(StaticSolve, bends_a_bar_that_keeps_its_volume) {
  const auto s = presets::load(
      scene(R"(<body><bar pattern="hexahedra" cells="10 3 3" size="1 0.3 0.3"/><mass density="1000"/>)"
            R"(<elasticity young="1e5" poisson="0.499"/><fix side="-x"/></body>)",
            "static", 1, 1));
  s->step();
  EXPECT_LT(lowest(s, 2), -0.3);
}

// At 0.499 Newton's method gets there. At 0.4999 it finds an equilibrium in seven iterations as well, but one
// that is unstable from 0.8 of the weight on: it is refused, and relaxation goes a long way to a stable one.
// Where the bars hang is also where symplectic Euler with viscosity brings them to rest (within 1e-6, in 6 s).
TEST(StaticSolve, lets_finer_bars_hang_that_keep_their_volume) {
  struct Hanging {
    const char* poisson;
    double x, z; // [m], where the end comes to
    int most;    // iterations
  };
  for (const Hanging& bar :
       {Hanging{"0.499", -0.221200, -0.643578, 20}, Hanging{"0.4999", -0.068198, -0.414650, 300}}) {
    const auto s = presets::load(
        scene(fmt::format(R"(<body><bar pattern="hexahedra" cells="20 6 6" size="1 0.3 0.3"/>)"
                          R"(<mass density="1000"/><elasticity young="1e5" poisson="{}"/><fix side="-x"/>)"
                          R"(<probe name="tip" side="+x"/></body>)",
                          bar.poisson),
              "static", 1, 1));
    s->step();
    const Vec3 moved = s.body().probes[0].read(s.body())->displacement;
    EXPECT_NEAR(moved.x(), bar.x, 1e-5) << bar.poisson;
    EXPECT_NEAR(moved.z(), bar.z, 1e-5) << bar.poisson;
    EXPECT_LT(s.body().integrator->solver().newton, bar.most) << bar.poisson;
  }
}

// Turned as it is held, without loads: all forces are round-off, and that is an equilibrium.
TEST(StaticSolve, takes_a_turn_without_loads) {
  const auto s = presets::load(scene(
      R"(<body><bar pattern="hexahedra" cells="6 2 2" size="1 0.2 0.2"/><mass density="1000"/>)"
      R"(<elasticity young="1e5"/><drive side="-x" rotate="0 0 1 90"/><probe name="p" side="-x"/></body>)",
      "static", 0.25, 1, "0 0 0"));
  for (int n = 0; n < 4; ++n) s->step();
  EXPECT_LT(s->elastic_energy(), 1e-12);
  EXPECT_NEAR(s.body().probes[0].read(s.body())->reaction->norm(), 0, 1e-6); // 1e5 Pa on 0.04 m²; no inertia
}

} // namespace
} // namespace rend::static_test
