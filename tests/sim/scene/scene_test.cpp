// Whole scenes: stable steps, energy, determinism, what happens when a step becomes unstable, and what is left
// out.
#include "sim/scene/scene.h"

#include "sim/presets.h"

#include <cmath>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace rend::scene_test {
namespace {

using testing::Contains;
using testing::HasSubstr;
using testing::Not;

std::string with_hint(const UserError& error) {
  return std::string(error.what()) + " | " + error.hint;
}

std::string refusal_of(const std::string& xml) {
  try {
    presets::load(xml);
  } catch (const UserError& error) {
    EXPECT_EQ(error.code, Exit::BadInput);
    return with_hint(error);
  }
  return "not refused";
}

struct Cloth {
  std::string name, pattern, springs; // of 10 × 10 cells, as presets/cloth
};

std::vector<Cloth> cloths(bool damped) {
  const std::string along = damped ? R"( damping="0.01")" : "", about = damped ? R"( damping="2e-6")" : "";
  const std::string stretch = R"(<stretch k="200")" + along + "/>", shear = R"(<shear k="60")" + along + "/>";
  const std::string provot = R"(<bend kind="provot" k="4")" + along + "/>";
  const std::string angular = R"(<bend kind="angular" k="0.0004")" + about + "/>";
  return {{"quads", "quads", stretch + shear + provot},
          {"crossed", "crossed", stretch + provot},
          {"mixed", "mixed", stretch + shear + provot},
          {"triangles", "triangles", stretch + angular},
          {"anisotropic", "quads", stretch + R"(<shear kind="anisotropic" k="60")" + along + "/>" + angular}};
}

std::string preset_of(const Cloth& cloth, const std::string& time, const std::string& more = "") {
  return R"(<scene><body><sheet pattern=")" + cloth.pattern +
         R"(" cells="10 10" size="1 1"/><mass total="0.15"/><springs>)" + cloth.springs + "</springs>" + more +
         R"(<fix near="0 1 0"/><fix near="1 1 0"/></body>)" + time + "</scene>";
}

double total_energy(const Scene& scene) {
  return scene.kinetic_energy() + scene.elastic_energy() + scene.gravity_energy();
}

// Runs the scene; returns the largest excess of the energy over the initial one, relative to m g times the
// size.
double largest_gain(const presets::Loaded& scene, int steps) {
  const double start = total_energy(*scene.scene), unit = 0.15 * 9.81;
  double most = 0;
  for (int n = 1; n <= steps; ++n) {
    scene->step();
    if (n % 20 == 0) most = std::max(most, (total_energy(*scene.scene) - start) / unit);
  }
  return most;
}

