// The energy account against work that is known: from mechanics, from conserved quantities, and from itself
// where the same motion is reached in another way.
#include "sim/base/archive.h"
#include "sim/presets.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace rend::energy_account_test {
namespace {

using presets::load;
using presets::Loaded;

const std::string weightless = R"(<world gravity="0 0 0"/>)";

std::string time_of(const std::string& scheme, const std::string& step) {
  return fmt::format(R"(<time integrator="{}" step="{}" duration="1"/>)", scheme, step);
}

std::string bar(const std::string& acts, const std::string& world, const std::string& time,
                const std::string& model = "corotational") {
  return R"(<scene><body><bar pattern="tetrahedra" cells="4 2 2" size="1 0.4 0.4"/><mass total="2"/>)"
         R"(<elasticity model=")" +
         model + R"(" young="1e4" poisson="0.3"/>)" + acts + "</body>" + world + time + "</scene>";
}

void run(const Loaded& scene, double until) {
  while (scene->time() < until - 1e-9) scene->step();
}

double energy_of(const EnergyState& e) {
  return e.kinetic + e.elastic + e.gravity;
}

// F = 3 N on 2 kg, free: x = ½ a t², in symplectic steps ½ a t (t + h); the work is F x.
TEST(EnergyAccount, a_constant_force_does_force_times_way) {
  const Loaded scene =
      load(bar(R"(<load side="+x" force="0 3 0"/>)", weightless, time_of("symplectic", "1e-3")));
  run(scene, 0.5);
  const EnergyFigures e = scene->energy();
  const double momentum = scene->momentum().y(); // exact: F t
  EXPECT_NEAR(momentum, 1.5, 1e-12);
  double way = 0, mass = 0; // of the loaded side, on average over its shares
  const Body& body = scene.body();
  const Record* load = body.load;
  for (std::size_t i = 0; i < body.vertices(); ++i) {
    way += load[i].y * (body.map->position().values()[i].y - body.map->rest().values()[i].y);
    mass += load[i].y;
  }
  EXPECT_NEAR(mass, 3, 1e-12);
  EXPECT_NEAR(e.now.work.loads, way, 1e-9 * way);
  EXPECT_LT(e.balance, 2e-3 * e.scale);
}

// All vertices are turned at ω: the drive gives ½ I ω² at once, and nothing later.
TEST(EnergyAccount, a_drive_that_starts_gives_the_kinetic_energy) {
  const Loaded scene = load(bar(R"(<drive box="-9 -9 -9 9 9 9" rotate="0 0 1 90" from="0.0105"/>)", weightless,
                                time_of("symplectic", "1e-3")));
  run(scene, 0.3);
  const EnergyFigures e = scene->energy();
  EXPECT_GT(e.now.kinetic, 0.1);
  EXPECT_NEAR(e.now.work.drives, e.now.kinetic, 1e-9 * e.now.kinetic);
  EXPECT_EQ(e.now.work.loads, 0);
}

// Pulled so slowly that it hardly moves: what the drive does is in the springs.
TEST(EnergyAccount, a_drive_that_pulls_gives_what_is_stored) {
  for (const char* scheme : {"symplectic", "verlet", "rk4", "midpoint"}) {
    SCOPED_TRACE(scheme);
    const Loaded scene = load(
        bar(R"(<fix side="-x"/><drive side="+x" velocity="0.2 0.1 0"/>)", weightless, time_of(scheme, "5e-4")));
    run(scene, 0.5);
    const EnergyFigures e = scene->energy();
    EXPECT_GT(e.now.work.drives, 0.5);
    EXPECT_NEAR(energy_of(e.now), e.now.work.drives, 2e-3 * e.scale);
    EXPECT_LT(e.gained, 2e-3 * e.scale);
  }
}

// Of second order: a sixteenth of the error with a fourth of the step.
TEST(EnergyAccount, converges_with_the_step) {
  const auto error = [](double step) {
    const Loaded scene = load(bar(R"(<fix side="-x"/><drive side="+x" velocity="0 0 0.4" until="0.21"/>)",
                                  weightless, time_of("verlet", fmt::format("{}", step))));
    run(scene, 0.4);
    const EnergyFigures e = scene->energy();
    return (e.gained + e.dissipated) / e.scale;
  };
  const double coarse = error(1e-3), fine = error(2.5e-4);
  EXPECT_LT(coarse, 1e-3);
  EXPECT_LT(fine, coarse / 8);
}

