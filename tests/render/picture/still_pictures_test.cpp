// Pictures from settings that a program fills in, against those of a preset.
#include "render/picture/still_pictures.h"

#include "render/picture/scene_preset.h"
#include "sim/build/build_scene.h"

#include <gtest/gtest.h>

namespace rend::still_pictures_test {
namespace {

// Two bodies, an obstacle of each kind, and what is said of their picture.
std::string scene_with(const std::string& looks, const std::string& colours, const std::string& more) {
  const std::string body =
      R"(<sheet cells="4 4" size="1 1"/><mass total="0.1"/><springs><stretch k="60"/></springs>)";
  return R"(<scene name="seen"><body name="near">)" + body + looks + R"(</body><body name="far">)" + body +
         R"(<place translate="1.5 0 0"/></body><world><floor z="-0.5"/><sphere centre="0 1 0.5" radius="0.2")" +
         colours + R"(/><box low="1 1 0" high="1.5 1.5 0.5"/></world><time step="1e-3" duration="1"/>)" + more +
         "</scene>";
}

struct Seen {
  std::unique_ptr<PresetNode> preset;
  std::unique_ptr<Scene> scene;
  explicit Seen(const std::string& text) : preset(load_scene_text(text, "seen.xml")) {
    scene = std::make_unique<Scene>(read_scene(*preset), SceneOptions{});
  }
  PictureSettings settings() const { return picture_settings(*preset); }
};

PictureSettings small() {
  PictureSettings settings;
  settings.image.size = {96, 64};
  settings.image.samples = 1;
  return settings;
}

constexpr const char* small_image = R"(<image size="96 64" samples="1"/>)";

TEST(StillPictures, settings_of_a_program_draw_what_a_preset_draws) {
  const Seen said(scene_with(R"(<look colour="#102030" by="fragment" edges="no" finish="rubber"/>)",
                             R"( colour="#ff0000")",
                             R"(<image size="96 64" samples="1" background="#203040" occlusion="yes"/>)"
                             R"(<camera eye="2 -4 3" target="0.5 0.5 0" fov="40"/>)"));
  PictureSettings settings = small();
  settings.image.background = Colour{0x20, 0x30, 0x40};
  settings.image.occlusion = true;
  settings.camera.eye = Vec3(2, -4, 3);
  settings.camera.target = Vec3(0.5, 0.5, 0);
  settings.camera.fov = 40;
  settings.looks.resize(1); // the second body looks as by default
  settings.looks[0].colour = {0x10, 0x20, 0x30};
  settings.looks[0].by = ColourBy::Fragment;
  settings.looks[0].edges = false;
  settings.looks[0].finish = finish_called("rubber");
  settings.spheres = {{.colour = {0xff, 0, 0}}};
  const Image preset = StillPictures(said.settings(), *said.scene).take();
  EXPECT_EQ(StillPictures(settings, *said.scene).take(), preset);
  settings.spheres.clear();
  EXPECT_NE(StillPictures(settings, *said.scene).take(), preset);
}

TEST(StillPictures, a_silent_preset_draws_what_default_settings_draw) {
  const Seen silent(scene_with("<look/>", "", std::string(small_image) + "<camera/>"));
  const Seen bare(scene_with("", "", small_image));
  const Image expected = StillPictures(small(), *silent.scene).take();
  EXPECT_EQ(StillPictures(silent.settings(), *silent.scene).take(), expected);
  EXPECT_EQ(StillPictures(bare.settings(), *bare.scene).take(), expected);
}

TEST(StillPictures, without_a_background_they_have_an_alpha) {
  const Seen seen(scene_with("", "", small_image));
  PictureSettings settings = small();
  EXPECT_EQ(StillPictures(settings, *seen.scene).take().channels, 3);
  settings.image.background.reset();
  EXPECT_EQ(StillPictures(settings, *seen.scene).take().channels, 4);
}

TEST(StillPictures, each_is_of_the_present_state) {
  const Seen seen(scene_with("", "", small_image));
  StillPictures pictures(small(), *seen.scene);
  const Image first = pictures.take();
  EXPECT_EQ(pictures.take(), first);
  for (int n = 0; n < 100; ++n) seen.scene->step(); // they fall by 5 cm
  EXPECT_NE(pictures.take(), first);
}

TEST(StillPictures, settings_that_cannot_be_are_refused) {
  const Seen seen(scene_with("", "", small_image));
  PictureSettings blind = small();
  blind.camera.frame = Framing::Given; // and no eye
  EXPECT_THROW(StillPictures(blind, *seen.scene), UserError);
  PictureSettings wide = small();
  wide.camera.fov = 200;
  EXPECT_THROW(StillPictures(wide, *seen.scene), UserError);
  PictureSettings three = small();
  three.image.samples = 3;
  EXPECT_THROW(StillPictures(three, *seen.scene), UserError);
  PictureSettings empty = small();
  empty.image.size = {0, 64};
  EXPECT_THROW(StillPictures(empty, *seen.scene), UserError);
}

TEST(StillPictures, refuse_a_word_of_the_hud_that_there_is_not) {
  const Seen seen(scene_with("", "", small_image));
  PictureSettings settings = small();
  settings.hud = HudSettings{.show = {"time", "tittle"}};
  try {
    StillPictures(settings, *seen.scene).take();
    FAIL() << "not refused";
  } catch (const UserError& error) {
    EXPECT_EQ(error.code, Exit::BadInput);
    EXPECT_STREQ(error.what(),
                 "show is 'tittle'; expected any of title, time, energy, tears, legend, cost, none, "
                 "separated by spaces");
    EXPECT_EQ(error.hint, "did you mean 'title'?");
  }
  settings.hud->show = {"time", "title"};
  EXPECT_NO_THROW(StillPictures(settings, *seen.scene).take());
}

} // namespace
} // namespace rend::still_pictures_test
