#include "render/diagram/rule_diagram.h"

#include "render/diagram/graph_layout.h"
#include "render/diagram/paint.h"
#include "render/diagram/script_diagram.h"
#include "render/diagram/svg.h"
#include "render/draw/hud.h"
#include "sim/base/math.h"
#include "sim/house_rules/house_scripts.h"
#include "sim/topology/count.h"
#include "sim/topology/validate.h"

#include <gmock/gmock.h>

namespace rend::rule_diagram_test {
namespace {

using testing::HasSubstr;

std::size_t count_of(const std::string& what, const std::string& in) {
  std::size_t count = 0;
  for (std::size_t at = in.find(what); at != std::string::npos; at = in.find(what, at + 1)) ++count;
  return count;
}

TEST(GraphLayout, of_a_path_is_a_line_with_steps_of_one) {
  const auto at = lay_out(RuleGraph::parse(RuleSide::Right, "a b c d e a-1-b b-0-c c-1-d d-0-e"));
  for (std::size_t n = 1; n < at.size(); ++n) EXPECT_NEAR(distance(at[n - 1], at[n]), 1, 1e-3);
  EXPECT_NEAR(distance(at.front(), at.back()), 4, 1e-2);
  EXPECT_LT(at.front().x, at.back().x);
}

TEST(GraphLayout, of_a_cycle_does_not_cross_itself) {
  const auto at = lay_out(RuleGraph::parse(RuleSide::Right, "a c e b d f a-0-b b-1-c c-0-d d-1-e e-0-f f-1-a"));
  const std::vector<std::size_t> cycle{0, 3, 1, 4, 2, 5}; // a b c d e f
  double turn = 0;
  for (std::size_t n = 0; n < 6; ++n) { // of a convex polygon all corners turn the same way
    const Spot a = at[cycle[n]], b = at[cycle[(n + 1) % 6]], c = at[cycle[(n + 2) % 6]];
    const double side = (b.x - a.x) * (c.y - b.y) - (b.y - a.y) * (c.x - b.x);
    EXPECT_GT(side * (turn == 0 ? side : turn), 0);
    turn = side;
  }
}

TEST(GraphLayout, keeps_the_nodes_of_all_house_rules_apart) {
  for (const Rule& rule : house_rules())
    for (const RuleGraph* graph : {&rule.left, &rule.right}) {
      const auto at = lay_out(*graph);
      for (std::size_t a = 0; a < at.size(); ++a)
        for (std::size_t b = 0; b < a; ++b) EXPECT_GT(distance(at[a], at[b]), 0.55) << rule.name();
    }
}

TEST(SampleMaps, are_valid_and_every_house_rule_applies_to_one) {
  for (const SampleMap& sample : sample_maps())
    EXPECT_EQ(validate(*sample.make()), std::nullopt) << sample.name;
  for (const Rule& rule : house_rules()) {
    const RuleShown shown = show(rule);
    ASSERT_NE(shown.sample, nullptr) << rule.name();
    EXPECT_EQ(validate(*shown.after), std::nullopt) << rule.name();
    EXPECT_EQ(rule.creates() && !rule.removes(),
              shown.after->map().dart_count() > shown.before->map().dart_count())
        << rule.name();
  }
}

TEST(SampleMaps, show_what_a_rule_does) {
  const RuleShown star = show(rule("star-face"), "triangles");
  EXPECT_EQ(count_cells(star.before->map()).faces, 2U);
  EXPECT_EQ(count_cells(star.after->map()).faces, 4U); // one of two triangles becomes three
  const RuleShown sewn = show(rule("sew-edges"));
  EXPECT_EQ(count_cells(sewn.before->map()).fragments, 2U);
  EXPECT_EQ(count_cells(sewn.after->map()).fragments, 1U);
  EXPECT_EQ(count_cells(sewn.after->map()).euler, 1); // a disc, and no Moebius band
  EXPECT_EQ(show(rule("star-volume"), "sheet").sample, nullptr);
}

TEST(SampleMaps, show_every_house_script) {
  for (const Script& each : house_scripts()) {
    const ScriptShown shown = show(each);
    ASSERT_NE(shown.sample, nullptr) << each.name();
    ASSERT_GE(shown.stages.size(), 2U);
    for (const auto& stage : shown.stages) EXPECT_EQ(validate(*stage), std::nullopt) << each.name();
    const auto links = [](const EmbeddedMap& map) {
      std::vector<Dart> all;
      map.map().for_each_dart([&](Dart d) {
        for (int i = 0; i < 4; ++i) all.push_back(map.map().alpha(i, d));
      });
      return all;
    };
    EXPECT_NE(links(*shown.stages.front()), links(*shown.stages.back())) << each.name();
    const std::string svg = svg_text(diagram_of(each, shown));
    EXPECT_EQ(svg, svg_text(diagram_of(each, show(each))));
    for (std::size_t n = 0; n < each.steps.size(); ++n)
      EXPECT_THAT(svg, HasSubstr(std::to_string(n + 1) + ". at each "));
  }
}

// Fig. 3.49 of the thesis: a face among others lets go of them, and is gone.
TEST(SampleMaps, show_a_script_step_by_step) {
  const ScriptShown shown = show(script("delete-face"), "large-sheet");
  ASSERT_EQ(shown.stages.size(), 3U);
  const auto counts = [&](std::size_t stage) { return count_cells(shown.stages[stage]->map()); };
  EXPECT_EQ(counts(0).faces, 9U);
  EXPECT_EQ(counts(1).faces, 9U);
  EXPECT_EQ(counts(1).fragments, 2U);
  EXPECT_EQ(counts(2).faces, 8U);
  EXPECT_EQ(counts(2).fragments, 1U);
  EXPECT_EQ(step_in_words(script("delete-face"), 0), "1. at each e*(0): unsew-edge, wherever it applies");
}

TEST(RuleDiagram, names_every_node_on_its_side) {
  for (const Rule& rule : house_rules()) {
    const std::string left = svg_text(diagram_of(rule.left, rule.right, RuleSide::Left));
    const std::string right = svg_text(diagram_of(rule.right, rule.left, RuleSide::Right));
    for (const RuleNode& node : rule.left.nodes) EXPECT_EQ(count_of(">" + node.name + "</text>", left), 1U);
    for (const RuleNode& node : rule.right.nodes) EXPECT_EQ(count_of(">" + node.name + "</text>", right), 1U);
    EXPECT_EQ(count_of("r=\"18\"", left), rule.plan.hooks.size()) << "the second circle of a hook";
    EXPECT_EQ(count_of("r=\"18\"", right), 0U);
  }
}

TEST(RuleDiagram, has_the_same_bytes_each_time) {
  for (const char* name : {"sponge", "create-tetrahedron", "star-face"})
    EXPECT_EQ(svg_text(diagram_of(rule(name), show(rule(name)))),
              svg_text(diagram_of(rule(name), show(rule(name)))));
}

TEST(RuleDiagram, escapes_what_a_user_wrote) {
  const Rule mine({.name = "a\"<&", .about = "</text>\x1b", .left = "a*(0,1)", .right = "a(0,1)"});
  const std::string text = svg_text(diagram_of(mine, {}));
  EXPECT_THAT(text, HasSubstr("a&quot;&lt;&amp;"));
  EXPECT_THAT(text, HasSubstr("&lt;/text&gt;\\x1b"));
}

// How much of a picture a drawing covers, in pixels of the drawing.
double painted(const Drawing& drawing, double scale) {
  const Image image = paint(drawing, scale);
  double dark = 0;
  for (std::uint8_t value : image.pixels) dark += (255 - value) / 255.0 / 3;
  return dark / (scale * scale);
}

TEST(Paint, covers_the_areas_of_what_is_drawn) {
  if (!hud_available()) GTEST_SKIP() << "built without the HUD";
  const Ink black{0};
  Drawing drawing;
  drawing.width = drawing.height = 100;
  drawing.parts = {DrawnLine{{10.3, 20.7}, {80.1, 60.2}, 3, black}};
  EXPECT_NEAR(painted(drawing, 2), 3 * distance({10.3, 20.7}, {80.1, 60.2}), 1.5);
  drawing.parts = {DrawnCircle{{50, 50}, 30, black, no_ink, 0}};
  EXPECT_NEAR(painted(drawing, 1), pi * 30 * 30, 10);
  drawing.parts = {DrawnCircle{{50, 50}, 30, no_ink, black, 4}};
  EXPECT_NEAR(painted(drawing, 1), pi * (32 * 32 - 28 * 28), 4);
  drawing.parts = {DrawnPolygon{{{10, 10}, {90, 10}, {10, 50}}, black}};
  EXPECT_NEAR(painted(drawing, 1), 1600, 2);
  drawing.parts = {
      DrawnPolygon{{{-50, -50}, {250, -50}, {250, 50}, {-50, 50}}, {0, 0.5}}}; // beyond the picture
  EXPECT_NEAR(painted(drawing, 1), 100 * 50 * 0.5, 15);
  drawing.parts = {DrawnLine{{10, 50}, {90, 50}, 2, black, {6, 2}}}; // three quarters of it
  EXPECT_NEAR(painted(drawing, 2), 80 * 2 * 0.75, 1);
}

TEST(Paint, writes_text_as_high_as_it_says) {
  if (!hud_available()) GTEST_SKIP() << "built without the HUD";
  Drawing drawing;
  drawing.width = 200, drawing.height = 100;
  drawing.parts = {DrawnText{{20, 80}, "HH", 50, {0}}};
  const Image image = paint(drawing, 1);
  int top = image.height, bottom = 0;
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x)
      if (*image.at(x, y) < 128) {
        top = std::min(top, y);
        bottom = std::max(bottom, y + 1);
      }
  EXPECT_EQ(bottom, 80);                    // the baseline
  EXPECT_NEAR(bottom - top, 0.727 * 50, 1); // the height of Inter's capitals
}

} // namespace
} // namespace rend::rule_diagram_test