// Near its limit K + U swings by a factor of 19; what symplectic Euler keeps is kept to round-off where forces
// are linear.
TEST(EnergyAccount, symplectic_keeps_its_shadow_near_the_limit) {
  const Loaded scene = load(bar(R"(<fix side="-x"/><load side="+x" force="0 0 1"/>)", weightless,
                                time_of("symplectic", "auto"), "linear"));
  run(scene, 0.5);
  const EnergyFigures e = scene->energy();
  EXPECT_GT(e.now.work.loads, 0);
  EXPECT_LT(std::abs(e.now.balance()), 1e-10 * e.scale);
}

// Falls, hits the floor, comes to rest: contact takes what gravity gave, and then nothing any more.
TEST(EnergyAccount, the_floor_takes_what_gravity_gave) {
  const Loaded scene = load(
      bar(R"(<viscosity value="6" per="body"/><place translate="0 0 0.3"/><contact with="floor"/>)",
          R"(<world><floor z="0"/></world>)", R"(<time integrator="symplectic" step="5e-4" duration="9"/>)"));
  const double before = scene->gravity_energy();
  run(scene, 6);
  const EnergyFigures at_rest = scene->energy();
  EXPECT_LT(at_rest.now.kinetic, 1e-8);
  const double taken = at_rest.now.work.contact.lost();
  EXPECT_GT(taken, 0);
  EXPECT_LT(at_rest.gained, 1e-2 * at_rest.scale);
  EXPECT_NEAR(before - energy_of(at_rest.now), at_rest.dissipated, 1e-2 * at_rest.scale);
  EXPECT_LT(taken, at_rest.dissipated);
  run(scene, 8);
  EXPECT_NEAR(scene->energy().now.work.contact.lost(), taken, 1e-6 * at_rest.scale);
}

// A load that grows to F in T does ∫ F t/T v dt.
TEST(EnergyAccount, a_growing_load_does_its_integral) {
  const Loaded scene =
      load(bar(R"(<load side="+x" force="0 3 0" until="0.5"/>)", weightless, time_of("rk4", "1e-3"), "linear"));
  run(scene, 0.4);
  const EnergyFigures e = scene->energy();
  EXPECT_NEAR(energy_of(e.now), e.now.work.loads, 1e-5 * e.scale);
}

// A ball with mass falls on a sheet: what one gets is the other's.
TEST(EnergyAccount, a_falling_sphere_and_a_sheet_share_one_account) {
  const Loaded scene =
      load(R"(<scene><body><sheet pattern="crossed" cells="8 8" size="1 1"/><mass total="0.2"/>)"
           R"(<springs><stretch k="300"/><shear kind="isotropic" k="100"/></springs>)"
           R"(<fix side="-x"/><fix side="+x"/>)"
           R"(<contact with="obstacles"/></body>)"
           R"(<world><sphere centre="0.5 0.5 0.3" radius="0.15" mass="0.3"/></world>)"
           R"(<time integrator="symplectic" step="2e-4" duration="1"/></scene>)");
  run(scene, 0.6);
  const EnergyFigures e = scene->energy();
  EXPECT_GT(e.now.work.contact.lost(), 0);
  EXPECT_LT(e.gained, 1e-2 * e.scale);
  EXPECT_NEAR(e.dissipated, e.now.work.contact.lost(), 1e-2 * e.scale);
}

// A step that is redone is accounted for once.
TEST(EnergyAccount, returns_with_a_rollback) {
  const std::string xml =
      bar(R"(<fix side="-x"/><drive side="+x" velocity="0.2 0.1 0"/><load side="+y" force="0 2 1"/>)",
          weightless, time_of("symplectic", "5e-4"));
  SceneOptions options;
  options.fault = Fault{StepStage::Integration, 101, false};
  const Loaded faulty = load(xml, options), sound = load(xml);
  run(faulty, 0.2);
  run(sound, 0.2);
  EXPECT_EQ(faulty->guard().rejected, 1);
  const EnergyFigures a = faulty->energy(), b = sound->energy();
  EXPECT_NEAR(a.now.work.drives, b.now.work.drives, 1e-4 * b.scale);
  EXPECT_NEAR(a.now.work.loads, b.now.work.loads, 1e-4 * b.scale);
}

