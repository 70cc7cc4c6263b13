// Scripts: what they visit, that they apply as a whole or not at all, and what their expressions read.
#include "sim/rules/script_run.h"

#include "sim/base/archive.h"
#include "sim/build/rule_book.h"
#include "sim/rules/rounds.h"
#include "sim/topology/isomorphism.h"
#include "tests/sim/assets.h"

#include <gtest/gtest.h>

namespace rend::script_test {
namespace {

// The last one of a file of rules.
RuleOrScript made(const std::string& rules) {
  return read_rules_text("<rules>" + rules + "</rules>", "test.xml").back();
}

struct Outcome {
  bool ok = false;
  std::string reason;
};

Outcome run(const RuleOrScript& script, EmbeddedMap& body, const Hooks& hooks = {},
            const RuleContext& context = {}) {
  RuleOrScriptRunner runner(script, context);
  Outcome out;
  body.edit([&](Edit& edit) { out.ok = runner.apply(edit, hooks); });
  if (!out.ok) out.reason = runner.sentence();
  const auto fault = validate(body);
  EXPECT_FALSE(fault) << *fault;
  return out;
}

std::vector<std::uint8_t> bytes_of(EmbeddedMap& body) {
  Archive archive;
  body.store(archive);
  return archive.bytes();
}

bool says(const std::string& text, const std::string& words) {
  return text.find(words) != std::string::npos;
}

std::size_t faces(const EmbeddedMap& body) {
  return count_cells(body.map()).faces;
}

constexpr Dart first{0u};

TEST(Script, visits_each_cell_of_the_hook_once) {
  const auto script =
      made(R"xml(<script name="s" hook="a*(0,1,2)"><for each="e*(0,1)" apply="star-face"/></script>)xml");
  const auto sheet = assets::grid(3, 2);
  EXPECT_TRUE(run(script, *sheet, first).ok);
  EXPECT_EQ(faces(*sheet), 6u * 4);
  const auto part =
      made(R"xml(<script name="s" hook="a*(0,1)"><for each="e*(0,1)" apply="star-face"/></script>)xml");
  const auto one = assets::grid(3, 2);
  EXPECT_TRUE(run(part, *one, first).ok);
  EXPECT_EQ(faces(*one), 5u + 4);
}

TEST(Script, visits_what_its_steps_have_divided_and_parted) {
  const auto script = made(R"xml(<script name="s" hook="a*(0,1)">
      <for each="e*(0,1)" apply="star-face"/>
      <for each="e*(0,1)" apply="star-face"/>
      <for each="e*(0)" apply="unsew-edge" at-least="none"/></script>)xml");
  const auto sheet = assets::grid(3, 3);
  EXPECT_TRUE(run(script, *sheet, first).ok);
  EXPECT_EQ(faces(*sheet), 8u + 12);
  EXPECT_EQ(count_cells(sheet->map()).fragments, 1u + 12); // the eight quads hold together
}

// A script inside another one that reaches beyond the hook makes nothing of the hook, as a rule does not.
TEST(Script, within_another_one_adds_to_the_hook_only_what_it_made_of_it) {
  const std::string rest = R"xml(<for each="f*(0,1)" apply="star-face"/></script>)xml";
  const std::string inner =
      R"xml(<script name="inner" hook="a*(0,2,3)"><for each="e*(0,2,3)" apply="insert-vertex"/></script>)xml";
  const std::string outer = R"xml(<script name="outer" hook="a*(0,1)"><for each="e*(0,2,3)" apply=")xml";
  for (const std::string apply : {"insert-vertex", "inner"}) {
    const auto sheet = assets::grid(3, 3);
    Dart middle;
    sheet->map().for_each_dart([&](Dart d) {
      bool inside = true;
      for (Dart e : darts_of(sheet->map(), FaceOfVolume, d)) inside = inside && !sheet->map().is_free(2, e);
      if (inside) middle = d;
    });
    EXPECT_TRUE(run(made(inner + outer + apply + R"xml("/>)xml" + rest), *sheet, middle).ok);
    EXPECT_EQ(faces(*sheet), 8u + 8) << apply;
  }
}

TEST(Script, tells_cells_that_it_has_made_from_those_that_were_there) {
  const std::string start =
      R"xml(<script name="s" hook="a*(0,1,2)"><for each="e*(0,2,3)" apply="insert-vertex"/>)xml";
  const auto old = made(start + R"xml(<for each="e*(1,3)" which="old" apply="cut-face-corner"/></script>)xml");
  const auto quad = assets::single_quad();
  ASSERT_TRUE(run(old, *quad, first).ok);
  EXPECT_EQ(faces(*quad), 5u); // four corners, and the quad of the middles of the sides
  quad->map().for_each_dart([&](Dart d) {
    const Vec3 x = quad->position_of(d);
    EXPECT_TRUE(x.x() == 0.5 || x.y() == 0.5 || sides_of_face(quad->map(), d) == 3);
  });
  const auto fresh = made(R"xml(<rule name="up" left="a*(1,2,3)" right="a(1,2,3)">
        <set node="a" position="a + point(0, 0, 1)"/></rule>)xml" +
                          start + R"xml(<for each="e*(1,2,3)" which="new" apply="up"/></script>)xml");
  const auto raised = assets::single_quad();
  ASSERT_TRUE(run(fresh, *raised, first).ok);
  raised->map().for_each_dart([&](Dart d) {
    const Vec3 x = raised->position_of(d);
    EXPECT_EQ(x.z(), x.x() == 0.5 || x.y() == 0.5 ? 1 : 0);
    EXPECT_EQ(raised->rest_of(d), x);
  });
}

TEST(Script, that_fails_inside_takes_everything_back) {
  // Sides on the border are sewn to nothing; by then all sides and faces have been changed.
  const std::string steps =
      R"xml(<script name="s" hook="a*(0,1,2)"><for each="e*(0,2,3)" apply="insert-vertex"/>
      <for each="e*(0,1)" apply="star-face"/><for each="e*(0)" apply="unsew-edge")xml";
  const auto sheet = assets::grid(2, 2);
  sheet->use(Edge);
  sheet->use(FaceOfVolume);
  const auto before = bytes_of(*sheet);
  const Outcome refused = run(made(steps + "/></script>"), *sheet, first);
  EXPECT_FALSE(refused.ok);
  EXPECT_TRUE(says(refused.reason, "step 3, 'unsew-edge', does not apply at dart")) << refused.reason;
  EXPECT_EQ(bytes_of(*sheet), before);
  EXPECT_TRUE(run(made(steps + R"xml( at-least="one"/></script>)xml"), *sheet, first).ok);
}

TEST(Script, may_ask_for_one_cell_or_none) {
  const auto script = [](const std::string& at_least) {
    return made(R"xml(<script name="s" hook="a*(0,1)"><for each="e*(0)" apply="unsew-edge" at-least=")xml" +
                at_least + R"xml("/><for each="e*(0,1)" apply="star-face"/></script>)xml");
  };
  for (const std::string at_least : {"all", "one", "none"}) {
    const auto alone = assets::single_quad(), corner = assets::grid(2, 2), inside = assets::grid(3, 3);
    EXPECT_EQ(run(script(at_least), *alone, first).ok, at_least == "none");
    EXPECT_EQ(run(script(at_least), *corner, first).ok, at_least != "all");
    EXPECT_TRUE(run(script(at_least), *inside, Dart{4u * 8}).ok); // the fifth quad, in the middle
  }
}

