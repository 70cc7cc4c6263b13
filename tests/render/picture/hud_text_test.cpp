#include "render/picture/hud_writer.h"
#include "render/picture/scene_preset.h"

#include "sim/base/error.h"
#include "sim/build/build_scene.h"

#include <gtest/gtest.h>

namespace rend::hud_text_test {
namespace {

TEST(HudText, StandsWhereItShouldWithValuesForTheWordsInBraces) {
  const auto preset = load_scene_text(R"xml(<scene name="fall">
    <body name="cloth"><sheet cells="2 2" size="1 1"/><mass total="2"/></body>
    <time step="0.1" duration="1"/>
    <hud show="none">
      <text at="0.25 0.75" align="right" size="large" colour="#ff0000"
            text="{time}, step {step}, frame {frame}, {speed} x, {tears}/{fragments}, {kinetic}, {title}"/>
      <text text="plain"/>
    </hud>
  </scene>)xml",
                                      "fall.xml");
  Scene scene(read_scene(*preset), {});
  for (int n = 0; n < 3; ++n) scene.step();
  const HudWriter writer(*picture_settings(*preset).hud, scene, 31);
  const HudContent content = writer.content({}, 9, 0.125);
  EXPECT_TRUE(content.title.empty() && content.figures.empty());
  ASSERT_EQ(content.lines.size(), 2u);
  // without air it falls at 9.81 x 0.3 = 2.943 m/s: 8.66 J
  EXPECT_EQ(content.lines[0].text, "0.300 s, step 3, frame 9, 0.125 x, 0/1, 8.66 J, fall");
  EXPECT_EQ(content.lines[0].x, 0.25f);
  EXPECT_EQ(content.lines[0].y, 0.75f);
  EXPECT_EQ(content.lines[0].anchor, 1);
  EXPECT_TRUE(content.lines[0].large);
  EXPECT_EQ(content.lines[0].colour, (Colour{255, 0, 0}));
  EXPECT_EQ(content.lines[1].text, "plain");
  EXPECT_EQ(content.lines[1].anchor, 0.5f);
}

TEST(HudText, RefusesOtherWordsAndBracesThatStayOpen) {
  for (const char* text : {"{tim}", "{}", "at {time", "{time} {"})
    EXPECT_THROW(check_text({.text = text}), UserError) << text;
  for (const char* text : {"{time}", "", "}", "{step}{step}"})
    EXPECT_NO_THROW(check_text({.text = text})) << text;
}

} // namespace
} // namespace rend::hud_text_test
