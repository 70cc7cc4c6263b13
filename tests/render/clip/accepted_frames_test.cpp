// What commands write of a run whose steps are redone: states of the run, and none of a discarded attempt.
#include "tests/render/commands/program_run.h"

#include <fmt/format.h>
#include <gmock/gmock.h>

#include <algorithm>
#include <sstream>

namespace rend::accepted_frames_test {
namespace {

using program::Outcome;
using program::TestFolder;

// Steps above the stable 4.5 ms, each with a frame of its own.
const char* const turning = R"(<scene name="turning"><body><bar cells="6 2 2" size="0.6 0.2 0.2"/>
  <mass density="500"/><elasticity model="corotational" young="1e5" poisson="0.3"/><place spin="0 0 20"/></body>
  <world gravity="0 0 0"/><time step="8e-3" integrator="symplectic" duration="1.6"/></scene>)";

std::vector<double> mechanical(const std::string& csv) {
  std::vector<double> all;
  std::istringstream lines(csv);
  std::string line;
  std::getline(lines, line); // header
  while (std::getline(lines, line)) {
    std::istringstream row(line);
    std::vector<double> cells;
    for (std::string cell; std::getline(row, cell, ',') && cells.size() < 5;) cells.push_back(std::stod(cell));
    all.push_back(cells[3] + cells[4]);
  }
  return all;
}

TEST(AcceptedFrames, diagnostics_show_no_energy_that_the_run_never_had) {
  const TestFolder place;
  place.write("turning.xml", turning);
  const Outcome run = place.rend("run turning.xml --json -q --fps 125 --diagnostics turning.csv");
  ASSERT_EQ(run.code, 0) << run.err;
  ASSERT_GT(run.json()["guard"]["rejected"].get<int>(), 0);
  const std::vector<double> all = mechanical(program::content(place.path() / "turning.csv"));
  ASSERT_EQ(all.size(), 201U);
  EXPECT_LT(*std::max_element(all.begin(), all.end()), 1.001 * all.front());
}

// Exports at every step and at every fourth: the same files, and the same end.
TEST(AcceptedFrames, are_the_same_however_many_are_asked_for) {
  const TestFolder place;
  place.write("turning.xml", turning);
  const Outcome each = place.rend("run turning.xml --json -q --fps 125 --export obj -o each");
  const Outcome fourth = place.rend("run turning.xml --json -q --fps 31.25 --export obj -o fourth");
  ASSERT_EQ(each.code, 0) << each.err;
  ASSERT_EQ(fourth.code, 0) << fourth.err;
  EXPECT_EQ(each.json()["hash"], fourth.json()["hash"]);
  const auto file = [&](const std::string& folder, long frame) {
    return program::content(place.path() / folder / fmt::format("{:05d}.obj", frame));
  };
  for (long frame = 0; frame <= 50; ++frame) {
    ASSERT_FALSE(file("each", 4 * frame).empty());
    EXPECT_EQ(file("each", 4 * frame), file("fourth", frame)) << frame;
  }
}

} // namespace
} // namespace rend::accepted_frames_test
