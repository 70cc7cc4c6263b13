// Implicit Euler on whole scenes, and what it has in common with the static solve.
#include "sim/integrate/solved_scenes.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace rend::implicit_test {
namespace {

using namespace solved;
using testing::HasSubstr;

TEST(ImplicitEuler, comes_to_rest_where_the_static_solve_is) {
  const auto s = presets::load(scene(hanging(1e3), "implicit", 0.05, 20, "-9.81 0 0"));
  for (int n = 0; n < 400; ++n) s->step();
  EXPECT_NEAR(-lowest(s, 0) / (0.2 * 9.81 / 1e3 * 10 * 11 / 2), 1, 1e-6);
  EXPECT_LT(s->kinetic_energy(), 1e-12);
}

TEST(Steps, of_implicit_are_to_be_given) {
  try {
    presets::load(
        fmt::format(R"(<scene>{}<time step="auto" integrator="implicit" duration="1"/></scene>)", hanging(10)));
    ADD_FAILURE();
  } catch (const UserError& error) {
    EXPECT_EQ(error.code, Exit::BadInput);
    EXPECT_THAT(error.what(), HasSubstr("is not possible with 'implicit', which is stable with every step"));
    EXPECT_THAT(error.hint, HasSubstr("give a step"));
  }
}

// A driven edge, another fixed along two axes: prescribed coordinates are exact to the last bit.
TEST(Schemes, that_solve_keep_prescribed_coordinates_exactly) {
  for (const char* scheme : {"implicit", "tr-bdf2", "alpha", "static"}) {
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
  const auto exploding = cloth("symplectic"); // unstable even in substeps
  EXPECT_THROW(
      {
        for (int n = 0; n < 50; ++n) exploding->step();
      },
      Unstable);
}

// It buckles at once under an edge that is pushed: steps of 0.1 s without substeps leave a residual of 0.86 of
// the forces.
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
  for (const char* scheme : {"implicit", "tr-bdf2", "alpha", "static"}) {
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
} // namespace rend::implicit_test