TEST(Script, that_does_nothing_does_not_apply) {
  const auto script = made(R"xml(<script name="s" hook="a*(0,1)">
      <for each="e*(0)" apply="unsew-edge" at-least="none"/></script>)xml");
  const auto quad = assets::single_quad();
  const Outcome refused = run(script, *quad, first);
  EXPECT_FALSE(refused.ok);
  EXPECT_TRUE(says(refused.reason, "no step applies anywhere")) << refused.reason;
  EXPECT_FALSE(run(script, *quad, Dart{99u}).ok);
}

TEST(Script, chooses_cells_and_hooks_by_tests) {
  const std::string start = R"xml(<script name="s" hook="a*(0,1,2)"><for each="e*(0,1)" )xml",
                    end = R"xml( apply="star-face" at-least="none"/></script>)xml";
  const auto right = made(start + R"xml(where="x(mean(e, face)) > x(mean(a, component))")xml" + end);
  const auto sheet = assets::grid(4, 3);
  EXPECT_TRUE(run(right, *sheet, first).ok);
  EXPECT_EQ(faces(*sheet), 6u + 6 * 4);
  // Of 4 x 3 quads, none has free sides alone, and 10 have some.
  for (const auto& [at, chosen] : {std::pair{"all", 0u}, {"any", 10u}}) {
    const auto body = assets::grid(4, 3);
    const auto open = made(start + "at=\"" + at + "\" where=\"free(e, 2)\"" + end);
    EXPECT_EQ(run(open, *body, first).ok, chosen > 0);
    EXPECT_EQ(faces(*body), 12 + 3 * chosen);
  }
  const auto large = made(R"xml(<script name="s" hook="a*(0,1)">
      <when test="size(a, face) > 4" otherwise="it has few sides"/>
      <for each="e*(0,1)" apply="star-face"/></script>)xml");
  EXPECT_TRUE(says(run(large, *assets::grid(2, 1), first).reason, "it has few sides"));
}