TEST(AutomaticStep, stays_stable_on_every_cloth) {
  for (const bool damped : {false, true}) {
    for (const Cloth& cloth : cloths(damped)) {
      for (const char* scheme : {"symplectic", "verlet", "rk4"}) {
        SCOPED_TRACE(cloth.name + (damped ? ", damped, " : ", ") + scheme);
        const auto scene = presets::load(preset_of(cloth, std::string(R"(<time step="auto" integrator=")") +
                                                              scheme + R"(" duration="9"/>)"));
        EXPECT_TRUE(scene->automatic_step());
        EXPECT_LT(largest_gain(scene, 2000), 0.01);
        EXPECT_GT(scene->kinetic_energy(), 0);
      }
    }
  }
}

TEST(AutomaticStep, is_close_to_where_the_scene_becomes_unstable) {
  for (const char* scheme : {"symplectic", "verlet", "rk4"}) {
    const Cloth cloth = cloths(false).front();
    const auto scene =
        presets::load(preset_of(cloth, std::string(R"(<time integrator=")") + scheme + R"(" duration="1"/>)"));
    const std::string four = std::to_string(4 * scene->step_size());
    const auto fast = presets::load(
        preset_of(cloth, R"(<time step=")" + four + R"(" integrator=")" + scheme + R"(" duration="1"/>)"),
        {.guard = false});
    EXPECT_THROW(largest_gain(fast, 5000), Unstable) << scheme;
  }
}

TEST(AutomaticStep, is_refused_with_a_hint_where_no_step_is_stable) {
  for (const char* scheme : {"explicit", "midpoint"}) {
    for (const bool damped : {false, true}) { // springs do not damp rigid rotation
      const std::string refusal =
          refusal_of(preset_of(cloths(damped).front(), std::string(R"(<time step="auto" integrator=")") +
                                                           scheme + R"(" duration="1"/>)"));
      EXPECT_THAT(refusal, HasSubstr(std::string("no step is stable with the integrator '") + scheme));
      EXPECT_THAT(refusal, HasSubstr("| use symplectic, verlet or rk4, or add <viscosity>"));
    }
  }
  const std::string bare = R"(<scene><body><sheet cells="1 1" size="1 1"/><mass total="1"/></body>
      <time step="auto" duration="1"/></scene>)";
  EXPECT_THAT(refusal_of(bare), HasSubstr("nothing in the scene limits the step"));
}

TEST(AutomaticStep, of_schemes_that_need_viscosity_is_stable_with_it) {
  for (const char* scheme : {"explicit", "midpoint"}) {
    for (const char* viscosity : {R"(<viscosity value="15" per="body"/>)", R"(<viscosity value="0.1"/>)"}) {
      const auto scene = presets::load(preset_of(
          cloths(true).front(),
          std::string(R"(<time step="auto" integrator=")") + scheme + R"(" duration="1"/>)", viscosity));
      EXPECT_GT(scene->step_size(), 1e-5) << scheme;
      EXPECT_LT(largest_gain(scene, 2000), 0.01) << scheme;
    }
  }
}

TEST(Scene, of_two_runs_and_any_number_of_threads_is_the_same_to_the_last_bit) {
  const std::string xml = presets::cloth("mixed", 66, R"(<tear criterion="global-border" threshold="1e-5"/>)",
                                         R"(<time step="5e-5" integrator="rk4" duration="1"/>)");
  std::vector<std::uint64_t> hashes;
  for (const int threads : {1, 1, 2, 4}) {
    const auto scene = presets::load(xml, {.walk = false, .threads = threads});
    for (int n = 0; n < 20; ++n) scene->step();
    EXPECT_GT(scene->tears(), 0u);
    hashes.push_back(scene->hash());
  }
  for (std::uint64_t hash : hashes) EXPECT_EQ(hash, hashes.front());
}

TEST(Hash, sees_positions_velocities_and_links) {
  const auto scene = presets::load(presets::cloth("quads", 3));
  const std::uint64_t start = scene->hash();
  EXPECT_EQ(scene->hash(), start);
  EmbeddedMap& map = *scene.body().map;
  const Record x = map.position()[3], v = map.velocity()[3];
  map.position()[3].x = std::nextafter(x.x, 9);
  EXPECT_NE(scene->hash(), start);
  map.position()[3] = x;
  map.velocity()[3].z = 1e-300;
  EXPECT_NE(scene->hash(), start);
  map.velocity()[3] = v;
  EXPECT_EQ(scene->hash(), start);
  Dart inner;
  map.map().for_each_dart([&](Dart d) { inner = map.map().is_free(2, d) ? inner : d; });
  map.edit([&](Edit& edit) { unsew(edit, 2, inner); });
  EXPECT_NE(scene->hash(), start);
}

// A symplectic scheme without damping: the energy oscillates and does not drift.
TEST(Energy, of_an_undamped_symplectic_run_is_bounded) {
  const auto scene = presets::load(R"(<scene><body><sheet cells="6 6" size="1 1"/><mass total="0.15"/>
      <springs><stretch k="60"/><shear k="40"/><bend kind="provot" k="4"/></springs>
      <fix side="+y"/></body><time step="5e-4" duration="1"/></scene>)");
  const double start = total_energy(*scene.scene);
  std::vector<double> worst(4, 0); // of each quarter of the run
  for (std::size_t quarter = 0; quarter < 4; ++quarter)
    for (int n = 0; n < 5000; ++n) {
      scene->step();
      worst[quarter] = std::max(worst[quarter], std::abs(total_energy(*scene.scene) - start));
    }
  for (double each : worst) EXPECT_LT(each, 0.01 * 0.15 * 9.81);
}

TEST(Energy, of_free_fall_is_kept_and_viscosity_takes_what_it_should) {
  const auto falling = [](const std::string& viscosity) {
    return presets::load(R"(<scene><body><sheet cells="3 2" size="1 1"/><mass total="0.15"/>)" + viscosity +
                         R"(</body><time step="1e-3" integrator="rk4" duration="1"/></scene>)");
  };
  const auto free = falling("");
  for (int n = 0; n < 1000; ++n) free->step();
  EXPECT_NEAR(total_energy(*free.scene), 0, 1e-12);
  EXPECT_NEAR((free->momentum() - Vec3(0, 0, -9.81 * 0.15)).norm(), 0, 1e-12);
  const double rate = 0.3 / 0.15; // γ/m: v = −g/rate (1 − exp(−rate t))
  const auto slowed = falling(R"(<viscosity value="0.3" per="body"/>)");
  for (int n = 0; n < 1000; ++n) slowed->step();
  EXPECT_NEAR(slowed->momentum().z(), -0.15 * 9.81 / rate * (1 - std::exp(-rate)), 1e-12);
  const auto each = falling(R"(<viscosity value="0.025"/>)"); // 12 particles of 0.025 each: 0.3 in all
  for (int n = 0; n < 1000; ++n) each->step();
  EXPECT_LT(each->momentum().z(),
            slowed->momentum().z() * 0.9); // but lighter ones along the border are decelerated more
  EXPECT_GT(each->momentum().z(), -0.15 * 9.81);
}

// The state of all vertices is finite.
bool finite(const Scene& scene) {
  for (const auto& body : scene.bodies())
    for (const auto* column : {&body->map->position(), &body->map->velocity()})
      for (const Record& r : column->values())
        if (!std::isfinite(r.x + r.y + r.z)) return false;
  return true;
}

TEST(Explosion, is_stopped_and_leaves_the_state_before_it) {
  for (const char* scheme : {"symplectic", "explicit", "verlet", "midpoint", "rk4"}) {
    for (const auto& [step, guard] : {std::pair("0.02", false), {"0.1", false}, {"10", false}, {"1e4", true}}) {
      SCOPED_TRACE(std::string(scheme) + ", " + step);
      const auto scene =
          presets::load(preset_of(cloths(true)[2], std::string(R"(<time step=")") + step + R"(" integrator=")" +
                                                       scheme + R"(" duration="1e5"/>)"),
                        {.guard = guard});
      std::uint64_t before = 0;
      long done = 0;
      try {
        for (int n = 0; n < 5000; ++n) {
          before = scene->hash();
          done = scene->steps_done();
          scene->step();
        }
        ADD_FAILURE() << "it was not stopped";
      } catch (const Unstable& unstable) {
        EXPECT_EQ(unstable.code, Exit::Unstable);
        EXPECT_EQ(static_cast<int>(unstable.code), 76);
        EXPECT_THAT(unstable.what(), HasSubstr("stopped as unstable at"));
        EXPECT_THAT(unstable.what(), HasSubstr("body 'body'"));
        EXPECT_THAT(unstable.hint, testing::AnyOf(HasSubstr("steps up to"), HasSubstr("use symplectic")));
      }
      EXPECT_TRUE(finite(*scene.scene));
      EXPECT_EQ(scene->hash(), before);
      EXPECT_EQ(scene->steps_done(), done);
    }
  }
}

TEST(Explosion, of_one_body_moves_none_of_the_others) {
  const auto body = [](const std::string& name, const std::string& k) {
    return R"(<body name=")" + name +
           R"("><sheet cells="4 4" size="1 1"/><mass total="0.1"/><springs><stretch k=")" + k +
           R"("/></springs><fix near="0 0 0"/></body>)";
  };
  const auto scene = presets::load("<scene>" + body("calm", "1") + body("wild", "1e9") +
                                       R"(<time step="1e-3" duration="1"/></scene>)",
                                   {.guard = false});
  std::uint64_t before = 0;
  const auto run = [&] {
    for (int n = 0; n < 1000; ++n) {
      before = scene->hash();
      scene->step();
    }
  };
  EXPECT_THROW(run(), Unstable);
  EXPECT_EQ(scene->hash(), before);
}

TEST(LeftOut, says_where_an_interaction_adds_nothing) {
  const auto scene = presets::load(presets::cloth("triangles", 3));
  EXPECT_THAT(scene.body().notes, Contains(HasSubstr("shear was left out")));
  EXPECT_THAT(scene.body().left_out, Contains(HasSubstr("shear was left out")));
  for (const auto& each : scene.body().interactions) EXPECT_THAT(each->name, Not(HasSubstr("shear")));
  const auto quads = presets::load(presets::cloth("quads", 3));
  EXPECT_THAT(quads.body().notes, Not(Contains(HasSubstr("shear"))));
}

bool has_column(const Body& body, const std::string& name) {
  for (const auto& column : body.map->columns())
    if (column->name() == name) return true;
  return false;
}

TEST(LeftOut, is_all_that_tearing_needs_where_nothing_tears) {
  const auto still = presets::load(presets::cloth("quads", 3));
  EXPECT_EQ(still.body().border, nullptr);
  EXPECT_FALSE(has_column(still.body(), "born border"));
  EXPECT_TRUE(still.body().tear_laws.empty());
  EXPECT_TRUE(still.body().corner_force.empty());
  EXPECT_TRUE(still.body().program->elementary().empty());
  EXPECT_FALSE(still.body().map->uses(EdgeOfVolume));
  EXPECT_THAT(still.body().left_out, Contains(HasSubstr("has no <tear>")));
  const auto angular = presets::load(presets::cloth("triangles", 3, "", R"(<time step="1e-3" duration="1"/>)",
                                                    R"(<bend kind="angular" k="1e-4"/>)"));
  EXPECT_TRUE(angular.body().map->uses(EdgeOfVolume));
  const auto tears =
      presets::load(presets::cloth("quads", 3, R"(<tear criterion="global-border" threshold="1"/>)"));
  EXPECT_TRUE(has_column(tears.body(), "born border"));
  EXPECT_TRUE(
      tears.body().program->elementary().empty()); // the global criterion needs no forces of single springs
  EXPECT_TRUE(tears.body().corner_force.empty());
  const auto atomic =
      presets::load(presets::cloth("quads", 3, R"(<tear criterion="atomic-border" threshold="1"/>)"));
  EXPECT_FALSE(atomic.body().program->elementary().empty());
}

TEST(LeftOut, is_the_array_of_drags_where_the_body_shares_one) {
  const auto shared = presets::load(presets::cloth("quads", 3)); // per="body"
  EXPECT_EQ(shared.body().drag, nullptr);
  EXPECT_FALSE(has_column(shared.body(), "corner viscosity"));
  EXPECT_EQ(shared.body().program->drag_rate(), nullptr);
  EXPECT_NEAR(shared.body().uniform_drag, 1, 1e-14); // 0.1 N·s/m over 0.1 kg
  const auto none =
      presets::load(preset_of(cloths(true)[0], R"(<time duration="1"/>)", R"(<viscosity value="0"/>)"));
  EXPECT_EQ(none.body().drag, nullptr);
  EXPECT_EQ(none.body().uniform_drag, 0);
  const auto each =
      presets::load(preset_of(cloths(true)[0], R"(<time duration="1"/>)", R"(<viscosity value="0.1"/>)"));
  EXPECT_TRUE(has_column(each.body(), "corner viscosity"));
  EXPECT_NE(each.body().program->drag_rate(), nullptr);
}

TEST(LeftOut, are_prescribed_motions_where_there_are_none) {
  const auto scene = presets::load(R"(<scene><body><sheet cells="1 1" size="1 1"/><mass total="1"/></body>
      <time step="1" duration="1"/></scene>)");
  EXPECT_FALSE(has_column(scene.body(), "prescribed motions"));
  EXPECT_THAT(scene.body().left_out, Contains(HasSubstr("no fix and no drive")));
}

std::string springs_of(const std::string& pattern, const std::string& poisson) {
  return R"(<scene><body><sheet pattern=")" + pattern +
         R"(" cells="2 2" size="1 1"/><mass total="1"/><springs young="1e5" poisson=")" + poisson +
         R"(" thickness="1e-3"><stretch/></springs></body><time duration="1"/></scene>)";
}

