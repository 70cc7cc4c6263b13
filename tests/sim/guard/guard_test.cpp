// The guard, against runs without it: results with small steps, energy that was supplied, and conserved
// quantities.
#include "sim/build/build_scene.h"
#include "sim/guard/guard.h"

#include "render/picture/scene_preset.h"
#include "sim/presets.h"
#include "tests/test_paths.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <memory>

namespace rend::guard_test {
namespace {

using testing::HasSubstr;

constexpr StepStage stages[] = {StepStage::Forces, StepStage::Loads, StepStage::Integration,
                                StepStage::Contact};

std::string time_of(const std::string& scheme, double step) {
  return fmt::format(R"(<time integrator="{}" step="{}" duration="1"/>)", scheme, step);
}
std::string automatic(const std::string& scheme) {
  return R"(<time integrator=")" + scheme + R"(" step="auto" duration="1"/>)";
}

std::string cloth(const std::string& time, const std::string& more = "", int cells = 6) {
  return presets::cloth("quads", cells, more, time, "");
}
std::string bar(const std::string& time, const std::string& more = "") {
  return R"(<scene><body><bar pattern="tetrahedra" cells="6 2 2" size="1 0.3 0.3"/><mass total="1"/>)"
         R"(<elasticity model="corotational" young="1e4" poisson="0.3"/><viscosity value="0.5" per="body"/>)"
         R"(<fix side="-x"/>)" +
         more + "</body>" + time + "</scene>";
}

void run(const presets::Loaded& scene, double until) {
  while (scene->time() < until - 1e-9) scene->step();
}

// The RMS distance of the vertices of two scenes [m].
double rms_distance(const presets::Loaded& a, const presets::Loaded& b) {
  const auto &x = a.body().map->position().values(), &y = b.body().map->position().values();
  double sum = 0;
  for (std::size_t i = 0; i < x.size(); ++i) sum += (x[i].vec() - y[i].vec()).squaredNorm();
  return std::sqrt(sum / static_cast<double>(x.size()));
}

bool finite(const presets::Loaded& scene) {
  for (const Record& x : scene.body().map->position().values())
    if (!x.vec().allFinite()) return false;
  for (const Record& v : scene.body().map->velocity().values())
    if (!v.vec().allFinite()) return false;
  return true;
}

// Four times the automatic step is certainly too large. In substeps that are accepted, which may be twice as
// long where nothing grows yet, the error is that of the scheme at twice its automatic step: 2^order times as
// large.
TEST(Guard, goes_on_with_a_step_that_is_too_large_near_where_small_steps_lead) {
  for (const std::string name : {"cloth", "bar"}) {
    for (const char* scheme : {"symplectic", "verlet", "rk4"}) {
      for (const double above : {4.0, 8.0}) {
        SCOPED_TRACE(fmt::format("{}, {}, {}", name, scheme, above));
        const auto scene_of = [&](const std::string& time) {
          return name == "cloth" ? cloth(time) : bar(time);
        };
        const double step = presets::load(scene_of(automatic(scheme)))->step_size();
        const auto large = presets::load(scene_of(time_of(scheme, above * step)));
        const auto small = presets::load(scene_of(time_of(scheme, above * step / 64)));
        const auto none = presets::load(scene_of(time_of(scheme, above * step / 64)), {.guard = false});
        const double end = 60 * above * step;
        run(large, end);
        run(small, end);
        run(none, end);
        EXPECT_GT(large->guard().rejected, 0);
        EXPECT_EQ(small->guard().rejected, 0);
        EXPECT_EQ(small->hash(), none->hash());
        const auto alone = presets::load(scene_of(time_of(scheme, step)), {.guard = false});
        run(alone, end);
        const double longer = std::pow(2, find_scheme(scheme)->order);
        EXPECT_LT(rms_distance(large, small), longer * rms_distance(alone, small)) << large->guard().rejected;
        EXPECT_GT(rms_distance(alone, small), 0);
      }
    }
  }
}

TEST(Guard, survives_a_number_that_is_not_finite_at_any_stage_once) {
  const std::string load = R"(<load side="-x" force="0 0.1 0"/>)";
  for (const char* scheme : {"symplectic", "explicit", "verlet", "midpoint", "rk4", "implicit"}) {
    for (const StepStage stage : stages) {
      SCOPED_TRACE(std::string(scheme) + ", " + name_of(stage));
      SceneOptions options;
      options.fault = Fault{stage, 21, false};
      const auto faulty = presets::load(cloth(time_of(scheme, 2e-4), load), options);
      const auto sound = presets::load(cloth(time_of(scheme, 2e-4), load));
      for (int n = 0; n < 60; ++n) {
        faulty->step();
        sound->step();
        ASSERT_TRUE(finite(faulty));
        ASSERT_EQ(faulty->steps_done(), n + 1);
      }
      EXPECT_LT(rms_distance(faulty, sound), 1e-5);
      EXPECT_EQ(sound->guard().rejected, 0);
      const bool halves_itself =
          std::string(scheme) == "implicit" && stage != StepStage::Integration && stage != StepStage::Contact;
      EXPECT_EQ(faulty->guard().rejected, halves_itself ? 0 : 1);
    }
  }
}

TEST(Guard, stops_where_it_lasts_and_names_stage_step_and_vertex) {
  const std::string load = R"(<load side="-x" force="0 0.1 0"/>)";
  for (const char* scheme : {"symplectic", "rk4"}) {
    for (const StepStage stage : stages) {
      SCOPED_TRACE(std::string(scheme) + ", " + name_of(stage));
      SceneOptions options;
      options.fault = Fault{stage, 70, true};
      const auto faulty = presets::load(cloth(time_of(scheme, 2e-4), load), options);
      for (int n = 0; n < 70; ++n) faulty->step();
      const std::uint64_t before = faulty->hash();
      try {
        faulty->step();
        ADD_FAILURE() << "it went on";
      } catch (const Unstable& error) {
        EXPECT_THAT(error.what(), HasSubstr("0.014 s (step 70 of 0.0002 s)"));
        EXPECT_THAT(error.what(), HasSubstr(std::string("after ") + name_of(stage) + ", vertex 0, near ("));
      }
      EXPECT_EQ(faulty->hash(), before);
      EXPECT_EQ(faulty->steps_done(), 70);
      EXPECT_EQ(faulty->guard().most_substeps, 1);
    }
  }
}

// Fast motion with a physical cause is not rejected.
TEST(Guard, rejects_no_step_of_what_is_given_energy) {
  const std::string sheet = R"(<sheet cells="6 6" size="1 1"/><mass total="0.1"/><springs><stretch k="60"/>)"
                            R"(<shear k="40"/></springs>)";
  const auto body = [&](const std::string& more, const std::string& world = "") {
    return "<scene>" + world + "<body>" + sheet + more + "</body>";
  };
  const std::vector<std::pair<std::string, std::string>> scenes{
      {"free fall", body("")},
      {"a fast drive", body(R"(<drive side="-x" velocity="100 0 0"/>)")},
      {"a fast turn", body(R"(<drive side="-x" rotate="0 0 1 20000"/>)")},
      {"a jump", body(R"(<drive side="-x" displacement="-0.5 0 0" from="0.002" until="0.002"/>)")},
      {"a load", body(R"(<fix side="-x"/><load side="+x" force="30 0 3"/>)")},
      {"a growing load", body(R"(<fix side="-x"/><load side="+x" force="30 0 3" from="0.003" until="0.01"/>)")},
      {"wind", body(R"(<fix side="-x"/>)", R"(<world><wind velocity="3 0 20"/></world>)")},
      {"a heavy sphere",
       body(R"(<fix side="-x"/><fix side="+x"/><contact with="obstacles"/>)",
            R"(<world><sphere centre="0.5 0.5 0.21" radius="0.2" mass="10" velocity="0 0 -5"/></world>)")},
      {"a sphere that goes through",
       body(R"(<fix side="-x"/><contact with="obstacles"/>)",
            R"(<world><sphere centre="0.5 0.5 0.3" radius="0.2" velocity="0 0 -30"/></world>)")},
      {"a hard floor", body(R"(<contact/>)", R"(<world><floor z="-0.002"/></world>)")}};
  for (const auto& [name, text] : scenes) {
    for (const char* scheme : {"symplectic", "verlet", "rk4"}) {
      SCOPED_TRACE(name + ", " + scheme);
      const auto scene = presets::load(text + time_of(scheme, 5e-4) + "</scene>");
      const auto free = presets::load(text + time_of(scheme, 5e-4) + "</scene>", {.guard = false});
      for (int n = 0; n < 300; ++n) {
        scene->step();
        free->step();
      }
      EXPECT_EQ(scene->guard().rejected, 0);
      EXPECT_EQ(scene->hash(), free->hash());
      EXPECT_LT(scene->guard().energy_tests, 20);
    }
  }
}

TEST(Guard, rejects_no_step_of_shipped_presets) {
  namespace fs = std::filesystem;
  int seen = 0;
  for (const auto& entry : fs::recursive_directory_iterator(fs::path(test::source_root) / "presets")) {
    if (entry.path().extension() != ".xml") continue;
    const auto preset = load_scene(entry.path());
    Scene scene(read_scene(*preset, scene_pictures()), {});
    std::size_t vertices = 0;
    for (const auto& body : scene.bodies()) vertices += body->vertices();
    if (scene.scheme().solves || vertices > 1500) continue; // to limit the run time
    for (int n = 0; n < 50; ++n) scene.step();
    EXPECT_EQ(scene.guard().rejected, 0) << entry.path();
    ++seen;
  }
  EXPECT_GT(seen, 20);
}

TEST(Guard, does_the_same_on_any_number_of_threads_and_whatever_is_looked_at) {
  const auto hash = [](int threads, bool looks) {
    SceneOptions options;
    options.threads = threads;
    const double step = presets::load(cloth(automatic("symplectic"), "", 70))->step_size();
    const auto scene = presets::load(cloth(time_of("symplectic", 5 * step), "", 70), options);
    for (int n = 0; n < 50; ++n) {
      scene->step();
      if (looks && n % 7 == 0) {
        scene->check_sound();
        scene->elastic_energy();
      }
    }
    EXPECT_GT(scene->guard().rejected, 0);
    return scene->hash();
  };
  const std::uint64_t one = hash(1, false);
  EXPECT_EQ(hash(1, true), one);
  EXPECT_EQ(hash(2, false), one);
  EXPECT_EQ(hash(4, false), one);
}

// A rollback does not undo earlier tears: substeps start after the last one.
TEST(Guard, leaves_what_tore_before_as_it_tore) {
  const std::string law = R"(<tear criterion="global-border" threshold="0.5"/>)";
  const double step = presets::load(cloth(automatic("symplectic"), law))->step_size();
  const auto guarded = presets::load(cloth(time_of("symplectic", 5 * step), law));
  const auto free = presets::load(cloth(time_of("symplectic", 5 * step), law), {.guard = false});
  while (guarded->guard().rejected == 0 && guarded->steps_done() < 2000) guarded->step();
  ASSERT_GT(guarded->guard().rejected, 0);
  const std::vector<TearEvent>& with = guarded.body().events;
  for (long n = 0; n < guarded->steps_done(); ++n) {
    try {
      free->step();
    } catch (const Unstable&) {
      break;
    }
  }
  const std::vector<TearEvent>& without = free.body().events;
  const long first = guarded->steps_done() - guarded->guard().rejected;
  for (std::size_t e = 0; e < with.size() && with[e].step < first; ++e) {
    ASSERT_LT(e, without.size());
    EXPECT_EQ(with[e].step, without[e].step);
    EXPECT_EQ(with[e].value, without[e].value);
  }
  for (std::size_t e = 1; e < with.size(); ++e) EXPECT_LE(with[e - 1].step, with[e].step);
  for (int n = 0; n < 100; ++n) guarded->step();
  EXPECT_TRUE(finite(guarded));
}

// Without viscosity the scheme produces energy at any step. The guard allows a factor of four where it checks;
// it checks only where speeds have grown, and elastic energy may grow alone until then: the bound is twice as
// much.
TEST(Guard, lets_no_scheme_make_many_times_the_energy_that_there_was) {
  const std::string text =
      R"(<scene><world gravity="0 0 0"/><body><sheet cells="4 4" size="1 1"/><mass total="0.1"/>)"
      R"(<springs><stretch k="60"/><shear k="40"/></springs></body>)";
  const auto scene = presets::load(text + time_of("explicit", 1e-3) + "</scene>");
  for (Record& v : scene.body().map->velocity().values()) v = Record(0, 0, 0);
  scene.body().map->velocity()[3] = Record(1, 0, 0);
  const double start = scene->kinetic_energy() + scene->elastic_energy();
  double most = 0;
  bool stopped = false;
  try {
    for (int n = 0; n < 3000; ++n) {
      scene->step();
      if (scene->steps_done() % 64 == 0)
        most = std::max(most, scene->kinetic_energy() + scene->elastic_energy());
    }
  } catch (const Unstable& error) {
    stopped = true;
    EXPECT_THAT(error.what(), HasSubstr("energy"));
    EXPECT_THAT(error.hint, HasSubstr("use symplectic, verlet or rk4"));
  }
  EXPECT_GT(scene->guard().rejected, 0);
  EXPECT_LT(most, 8 * start) << stopped;
}

TEST(Guard, does_not_undo_what_somebody_set_between_steps) {
  const auto scene = presets::load(cloth(time_of("symplectic", 1e-3)));
  for (int n = 0; n < 30; ++n) scene->step();
  for (Record& v : scene.body().map->velocity().values()) v = Record(v.x, v.y, v.z + 50);
  const double before = scene.body().map->position()[20].z;
  for (int n = 0; n < 3; ++n) scene->step();
  EXPECT_GT(scene.body().map->position()[20].z, before + 0.1);
  EXPECT_EQ(scene->guard().rejected, 0);
}

TEST(Guard, costs_no_memory_where_it_is_off) {
  EXPECT_EQ(presets::load(cloth(automatic("rk4")), {.guard = false})->guard_bytes(), 0U);
  const auto scene = presets::load(cloth(automatic("rk4")));
  for (int n = 0; n < 3; ++n) scene->step();
  EXPECT_EQ(scene->guard_bytes(), 49 * 2 * sizeof(Record)); // positions and velocities
}

} // namespace
} // namespace rend::guard_test