TEST(Script, passes_arguments_on) {
  const auto script = made(R"xml(<script name="inner" hook="a*(1,2,3)"><where name="by" value="point(9, 9, 9)"/>
        <for each="e*(1,2,3)" apply="move" v="by"/></script>
      <script name="outer" hook="a*(0,1,2)"><where name="h" value="1"/>
        <for each="e*(1,2,3)" apply="inner" by="h*(e - mean(a, component))"/></script>)xml");
  const auto sheet = assets::grid(3, 2), was = assets::grid(3, 2);
  RuleContext context;
  context.wheres = {scalar_value(0.5)};
  ASSERT_TRUE(run(script, *sheet, first, context).ok);
  sheet->map().for_each_dart([&](Dart d) {
    const Vec3 x = was->position_of(d);
    EXPECT_LT((sheet->position_of(d) - (x + 0.5 * (x - Vec3(1.5, 1, 0)))).norm(), 1e-15);
  });
}

// Each step reads what the one before has left, and a vertex that has moved may be parted afterwards: as in
// edits of their own.
TEST(Script, is_its_steps_one_after_another) {
  const std::string lift = R"xml(<rule name="lift" left="a*(1,2,3)" right="a(1,2,3)">
      <set node="a" position="a + point(0, 0, 0.1*x(a) + 1)" velocity="point(0, 1, 0)"/></rule>)xml";
  const std::vector<std::pair<std::string, std::string>> steps{{"e*(1,2,3)", "lift"},
                                                               {"e*(0)", "unsew-edge"},
                                                               {"e*(1,2,3)", "lift"},
                                                               {"e*(0,1)", "star-face"},
                                                               {"e*(1,2,3)", "lift"}};
  std::string all;
  for (const auto& [each, name] : steps)
    all += "<for each=\"" + each + "\" apply=\"" + name + "\" at-least=\"none\"/>";
  const auto together = assets::grid(3, 2), apart = assets::grid(3, 2);
  ASSERT_TRUE(
      run(made(lift + "<script name=\"s\" hook=\"a*(0,1,2)\">" + all + "</script>"), *together, first).ok);
  for (const auto& [each, name] : steps) {
    const RuleOrScript single =
        name == "lift" ? made(lift)
                       : RuleOrScript(std::shared_ptr<const Rule>(std::shared_ptr<const Rule>(), &rule(name)));
    RuleOrScriptRunner runner(single);
    apply_round(*apart, runner);
  }
  EXPECT_EQ(count_cells(apart->map()).fragments, 6u);
  EXPECT_TRUE(isomorphism(together->map(), apart->map(), [&](Dart a, Dart b) {
    return (together->position_of(a) - apart->position_of(b)).norm() < 1e-14 &&
           (together->rest_of(a) - apart->rest_of(b)).norm() < 1e-14 &&
           together->velocity()[together->vertex(a)].vec() == apart->velocity()[apart->vertex(b)].vec();
  }));
}

