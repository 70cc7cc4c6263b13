// Commands tell when a clip ends and no body has touched anything.
#include "tests/render/commands/program_run.h"

#include <gmock/gmock.h>

namespace rend::missed_obstacles_test {
namespace {

using program::TestFolder;
using testing::HasSubstr;
using testing::Not;

// A ball over a sheet that is held at two sides, or beside it.
std::string dropped_at(const std::string& centre, const std::string& contact = "<contact with=\"obstacles\"/>",
                       const std::string& scheme = "symplectic") {
  return R"(<scene name="drop"><body><sheet cells="4 4" size="1 1"/><mass total="0.1"/>
    <springs><stretch k="100"/></springs><fix side="-x"/><fix side="+x"/>)" +
         contact + R"(</body><world><sphere centre=")" + centre + R"(" radius="0.1" mass="0.2"/></world>
    <time step="1e-3" duration="0.3" integrator=")" +
         scheme + R"("/><image size="64 48" fps="10" samples="1"/></scene>)";
}

TEST(MissedObstacles, are_told_by_run_and_render) {
  const TestFolder place;
  place.write("miss.xml", dropped_at("3 0.5 0.16"));
  place.write("hit.xml", dropped_at("0.5 0.5 0.16"));
  const std::string note = "note: no body has touched anything: at the end sphere 1 at (3, 0.5, -0.28";
  EXPECT_THAT(place.rend("run miss.xml").err, HasSubstr(note));
  EXPECT_THAT(place.rend("run hit.xml").err, Not(HasSubstr("touched")));
  EXPECT_EQ(place.rend("run miss.xml -q").err, "");
  EXPECT_EQ(place.rend("run miss.xml --json -q").json()["touched_nothing"], true);
  EXPECT_EQ(place.rend("run hit.xml --json -q").json()["touched_nothing"], false);
  const auto drawn = place.rend("render miss.xml -o a");
  if (drawn.code == 64) return; // built without PNG
  EXPECT_THAT(drawn.err, HasSubstr(note));
  EXPECT_THAT(place.rend("render hit.xml -o b").err, Not(HasSubstr("touched")));
}

TEST(MissedObstacles, are_told_whatever_the_scheme) {
  const TestFolder place;
  for (const char* scheme : {"verlet", "rk4", "implicit"}) {
    place.write("miss.xml", dropped_at("3 0.5 0.16", "<contact with=\"obstacles\"/>", scheme));
    place.write("hit.xml", dropped_at("0.5 0.5 0.16", "<contact with=\"obstacles\"/>", scheme));
    EXPECT_EQ(place.rend("run miss.xml --json -q").json()["touched_nothing"], true) << scheme;
    EXPECT_EQ(place.rend("run hit.xml --json -q").json()["touched_nothing"], false) << scheme;
  }
}

// Before its end a sphere may still come; where nothing collides, it was not meant to.
TEST(MissedObstacles, are_told_of_a_whole_clip_with_contact_alone) {
  const TestFolder place;
  place.write("hit.xml", dropped_at("0.5 0.5 0.16"));
  place.write("none.xml", dropped_at("3 0.5 0.16", ""));
  place.write("pulled.xml", program::pulled);
  EXPECT_THAT(place.rend("run hit.xml --steps 10").err, Not(HasSubstr("touched")));
  EXPECT_THAT(place.rend("run none.xml").err, Not(HasSubstr("touched")));
  EXPECT_FALSE(place.rend("run none.xml --json -q").json().contains("touched_nothing"));
  EXPECT_FALSE(place.rend("run pulled.xml --json -q").json().contains("touched_nothing"));
}

} // namespace
} // namespace rend::missed_obstacles_test
