// Bodies that pass through what is drawn: told when a picture shows it, and not before.
#include "render/clip/pass_through.h"

#include "tests/render/commands/program_run.h"
#include "tests/render/needs.h"
#include "tests/sim/mesh_files.h"
#include "tests/sim/presets.h"

#include <gmock/gmock.h>

namespace rend::pass_through_test {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

// A sheet of 1 m x 1 m that falls from a height of 0.5 m.
std::string falling(const std::string& contact, const std::string& world, const std::string& image = "") {
  return R"(<scene name="falling"><body name="sheet"><sheet cells="4 4" size="1 1"/>)"
         R"(<place translate="0 0 0.5"/>)"
         R"(<mass total="1"/><springs><stretch k="20"/></springs>)" +
         contact + R"(</body><world gravity="0 0 -10">)" + world +
         R"(</world><time step="1e-3" integrator="symplectic" duration="0.5"/>)" + image + "</scene>";
}

// The notes after so many steps of 1 ms, with a frame every fifty.
std::vector<std::string> notes_after(int steps, const std::string& contact, const std::string& world) {
  const auto scene = presets::load(falling(contact, world));
  PassThrough seen(*scene.scene);
  for (int n = 0; n <= steps; ++n) {
    if (n % 50 == 0) seen.look(n / 50);
    scene->step();
  }
  return seen.notes();
}

// It is at 0.5 - 5 t^2 [m]: at the floor after 0.32 s, in frame 7 (0.35 s) 0.11 m below it.
TEST(PassThrough, is_told_once_from_the_first_frame_that_shows_it_on) {
  const std::string floor = R"(<floor z="0"/>)";
  EXPECT_THAT(notes_after(300, "", floor), IsEmpty());
  EXPECT_THAT(
      notes_after(450, "", floor),
      ElementsAre("'sheet' passes through the floor from frame 7 on: add <contact with=\"floor\"/> to it"));
  EXPECT_THAT(notes_after(450, R"(<contact with="floor"/>)", floor), IsEmpty());
  EXPECT_THAT(notes_after(450, R"(<contact with="fragments"/>)", floor), ElementsAre(HasSubstr("the floor")));
}

TEST(PassThrough, is_told_of_spheres_and_boxes_too) {
  const std::string world = R"(<floor z="-9"/><sphere centre="0.5 0.5 0" radius="0.2"/>)"
                            R"(<box low="-0.1 -0.1 -0.4" high="0.1 0.1 0"/>)";
  EXPECT_THAT(notes_after(150, "", world), IsEmpty());
  EXPECT_THAT(notes_after(300, "", world),
              ElementsAre(HasSubstr("a sphere from frame 5"))); // 0.3 m: not above 0.2
  EXPECT_THAT(notes_after(400, "", world), ElementsAre(HasSubstr("a sphere"), HasSubstr("a box from frame 7")));
  EXPECT_THAT(notes_after(400, R"(<contact with="obstacles"/>)", world), IsEmpty());
}

TEST(PassThrough, is_told_of_meshes_that_are_closed) {
  const std::string world = fmt::format(R"(<obstacle file="{}"/>)",
                                        mesh_files::box("through.obj", {-0.1, -0.1, -0.4}, {0.1, 0.1, 0}));
  EXPECT_THAT(notes_after(300, "", world), IsEmpty());
  EXPECT_THAT(notes_after(400, "", world), ElementsAre(HasSubstr("an obstacle from frame 7")));
  EXPECT_THAT(notes_after(400, R"(<contact with="obstacles"/>)", world), IsEmpty());
}

TEST(PassThrough, is_printed_by_render_and_listed_by_info_as_left_out) {
  NEEDS_PNG;
  const program::TestFolder place;
  place.write("falling.xml", falling("", R"(<floor z="0"/>)", R"(<image size="64 48" fps="20" samples="1"/>)"));
  EXPECT_THAT(place.rend("render falling.xml --frames 0-6").err, testing::Not(HasSubstr("note:")));
  EXPECT_THAT(place.rend("render falling.xml --frames 0,8-9").err,
              HasSubstr("note: 'sheet' passes through the floor from frame 8 on: add"));
  EXPECT_THAT(place.rend("render falling.xml --frames 0,8 --quiet").err, IsEmpty());
  const auto body = place.rend("info falling.xml --json").json()["bodies"][0];
  EXPECT_THAT(body["left_out"].dump(), HasSubstr("contact: 'sheet' will pass through the floor: add"));
  EXPECT_THAT(body["notes"], IsEmpty());
}

} // namespace
} // namespace rend::pass_through_test
