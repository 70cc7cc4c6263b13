// Implicit Euler and the static solve on whole scenes.
#include "sim/rows/frequency.h"
#include "sim/scene/scene.h"

#include "sim/presets.h"

#include <cmath>
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace rend {
namespace {

using testing::HasSubstr;

// Two chains of n links side by side, tied to each other: along x, 1 m and a cell wide.
std::string chain(int n, double length, double mass, double k, const std::string& more) {
  return fmt::format(R"(<body><sheet cells="{} 1" size="{} 0.1"/><mass total="{}"/>)"
                     R"(<springs><stretch k="{}"/></springs>{}</body>)",
                     n, length, mass, k, more);
}

std::string scene(const std::string& body, const std::string& scheme, double step, double duration,
                  const std::string& gravity = "0 0 -9.81") {
  return fmt::format(R"(<scene>{}<world gravity="{}"/><time step="{}" integrator="{}" duration="{}"/></scene>)",
                     body, gravity, step, scheme, duration);
}

double lowest(const presets::Loaded& s, int axis) {
  double low = 1e300;
  for (const Record& r : s.body().map->position().values()) low = std::min(low, r.vec()[axis]);
  return low;
}

// Ten links of 0.1 m hang from x = 1 towards −x, where gravity points; loads make the last masses equal to the
// others.
std::string hanging(double k) {
  const double m = 0.2, g = 9.81; // [kg] of a mass of each chain; a cell has two
  return chain(10, 1, 10 * 2 * m, k,
               fmt::format(R"(<viscosity value="2" per="particle"/><fix side="+x"/>)"
                           R"(<load box="-0.01 -1 -1 0.01 1 1" force="{} 0 0"/>)",
                           -m * g));
}

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

TEST(ImplicitEuler, comes_to_rest_where_the_static_solve_is) {
  const auto s = presets::load(scene(hanging(1e3), "implicit", 0.05, 20, "-9.81 0 0"));
  for (int n = 0; n < 400; ++n) s->step();
  EXPECT_NEAR(-lowest(s, 0) / (0.2 * 9.81 / 1e3 * 10 * 11 / 2), 1, 1e-6);
  EXPECT_LT(s->kinetic_energy(), 1e-12);
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

// The symmetrised tangent is not even positive where the bar hangs, and it hangs there all the same: implicit
// with viscosity comes to rest at the same place (0.499: within 1e-6, in 200 steps of 0.05 s).
TEST(StaticSolve, lets_finer_bars_hang_that_keep_their_volume) {
  struct Hanging {
    const char* poisson;
    double x, z; // [m], where the end comes to
  };
  for (const Hanging& bar : {Hanging{"0.499", -0.235164, -0.660415}, Hanging{"0.4999", -0.064886, -0.407914}}) {
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
    EXPECT_LT(s.body().integrator->solver().newton, 20) << bar.poisson;
  }
}

TEST(StaticSolve, refuses_what_nothing_holds) {
  const auto refusal = [](const std::string& more, const std::string& springs) {
    const auto s = presets::load(scene(R"(<body><sheet cells="4 3" size="1 1"/><mass total="1"/><springs>)" +
                                           springs + "</springs>" + more + "</body>",
                                       "static", 1, 1));
    try {
      s->step();
    } catch (const Unstable& error) {
      EXPECT_EQ(error.code, Exit::Unstable);
      EXPECT_EQ(s->steps_done(), 0);
      return std::string(error.what()) + " | " + error.hint;
    }
    return std::string("not refused");
  };
  const std::string springs =
      R"(<stretch k="100"/><shear kind="isotropic" k="50"/><bend kind="provot" k="50"/>)";
  EXPECT_THAT(refusal("", springs), HasSubstr("nothing holds a piece of 20 vertices along x, y, z"));
  EXPECT_THAT(refusal(R"(<fix all="yes" axes="xy"/>)", springs), HasSubstr("along z"));
  EXPECT_THAT(refusal(R"(<fix near="0 0 0"/>)", springs),
              testing::AnyOf(HasSubstr("turn"), HasSubstr("not refused")));
}

// A bar of hexahedra along x, a metre long, under its weight.
presets::Loaded heavy_bar(const std::string& pattern, const std::string& model, double density,
                          const std::string& held) {
  return presets::load(
      scene(fmt::format(R"(<body><bar pattern="{}" cells="6 2 2" size="1 0.2 0.2"/><mass density="{}"/>)"
                        R"(<elasticity model="{}" young="1e5"/>{}</body>)",
                        pattern, density, model, held),
            "static", 1, 1));
}

std::string refusal_of_step(const presets::Loaded& s) {
  try {
    s->step();
  } catch (const Unstable& error) {
    EXPECT_EQ(static_cast<int>(error.code), 76);
    return std::string(error.what()) + " | " + error.hint;
  }
  return "not refused";
}

// Held at a point it may turn: no model of small displacements has an equilibrium, wherever the solve gets to.
TEST(StaticSolve, refuses_small_displacements_of_what_may_turn) {
  for (const char* model : {"linear", "mass-tensor"})
    for (const char* pattern : {"hexahedra", "prisms", "tetrahedra", "mixed"})
      EXPECT_THAT(refusal_of_step(heavy_bar(pattern, model, 1000, R"(<fix near="0 0 0"/>)")),
                  HasSubstr("lets the body turn as a whole"))
          << model << ", " << pattern;
  EXPECT_EQ(refusal_of_step(heavy_bar("hexahedra", "linear", 1, R"(<fix side="-x"/>)")), "not refused");
}

// What turns with its elements hangs below the point, its weight on the line through it; or it is refused.
TEST(StaticSolve, hangs_a_bar_from_its_corner_or_refuses) {
  for (const char* pattern : {"hexahedra", "prisms", "tetrahedra", "mixed"}) {
    const auto s = heavy_bar(pattern, "corotational", 100, R"(<fix near="0 0 0"/>)");
    const std::string refusal = refusal_of_step(s);
    if (refusal != "not refused") {
      EXPECT_THAT(refusal, HasSubstr("no equilibrium was found")) << pattern;
      continue;
    }
    Vec3 moment = Vec3::Zero();
    double mass = 0;
    for (Slot v = 0; v < s.body().vertices(); ++v) {
      const double m = 1 / s.body().program->inverse_mass()[v];
      moment += m * s.body().map->position()[v].vec();
      mass += m;
    }
    // Elements with one mean rotation leave a moment of their own (element_law.h): they hang a little off.
    const double off = std::string(pattern) == "tetrahedra" ? 1e-6 : 5e-3;
    EXPECT_NEAR(moment.x() / mass, 0, off) << pattern;
    EXPECT_NEAR(moment.y() / mass, 0, off) << pattern;
    EXPECT_LT(moment.z() / mass, -0.4) << pattern;
  }
}

TEST(StaticSolve, refuses_forces_that_overflow) {
  EXPECT_THAT(refusal_of_step(heavy_bar("hexahedra", "corotational", 1e300, R"(<fix side="-x"/>)")),
              HasSubstr("larger than numbers go"));
  EXPECT_THAT(refusal_of_step(heavy_bar("hexahedra", "corotational", 1000,
                                        R"(<fix side="-x"/><load side="+x" force="1e300 0 0"/>)")),
              HasSubstr("larger than numbers go"));
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

TEST(Steps, of_implicit_are_to_be_given) {
  try {
    presets::load(fmt::format(R"(<scene>{}<time step="auto" integrator="implicit" duration="1"/></scene>)",
                              hanging(10)));
    ADD_FAILURE();
  } catch (const UserError& error) {
    EXPECT_EQ(error.code, Exit::BadInput);
    EXPECT_THAT(error.what(), HasSubstr("a matter of accuracy"));
    EXPECT_THAT(error.hint, HasSubstr("give a step"));
  }
}

// A driven edge, another fixed along two axes: to the last bit where they are to be.
TEST(Schemes, that_solve_keep_prescribed_coordinates_exactly) {
  for (const char* scheme : {"implicit", "static"}) {
    const auto s = presets::load(presets::cloth(
        "quads", 6, "", fmt::format(R"(<time step="0.125" integrator="{}" duration="1"/>)", scheme),
        R"(<bend kind="provot" k="10"/>)",
        R"(<fix side="-z" axes="xz"/><drive side="+z" velocity="0.125 0 0.25"/>)"));
    const Constraints& held = s.body().constraints;
    for (int n = 1; n <= 4; ++n) {
      s->step();
      std::vector<Record> x = s.body().map->position().values(), v = s.body().map->velocity().values();
      const std::vector<Record> x_before = x;
      held.apply(*s.body().map, 0.125 * n, x.data(), v.data());
      for (Slot i : held.vertices()) EXPECT_EQ(x[i].vec(), x_before[i].vec()) << scheme << ", step " << n;
    }
    std::vector<std::uint8_t> axes(s.body().vertices(), 0);
    held.mark(0.5, axes.data());
    EXPECT_EQ(std::count(axes.begin(), axes.end(), 5), 7);
    EXPECT_EQ(std::count(axes.begin(), axes.end(), 7), 7);
  }
}

// At such a stiffness the largest stable step of an explicit scheme is a million times smaller.
TEST(ImplicitEuler, is_stable_where_explicit_schemes_explode) {
  const auto cloth = [](const char* scheme) {
    return presets::load(
        scene(R"(<body><sheet pattern="quads" cells="8 8" size="1 1"/><mass total="0.1"/><springs>)"
              R"(<stretch k="1e9"/><shear kind="isotropic" k="1e9"/><bend kind="provot" k="1e9"/>)"
              R"(</springs><fix near="0 1 0"/><fix near="1 1 0"/></body>)",
              scheme, 1e-2, 1));
  };
  const auto stiff = cloth("implicit");
  const auto total = [&] {
    return stiff->kinetic_energy() + stiff->elastic_energy() + stiff->gravity_energy();
  };
  double before = total();
  for (int n = 0; n < 50; ++n) {
    stiff->step();
    EXPECT_LT(total(), before + 1e-6) << n;
    before = total();
  }
  const auto exploding = cloth("symplectic"); // even in parts
  EXPECT_THROW(
      {
        for (int n = 0; n < 50; ++n) exploding->step();
      },
      Unstable);
}

// It buckles at once under an edge that is pushed: whole steps of 0.1 s leave 0.86 of the forces.
TEST(ImplicitEuler, goes_a_step_in_parts_where_it_is_not_solved_at_once) {
  const auto s = presets::load(scene(
      R"(<body><sheet pattern="quads" cells="12 12" size="1 1"/><place rotate="90 0 0"/><mass total="0.1"/>)"
      R"(<springs><stretch k="6000"/><shear kind="isotropic" k="6000"/><bend kind="provot" k="10"/></springs>)"
      R"(<viscosity value="0.01" per="body"/><fix side="-z"/><drive side="+z" velocity="0 0 -0.5"/></body>)",
      "implicit", 0.1, 1, "0 -1 -9.81"));
  for (int n = 0; n < 4; ++n) s->step();
  const EmbeddedMap& map = *s.body().map;
  std::size_t driven = 0;
  for (Slot v = 0; v < map.position().values().size(); ++v) {
    EXPECT_TRUE(map.position()[v].vec().allFinite());
    if (map.rest()[v].z < 0.999) continue;
    EXPECT_NEAR(map.position()[v].z, 0.8, 1e-12);
    ++driven;
  }
  EXPECT_EQ(driven, 13u);
  EXPECT_GT(s.body().integrator->solver().newton, 4 * 50);
}

TEST(Schemes, that_solve_give_the_same_bytes_on_any_number_of_threads) {
  for (const char* scheme : {"implicit", "static"}) {
    std::vector<std::uint64_t> hashes;
    for (const int threads : {1, 2, 4}) {
      const auto s = presets::load(
          presets::cloth("quads", 64, "",
                         fmt::format(R"(<time step="0.01" integrator="{}" duration="1"/>)", scheme), "",
                         R"(<fix all="yes" axes="y"/><fix side="-z"/><drive side="+z" velocity="0 0 1"/>)"),
          {.walk = false, .threads = threads});
      s->step();
      EXPECT_EQ(s.body().program->parts(), threads);
      hashes.push_back(s->hash());
    }
    EXPECT_THAT(hashes, testing::Each(hashes.front())) << scheme;
  }
}

TEST(Schemes, that_solve_say_what_it_took) {
  const auto s = presets::load(scene(hanging(1e3), "implicit", 0.05, 20, "-9.81 0 0"));
  EXPECT_EQ(s.body().integrator->solver().newton, 0);
  s->step();
  const SolverFigures figures = s.body().integrator->solver();
  EXPECT_GT(figures.newton, 0);
  EXPECT_GT(figures.factorisations + figures.cg, 0);
  EXPECT_GT(figures.bytes, 22 * sizeof(Block3));
}

} // namespace
} // namespace rend