TEST(EnergyAccount, lives_in_checkpoints_and_asking_changes_nothing) {
  const std::string xml =
      bar(R"(<fix side="-x"/><drive side="+x" velocity="0.2 0.1 0"/><load side="+y" pressure="20"/>)",
          R"(<world gravity="0 0 -2"><wind velocity="1 2 0"/></world>)", time_of("symplectic", "5e-4"));
  const Loaded whole = load(xml), first = load(xml), second = load(xml);
  run(whole, 0.2);
  for (int n = 0; n < 200; ++n) {
    first->step();
    first->energy();
  }
  Archive written;
  first->store(written);
  Archive read(std::span<const std::uint8_t>(written.bytes()));
  second->store(read);
  run(second, 0.2);
  EXPECT_EQ(second->hash(), whole->hash());
  const EnergyFigures a = second->energy(), b = whole->energy();
  EXPECT_EQ(a.now.work.drives, b.now.work.drives);
  EXPECT_EQ(a.now.work.loads, b.now.work.loads);
  EXPECT_EQ(a.dissipated, b.dissipated);
  EXPECT_EQ(a.gained, b.gained);
  EXPECT_EQ(a.scale, b.scale);
}

// Vertices that the floor and a sphere both move have two entries each.
TEST(EnergyAccount, is_read_back_where_all_of_a_sheet_lies_on_the_floor_below_a_sphere) {
  const std::string xml =
      R"(<scene><body><sheet cells="4 4" size="1 1"/><place translate="0 0 0.002"/><mass total="0.2"/>)"
      R"(<springs><stretch k="300"/></springs><contact with="obstacles"/></body>)"
      R"(<world><floor z="0"/><sphere centre="0.5 0.5 0.9" radius="0.89" mass="3"/></world>)"
      R"(<time integrator="symplectic" step="1e-3" duration="1"/></scene>)";
  const Loaded scene = load(xml);
  for (int n = 0; n < 200; ++n) {
    scene->step();
    const Loaded other = load(xml);
    Archive written;
    scene->store(written);
    Archive read(std::span<const std::uint8_t>(written.bytes()));
    ASSERT_NO_THROW(other->store(read)) << n;
    ASSERT_EQ(other->energy().now.work.contact.lost(), scene->energy().now.work.contact.lost()) << n;
  }
}

// A separation takes nothing away; a deletion takes its weight with it, which is neither lost nor gained.
TEST(EnergyAccount, deleted_elements_take_their_potential_with_them) {
  const std::string sheet =
      R"(<scene><body><sheet cells="6 6" size="1 1"/><place rotate="90 0 0" translate="0 0 -5"/>)"
      R"(<mass total="2"/><springs><stretch k="60"/></springs><fix side="+z"/>)"
      R"(<tear criterion="atomic-spring" kind="stretch" threshold="0.5" change="delete-element"/></body>)"
      R"(<time integrator="symplectic" step="5e-4" duration="1"/></scene>)";
  const Loaded scene = load(sheet);
  scene->step();
  const double mass = scene->mass();
  run(scene, 0.5);
  const EnergyFigures e = scene->energy();
  ASSERT_LT(scene->mass(), 0.9 * mass);
  EXPECT_GT(e.now.work.changes, 0); // below 0 m their potential was negative
  EXPECT_LT(e.gained, 1e-2 * e.scale);
}

// Explicit Euler without damping gains energy in every step: the account tells how much.
// A run that gained more than a tenth is refused.
TEST(EnergyAccount, tells_what_a_scheme_gains) {
  const auto loaded_bar = [](const std::string& step) {
    Loaded scene = load(bar(R"(<fix side="-x"/><load side="+x" force="0 0 1"/>)", weightless,
                            time_of("explicit", step), "linear"),
                        {.guard = false});
    run(scene, 0.5);
    return scene;
  };
  const Loaded large = loaded_bar("2e-4"), small = loaded_bar("1e-6");
  const EnergyFigures e = large->energy();
  EXPECT_NEAR(e.balance, energy_of(e.now) - e.now.work.sum(), 0.05 * e.balance + 1e-12);
  EXPECT_GT(e.gained_share(), 1.5 * most_gained_share);
  EXPECT_THROW(large->check_account(), Unstable);
  EXPECT_LT(small->energy().gained_share(), 0.5 * most_gained_share);
  EXPECT_NO_THROW(small->check_account());
}

} // namespace
} // namespace rend::energy_account_test
