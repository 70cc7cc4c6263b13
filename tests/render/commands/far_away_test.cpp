// Pictures of what moves farther away than can be drawn.
#include "tests/render/commands/program_run.h"
#include "tests/render/needs.h"

namespace rend::far_away_test {
namespace {

using program::Outcome;
using program::TestFolder;

// A sheet, two boxes and two spheres that are up to 1e41 m away after 1e11 s.
constexpr const char* flying =
    R"(<scene name="far"><body><sheet cells="2 2" size="1 1"/><place translate="0 0 5" velocity="1e30 0 0"/>)"
    R"(<mass total="1"/><springs><stretch k="1"/></springs><contact/></body><world gravity="0 0 0">)"
    R"(<floor z="-1e30"/><box low="2 2 2" high="3 3 3" velocity="0 0 1e30"/><box low="0 0 -2" high="1 1 -1">)"
    R"(<key at="1" position="0 1e30 0"/></box><sphere centre="9 9 9" radius="1" velocity="0 1e30 0"/>)"
    R"(<sphere centre="-9 9 9" mass="1e30" radius="1" velocity="0 1e30 0"/></world>)"
    R"(<time step="1e10" integrator="symplectic" duration="1e11"/><image size="64 48" fps="1e-10"/></scene>)";

TEST(FarAway, what_has_left_is_not_in_the_picture) {
  NEEDS_PNG;
  const TestFolder place;
  place.write("far.xml", flying);
  for (const char* options : {"", "--set camera.frame=follow", "--set 'camera.eye=0 -1e30 0'",
                              "--set image.shutter=0.5 --set 'camera.eye=0 -9 5'"}) {
    const Outcome outcome = place.rend(std::string("render far.xml -q -o frames ") + options);
    EXPECT_EQ(outcome.code, 0) << options << outcome.err;
    EXPECT_TRUE(std::filesystem::exists(place.path() / "frames/00010.png")) << options;
    std::filesystem::remove_all(place.path() / "frames");
  }
}

} // namespace
} // namespace rend::far_away_test
