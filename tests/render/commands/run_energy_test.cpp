// The energy account as commands print it, and the exit code of a run that gains energy without a cause.
#include "tests/render/commands/program_run.h"

#include <gmock/gmock.h>

#include <cmath>

namespace rend::run_energy_test {
namespace {

using program::Outcome;
using program::TestFolder;
using testing::HasSubstr;

std::string bar(const std::string& time) {
  return R"(<scene name="bar"><body><bar pattern="hexahedra" cells="4 2 2" size="1 0.3 0.3"/><mass total="1"/>)"
         R"(<elasticity model="corotational" young="1e4" poisson="0.3"/><fix side="-x"/>)"
         R"(<drive side="+x" velocity="0 0 0.2"/></body><world gravity="0 0 -5"/>)" +
         time + "</scene>";
}

TEST(RunEnergy, adds_up_in_json_and_in_the_diagnostics) {
  const TestFolder place;
  // rk4: what it keeps is K + U itself
  place.write("bar.xml", bar(R"(<time integrator="rk4" step="auto" duration="0.5"/>)"));
  const Outcome run = place.rend("run bar.xml --json -q --diagnostics bar.csv --fps 10");
  ASSERT_EQ(run.code, 0) << run.err;
  const auto e = run.json()["energy"];
  const auto number = [&](const char* key) { return e[key].get<double>(); };
  const double now = number("kinetic") + number("elastic") + number("gravity");
  const double drives = e["work_of"]["drives"].get<double>();
  EXPECT_EQ(number("work"), drives); // nothing else acts
  EXPECT_GT(drives, 0);
  // at the start there is what the driven side moves with, and the weight
  std::istringstream csv(program::content(place.path() / "bar.csv"));
  std::string header, first;
  std::getline(csv, header);
  std::getline(csv, first);
  EXPECT_THAT(header, HasSubstr("kinetic,elastic,gravity,work,dissipated,balance,"));
  std::vector<double> cells;
  std::istringstream row(first);
  for (std::string cell; std::getline(row, cell, ',') && cells.size() < 9;) cells.push_back(std::stod(cell));
  ASSERT_EQ(cells.size(), 9U);
  const double start = cells[3] + cells[4] + cells[5];
  EXPECT_NEAR(now, start + number("work") - number("dissipated") + number("balance"), 1e-9 * std::abs(drives));
}

// Explicit Euler at thirty times its stable step: impacts take what it gains while the block bounces, within
// the 1,024 steps after which other schemes are looked at.
TEST(RunEnergy, that_comes_and_goes_between_impacts_is_seen) {
  const TestFolder place;
  place.write("dropped.xml", R"(<scene name="dropped"><body>
    <bar pattern="hexahedra" cells="3 1 3" size="0.299 0.127 0.444"/><place translate="0 0 0.1901"/>
    <mass total="0.5756"/><elasticity model="linear" young="1.099e4" poisson="0" damping-stiffness="1.58e-4"/>
    <viscosity value="1.54" per="body"/><contact with="obstacles" thickness="0.001" friction="0.3"/></body>
    <world><floor z="0"/></world><time integrator="explicit" step="6.024e-4" duration="0.8"/></scene>)");
  const Outcome run = place.rend("run dropped.xml -q");
  EXPECT_EQ(run.code, 76);
  EXPECT_THAT(run.err, HasSubstr("of energy appeared that no load, drive, contact or weight gave"));
  EXPECT_EQ(place.rend("run dropped.xml -q --set time.integrator=symplectic").code, 0);
}

// A ball falls on a sheet: what contact takes is lost, and no work; the words name both.
TEST(RunEnergy, names_all_on_which_work_is_counted) {
  const TestFolder place;
  place.write("hit.xml", R"(<scene name="hit"><body><sheet cells="4 4" size="1 1"/><mass total="0.1"/>)"
                         R"(<springs><stretch k="100"/></springs><fix side="-x"/><fix side="+x"/>)"
                         R"(<contact with="obstacles"/></body><world>)"
                         R"(<sphere centre="0.5 0.5 0.16" radius="0.1" mass="0.2"/></world>)"
                         R"(<time step="1e-3" duration="0.3"/></scene>)");
  EXPECT_THAT(
      place.rend("run hit.xml -q").out,
      HasSubstr(
          "J of work done on bodies and falling spheres by loads, drives, moving obstacles, and changes"));
  const nlohmann::json e = place.rend("run hit.xml --json -q").json()["energy"];
  EXPECT_EQ(e["work"], 0);
  const double lost = e["contact"]["impact"].get<double>() + e["contact"]["friction"].get<double>();
  EXPECT_GT(lost, 0); // the ball's energy that the sheet has not taken up
  EXPECT_NEAR(lost, e["dissipated"].get<double>(), 0.02 * lost);
  place.write("bar.xml", bar(R"(<time integrator="verlet" step="auto" duration="0.01"/>)"));
  EXPECT_THAT(place.rend("run bar.xml -q").out, HasSubstr("J of work done on bodies by loads"));
}

// What a preset can give at most adds up to a number.
TEST(RunEnergy, is_a_number_at_the_bounds_of_presets) {
  const TestFolder place;
  place.write("fall.xml", R"(<scene name="fall"><body><sheet cells="2 2" size="1e29 1e29"/>)"
                          R"(<place velocity="1e30 1e30 -1e30"/><mass total="1e30"/>)"
                          R"(<springs><stretch k="1"/></springs></body><world gravity="1e30 0 -1e30">)"
                          R"(<sphere centre="9 9 1e30" radius="1" mass="1e30" velocity="1e30 0 0"/></world>)"
                          R"(<time step="1e-3" integrator="symplectic" duration="0.01"/></scene>)");
  const Outcome run = place.rend("run fall.xml --json -q --no-guard");
  ASSERT_EQ(run.code, 0) << run.err;
  for (const char* name : {"kinetic", "elastic", "gravity", "work", "dissipated", "balance"})
    EXPECT_TRUE(run.json()["energy"][name].is_number()) << name;
}

// A spring that is stretched at once: its corner has 1e153 m/s after a step, an energy of some 1e314 J.
TEST(RunEnergy, that_is_no_number_ends_the_run_with_76) {
  const TestFolder place;
  place.write("stiff.xml", R"(<scene name="stiff"><body><sheet cells="2 2" size="1 1"/><mass total="1e10"/>)"
                           R"(<springs><stretch k="1e165"/></springs><drive side="+x" displacement="1 0 0"/>)"
                           R"(</body><time step="1e-3" integrator="symplectic" duration="1e-3"/></scene>)");
  const Outcome run = place.rend("run stiff.xml --no-guard");
  EXPECT_EQ(run.code, 76);
  EXPECT_THAT(run.err, HasSubstr("a speed exceeds 1e90 m/s"));
  EXPECT_THAT(run.out, testing::Not(testing::AnyOf(HasSubstr("inf J"), HasSubstr("nan J"))));
}

// Explicit Euler without viscosity.
TEST(RunEnergy, that_nothing_gave_ends_with_76) {
  const TestFolder place;
  place.write("sheet.xml",
              R"(<scene name="sheet"><body><sheet cells="4 4" size="1 1"/><mass total="0.1"/><springs>)"
              R"(<stretch k="60"/>)"
              R"(<shear k="40"/></springs><fix side="-x"/></body><time integrator="explicit" step="2e-4" )"
              R"(duration="2"/></scene>)");
  const Outcome run = place.rend("run sheet.xml --no-guard");
  EXPECT_EQ(run.code, 76);
  EXPECT_THAT(run.err, HasSubstr("J of energy appeared"));
  EXPECT_THAT(run.err, HasSubstr("another integrator"));
  const Outcome sound = place.rend("run sheet.xml --set time.integrator=symplectic");
  EXPECT_EQ(sound.code, 0) << sound.err;
}

} // namespace
} // namespace rend::run_energy_test