TEST(Notes, say_how_far_stiffness_by_formula_goes_on_the_cells_there_are) {
  const auto note = [](const std::string& pattern, const std::string& poisson) {
    std::string all;
    const auto scene = presets::load(springs_of(pattern, poisson));
    for (const std::string& each : scene.body().notes) all += each + "\n";
    return all;
  };
  EXPECT_EQ(note("quads", "0.3333333333"), "");
  EXPECT_THAT(note("quads", "0"), HasSubstr("poisson 0.5 and young 7.5e+04")); // ν_eff = 1/2, E_eff = 3/4 E
  EXPECT_THAT(note("triangles", "0"), HasSubstr("equilateral"));
  EXPECT_THAT(note("triangles", "0"), Not(HasSubstr("rectangles")));
  EXPECT_THAT(note("mixed", "0.3333333333"), HasSubstr("equilateral"));
}

TEST(Scene, is_refused_where_it_cannot_be_built) {
  const std::string mass = R"(<mass total="1"/>)", time = R"(<time step="1" duration="1"/>)";
  const auto scene = [&](const std::string& body) {
    return "<scene><body>" + body + "</body>" + time + "</scene>";
  };
  EXPECT_THAT(refusal_of(scene(R"(<sheet cells="20000 20000" size="1 1"/>)" + mass)),
              HasSubstr("are too many for one body"));
  EXPECT_THAT(refusal_of(scene(R"(<sheet cells="1 1" corners="0 0 0 0 0 0 0 0 0 0 0 0"/>)" + mass)),
              HasSubstr("no area"));
  EXPECT_THAT(refusal_of(scene(R"(<sheet cells="1 1"/>)" + mass)), HasSubstr("neither a size nor corners"));
  EXPECT_THAT(refusal_of(scene(R"(<sheet cells="2 1" size="1 1" close="loop"/>)" + mass)),
              HasSubstr("at least 3 cells"));
  EXPECT_THAT(refusal_of(scene(R"(<sheet cells="1 1" size="1 1"/><mass density="2"/>)")),
              HasSubstr("thickness"));
  const std::string body = R"(<body><sheet cells="1 1" size="1 1"/>)" + mass + "</body>";
  EXPECT_THAT(refusal_of("<scene>" + body + body + time + "</scene>"),
              HasSubstr("two bodies are called 'body'"));
  EXPECT_THAT(refusal_of(scene(R"(<sheet cells="1 1" size="1 1"/>)" + mass +
                               R"(<springs cumulated="yes"><stretch k="1"/></springs>)" +
                               R"(<tear criterion="atomic-border" threshold="1"/>)")),
              HasSubstr("merges their springs"));
}

TEST(Mass, is_what_the_preset_says) {
  const auto total = presets::load(presets::cloth("mixed", 7));
  EXPECT_NEAR(total->mass(), 0.1, 1e-15);
  const auto density = presets::load(R"(<scene><body><sheet pattern="triangles" cells="3 4" size="2 0.5"/>
      <mass density="300" thickness="0.002"/></body><time step="1" duration="1"/></scene>)");
  EXPECT_NEAR(density->mass(), 300 * 0.002, 1e-14);
}

} // namespace
} // namespace rend::scene_test
