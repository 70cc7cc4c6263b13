// A clip that is stopped before its end, for tests of resuming.
#pragma once

#include "tests/render/commands/program_run.h"
#include "tests/test_paths.h"

#include <fmt/format.h>

#include <chrono>
#include <map>

namespace rend::program {

// Everything that pictures remember over a clip: a scale, colours of fragments, curves, a following camera.
constexpr const char* followed = R"(<scene name="clip">
  <body name="cloth">
    <sheet cells="8 8" size="1 1"/><place rotate="90 0 0"/><mass total="0.1"/>
    <springs><stretch k="60"/><shear kind="isotropic" k="43"/><bend kind="provot" k="10"/></springs>
    <viscosity value="0.1" per="body"/>
    <fix side="-x"/><drive side="+x" velocity="4 0 0"/>
    <tear criterion="global-border" threshold="2" max-per-step="1"/>
    <look by="fragment"/>
  </body>
  <body name="other">
    <sheet cells="3 3" size="0.5 0.5"/><place translate="0 0 -1"/><mass total="0.1"/>
    <springs><stretch k="60"/></springs>
    <look by="force"/>
  </body>
  <time step="2e-4" integrator="rk4" duration="0.3"/>
  <camera frame="follow"/>
  <image size="64 48" fps="100" samples="1"/>
  <hud show="time energy tears legend"/>
</scene>
)";

using Files = std::map<std::string, std::string>; // name → bytes

class StoppedClip : public testing::Test {
protected:
  StoppedClip() { place.write("clip.xml", followed); }

  Files in(const std::string& folder) const {
    Files all;
    std::error_code error;
    for (fs::directory_iterator at(place.path() / folder, error), end; !error && at != end; at.increment(error))
      all[at->path().filename().string()] = content(at->path());
    return all;
  }
  // The files of an uninterrupted run; also measures how long it takes [s].
  Files alone(const std::string& more = "") {
    const auto start = std::chrono::steady_clock::now();
    EXPECT_EQ(place.rend("render clip.xml -q -o alone " + more).code, 0);
    seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    return in("alone");
  }
  Outcome stopped(const char* signal, double after, const std::string& arguments) const {
    return place.shell(fmt::format("timeout --preserve-status -s {} {:.3f} {} {}", signal, after,
                                   test::rend_program, arguments));
  }
  double moment() { return 0.02 + seconds * std::uniform_real_distribution<>(0, 1)(random); }

  // Stops it as soon as `ready` holds, a shell condition in which $pid is that of the program.
  Outcome stopped_when(const std::string& ready, const std::string& arguments,
                       const std::string& signal = "TERM") const {
    return place.shell(fmt::format("{} {} & pid=$!; until {} || ! kill -0 $pid; do sleep 0.005; done; "
                                   "kill -{} $pid; wait $pid",
                                   test::rend_program, arguments, ready, signal));
  }

  // Starts and stops runs into a folder, bisecting the moment, until one leaves its checkpoint there.
  void stop_midway(const std::string& folder, const std::string& line = "render clip.xml -q") const {
    double early = 0, late = 1.2 * seconds;
    for (int n = 0; n < 20 && !in(folder).contains("clip.checkpoint"); ++n) {
      fs::remove_all(place.path() / folder);
      const double after = 0.5 * (early + late);
      const Outcome outcome = stopped("TERM", after, line + " -o " + folder);
      (outcome.code == 143 ? early : late) = after;
      early *= 0.9; // the speed of a machine varies
      late *= 1.1;
    }
    ASSERT_TRUE(in(folder).contains("clip.checkpoint"));
  }

  static void expect_part_of(const Files& some, const Files& all, const std::string& note) {
    for (const auto& [name, bytes] : some) {
      if (!name.ends_with(".png")) continue;
      ASSERT_TRUE(all.contains(name)) << note;
      EXPECT_TRUE(bytes == all.at(name)) << name << " " << note;
    }
  }
  static void expect_same(const Files& some, const Files& all, const std::string& note) {
    expect_part_of(some, all, note);
    for (const auto& [name, bytes] : all)
      EXPECT_TRUE(some.contains(name) && some.at(name) == bytes) << name << note;
    for (const auto& [name, bytes] : some) EXPECT_TRUE(all.contains(name)) << name << " is left over" << note;
  }

  const TestFolder place;
  double seconds = 0;
  std::mt19937 random{7};
};

} // namespace rend::program
