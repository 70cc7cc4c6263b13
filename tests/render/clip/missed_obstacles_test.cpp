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

// A ball that hits, and a box that nothing touches; the floor is far below.
TEST(MissedObstacles, are_told_one_by_one) {
  const TestFolder place;
  std::string text = dropped_at("0.5 0.5 0.16");
  text.replace(text.find("<sphere"), 7,
               R"(<floor z="-9"/><box name="table" low="3 3 0" high="4 4 1"/><sphere)");
  place.write("a.xml", text);
  const auto run = place.rend("run a.xml --json");
  EXPECT_THAT(run.err, HasSubstr("note: no body has touched, at the end, box 'table' at (3.5, 3.5, 0.5) m"));
  const auto obstacles = run.json()["obstacles"];
  ASSERT_EQ(obstacles.size(), 3u);
  EXPECT_EQ(obstacles[0].dump(), R"({"kind":"floor","number":1,"touched":false})");
  EXPECT_EQ(obstacles[1].dump(), R"({"kind":"sphere","number":1,"touched":true})");
  EXPECT_EQ(obstacles[2].dump(), R"({"kind":"box","name":"table","number":1,"touched":false})");
}

TEST(MissedObstacles, are_none_that_every_body_passes_through) {
  const TestFolder place;
  std::string text = dropped_at("0.5 0.5 0.16", R"(<contact not="table"/>)");
  text.replace(text.find("<sphere"), 7, R"(<box name="table" low="3 3 0" high="4 4 1"/><sphere)");
  place.write("a.xml", text);
  const auto run = place.rend("run a.xml --json");
  EXPECT_THAT(run.err, Not(HasSubstr("touched")));
  EXPECT_EQ(run.json()["obstacles"].size(), 1u);
}

TEST(ContactFigures, tell_how_near_things_came_and_null_without_contact) {
  const TestFolder place;
  place.write("hit.xml", dropped_at("0.5 0.5 0.16"));
  place.write("none.xml", dropped_at("3 0.5 0.16", ""));
  const auto hit = place.rend("run hit.xml --json -q").json()["energy"]["contact"],
             none = place.rend("run none.xml --json -q").json();
  constexpr double fall = 9.81 * 1e-3 * 1e-3; // [m], in a step: as deep as what rests may lie
  EXPECT_NEAR(hit["gap"].get<double>(), 0.002, fall);
  EXPECT_NEAR(hit["overlap"].get<double>(), 0, fall);
  EXPECT_TRUE(none["energy"]["contact"]["gap"].is_null());
  EXPECT_TRUE(none["energy"]["contact"]["overlap"].is_null());
  EXPECT_FALSE(none.contains("obstacles"));
}

} // namespace
} // namespace rend::missed_obstacles_test