// Four times as many faces at each of eight darts: what would grow for ever is taken back.
TEST(Script, that_grows_beyond_bounds_is_taken_back) {
  const auto script = made(R"xml(<script name="all" hook="a*()">
        <for each="e*(0,1,2,3)" apply="quarter-faces"/></script>
      <script name="bomb" hook="a*(0,1)"><for each="e*()" apply="all"/></script>)xml");
  const auto quad = assets::single_quad();
  const auto before = bytes_of(*quad);
  RuleContext context;
  context.most_darts = 5000;
  const Outcome refused = run(script, *quad, first, context);
  EXPECT_FALSE(refused.ok);
  EXPECT_TRUE(says(refused.reason, "lets the map grow beyond 5000 darts")) << refused.reason;
  EXPECT_EQ(bytes_of(*quad), before);
}

TEST(Script, creates_out_of_nothing) {
  const auto script = made(R"xml(<script name="s"><for apply="create-vertex"/>
      <for each="e*()" apply="extrude-vertex"/><for each="e*(0)" apply="extrude-edge"/>
      <for each="e*(0,1)" apply="star-face"/></script>)xml");
  EmbeddedMap body(2);
  const Outcome done = run(script, body);
  EXPECT_TRUE(done.ok) << done.reason;
  const CellCounts counts = count_cells(body.map());
  EXPECT_EQ(counts.vertices, 5u);
  EXPECT_EQ(counts.faces, 4u);
}

// A face whose neighbour was parted from it holds used darts, and waits for the next round.
TEST(Script, in_rounds_takes_orbits_that_are_not_used_up) {
  const auto script = made(R"xml(<script name="s" hook="a*(0,1)">
      <for each="e*(0)" apply="unsew-edge" at-least="none"/>
      <for each="e*(0,1)" apply="star-face"/></script>)xml");
  RuleOrScriptRunner runner(script);
  const auto sheet = assets::grid(3, 3);
  const RoundResult result = apply_round(*sheet, runner);
  EXPECT_EQ(result.applied, 5u); // as on a chessboard
  EXPECT_EQ(result.skipped, 4u);
  EXPECT_EQ(faces(*sheet), 9u + 3 * result.applied);
}

TEST(Script, is_printed_and_read_back_equal) {
  const std::string text = made(R"xml(<script name="s" about="a &lt; b" hook="a*( 0 , 1 )">
      <where name="t" value="2"/><when test="size(a,face)>=3" at="all" otherwise="why"/>
      <for each="e*(0)" which="old" where="length( e ) > t" at="any" apply="unsew-edge" at-least="one"/>
      <for each="f*(1,2,3)" apply="move" v="t * point(1,0,0)"/></script>)xml")
                               .print();
  EXPECT_EQ(made(text).print(), text);
  EXPECT_TRUE(says(text, R"xml(hook="a*(0,1)")xml")) << text;
  EXPECT_TRUE(says(text, R"xml(where="length(e) &gt; t" at="any" apply="unsew-edge" at-least="one")xml"))
      << text;
}

} // namespace
} // namespace rend::script_test
