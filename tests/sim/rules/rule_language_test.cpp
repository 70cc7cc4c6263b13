// What the expressions of rules may say: lets, neighbours, normals, means around a vertex, choices and marks,
// against the same by walks written out here.
#include "sim/house_rules/house_scripts.h"
#include "sim/rules/rule_symmetry.h"
#include "sim/rules/script_run.h"
#include "tests/sim/assets.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <random>
#include <set>

namespace rend::rule_language_test {
namespace {

// A rule that makes a dart b beside a dart a, at the place of the expression; lets before it.
Rule beside(const std::string& position, std::vector<RuleLetSettings> lets = {}) {
  return Rule(RuleSettings{.name = "beside",
                           .left = "a*",
                           .right = "a b b|0,1,2,3",
                           .sets = {{.node = "b", .position = position}},
                           .lets = std::move(lets)});
}

Vec3 point_at(const Rule& rule, const assets::Body& original, Dart d) {
  const assets::Body body = std::make_unique<EmbeddedMap>(original->map(), [&](Dart e) {
    return Point{original->position_of(e), original->rest_of(e), Vec3::Zero()};
  });
  const Applied done = apply(rule, *body, d);
  EXPECT_TRUE(done.ok) << done.reason;
  return done.ok ? body->position_of(done.dart("b")) : Vec3::Zero();
}

assets::Body uneven(assets::Body body) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> noise(-0.2, 0.2);
  for (Record& x : body->position().values())
    x = Record(x.vec() + Vec3(noise(random), noise(random), noise(random)));
  return body;
}

std::set<Dart> cells_of(const GMap& map, Orbit cell, Dart d) {
  std::set<Dart> firsts;
  for (Dart e : darts_of(map, Vertex, d)) firsts.insert(smallest_dart(map, cell, e));
  return firsts;
}

Vec3 middle_of(const EmbeddedMap& body, Orbit orbit, Dart d) {
  std::set<Slot> vertices;
  for (Dart e : darts_of(body.map(), orbit, d)) vertices.insert(body.vertex(e));
  Vec3 sum = Vec3::Zero();
  for (Slot v : vertices) sum += body.position()[v].vec() / static_cast<double>(vertices.size());
  return sum;
}

TEST(RuleLanguage, knows_neighbours_and_the_cells_around_a_vertex) {
  for (const bool solid : {false, true}) {
    const assets::Body body = uneven(solid ? assets::row_of_cubes(2) : assets::triangulated_grid(2, 2));
    const GMap& map = body->map();
    const Rule neighbours = beside("mean(a, neighbours)"), faces = beside("mean(a, faces)"),
               volumes = beside("mean(a, volumes)"),
               counts = beside("point(size(a, neighbours), size(a, faces), size(a, volumes))"),
               border = beside("if(size(a, border) > 0, mean(a, border), point(9, 9, 9))");
    for (Dart d : assets::all_darts(map)) {
      Vec3 ends = Vec3::Zero(), outer = Vec3::Zero();
      const std::set<Dart> edges = cells_of(map, Edge, d), of_faces = cells_of(map, Face, d),
                           of_volumes = cells_of(map, Volume, d);
      double on_border = 0;
      for (Dart e : edges) {
        Vec3 far = body->position_of(e);
        bool free = false;
        for (Dart c : darts_of(map, Edge, e)) {
          if (body->vertex(c) != body->vertex(d)) far = body->position_of(c);
          free = free || map.is_free(map.dimension(), c);
        }
        ends += far / static_cast<double>(edges.size());
        if (free) outer += far;
        on_border += free;
      }
      Vec3 of_all_faces = Vec3::Zero(), of_all_volumes = Vec3::Zero();
      for (Dart e : of_faces) of_all_faces += middle_of(*body, Face, e) / static_cast<double>(of_faces.size());
      for (Dart e : of_volumes)
        of_all_volumes += middle_of(*body, Volume, e) / static_cast<double>(of_volumes.size());
      EXPECT_LT((point_at(neighbours, body, d) - ends).norm(), 1e-14);
      EXPECT_LT((point_at(faces, body, d) - of_all_faces).norm(), 1e-14);
      EXPECT_LT((point_at(volumes, body, d) - of_all_volumes).norm(), 1e-14);
      EXPECT_EQ(point_at(counts, body, d),
                Vec3(static_cast<double>(edges.size()), static_cast<double>(of_faces.size()),
                     static_cast<double>(of_volumes.size())));
      const Vec3 expected = on_border > 0 ? Vec3(outer / on_border) : Vec3(9, 9, 9);
      EXPECT_LT((point_at(border, body, d) - expected).norm(), 1e-14);
    }
  }
}

TEST(RuleLanguage, follows_links_to_points_and_to_cells) {
  const assets::Body body = uneven(assets::row_of_cubes(2));
  const GMap& map = body->map();
  const Rule across = beside("alpha(alpha(a, 2), 0)"), twice = beside("mean(alpha(alpha(a, 3), 2), face)"),
             back = beside("copy(alpha(alpha(a, 1), 1))");
  for (Dart d : assets::all_darts(map)) {
    EXPECT_EQ(point_at(across, body, d), body->position_of(map.alpha(0, map.alpha(2, d))));
    EXPECT_LT((point_at(twice, body, d) - middle_of(*body, Face, map.alpha(2, map.alpha(3, d)))).norm(), 1e-14);
    EXPECT_EQ(point_at(back, body, d), body->position_of(d));
  }
}

// The normal of a face is that along which along() moves; of a cube it points outwards.
TEST(RuleLanguage, knows_normals) {
  const assets::Body body = assets::row_of_cubes(1);
  const Rule normal = beside("normal(a, face)"), at_vertex = beside("normal(a, vertex)"),
             moved = beside("a + 0.5*normal(a, face)"), along = beside("along(a, face, 0.5)");
  for (Dart d : assets::all_darts(body->map())) {
    const Vec3 out = (middle_of(*body, FaceOfVolume, d) - middle_of(*body, Volume, d)).normalized();
    EXPECT_LT((point_at(normal, body, d) - out).norm(), 1e-14);
    const Vec3 corner = (body->position_of(d) - middle_of(*body, Volume, d)).normalized();
    EXPECT_LT((point_at(at_vertex, body, d) - corner).norm(), 1e-14);
    EXPECT_LT((point_at(moved, body, d) - point_at(along, body, d)).norm(), 1e-15);
  }
}

TEST(RuleLanguage, lets_stand_for_their_expressions) {
  const assets::Body body = uneven(assets::grid(2, 2));
  const Rule named = beside("if(big, m + h*n, m)", {{.name = "h", .value = "0.25"},
                                                    {.name = "m", .value = "mean(a, face)"},
                                                    {.name = "n", .value = "normal(a, face)"},
                                                    {.name = "big", .value = "norm(m) > 1 + h"}});
  const Rule written =
      beside("if(norm(mean(a, face)) > 1 + 0.25, mean(a, face) + 0.25*normal(a, face), mean(a, face))");
  for (Dart d : assets::all_darts(body->map())) EXPECT_EQ(point_at(named, body, d), point_at(written, body, d));
}

// A let that uses the one before it twice, again and again, is evaluated once each.
TEST(RuleLanguage, lets_cost_no_more_than_they_are_long) {
  std::vector<RuleLetSettings> lets{{.name = "n0", .value = "a"}};
  for (int n = 1; n < 20; ++n)
    lets.push_back(
        {.name = fmt::format("n{}", n), .value = fmt::format("0.5*(n{0} + n{0} + n{0} - n{0})", n - 1)});
  const assets::Body body = assets::grid(1, 1);
  EXPECT_LT((point_at(beside("n19", lets), body, Dart{2u}) - body->position_of(Dart{2u})).norm(), 1e-12);
  lets.push_back({.name = "n20", .value = "n19 + n19"});
  EXPECT_THROW(beside("n20", lets), UserError);
}

TEST(RuleLanguage, refuses_lets_that_say_nothing_or_too_much) {
  const auto refusal = [](std::vector<RuleLetSettings> lets, const std::string& position = "a") -> std::string {
    try {
      beside(position, std::move(lets));
    } catch (const UserError& error) {
      return error.what();
    }
    return {};
  };
  const auto has = [](const std::string& all, const char* words) {
    return all.find(words) != std::string::npos;
  };
  EXPECT_TRUE(has(refusal({{.name = "m", .value = "m + a"}}), "there is no value 'm'"));
  EXPECT_TRUE(has(refusal({{.name = "a", .value = "1"}}), "'a' is the name of something else already"));
  EXPECT_TRUE(
      has(refusal({{.name = "m", .value = "1"}, {.name = "m", .value = "2"}}), "something else already"));
  EXPECT_TRUE(has(refusal({{.name = "if", .value = "1"}}), "if is a function of expressions"));
  EXPECT_TRUE(has(refusal({{.name = "m", .value = ""}}), "value"));
  EXPECT_TRUE(has(refusal({}, "alpha(a, 4)"), "alpha(a, 4) follows no link"));
  EXPECT_TRUE(has(refusal({}, "alpha(a, 12)"), "follows no link"));
  EXPECT_TRUE(has(refusal({}, "alpha(c, 1)"), "the left graph has no node 'c'"));
  EXPECT_TRUE(has(refusal({}, "mean(alpha(a, 2, 1), face)"), "',' stands outside"));
  EXPECT_TRUE(has(refusal({}, "alpha(a, x(a))"), "takes a name and a whole number"));
  EXPECT_TRUE(has(refusal({}, "mean(mean(a, face), face)"), "is a name, a single word"));
  EXPECT_TRUE(has(refusal({}, "if(1, a, a)"), "'if' takes a condition first"));
  EXPECT_TRUE(has(refusal({}, "if(1 > 0, a, 2)"), "the two values of 'if' are a vector and a scalar"));
  EXPECT_TRUE(has(refusal({}, "if(1 > 0, a)"), "'if' takes three arguments"));
  EXPECT_TRUE(has(refusal({}, "if(1 > 0, a, a, a)"), "',' stands outside"));
  EXPECT_TRUE(has(refusal({}, "normal(a, edge)"), "'edge' is no cell with a normal"));
}

// A word and its form lead to the same orbit, in maps of all kinds.
TEST(RuleSymmetry, normal_words_are_those_of_the_relations) {
  EXPECT_EQ(normal_word("22", Orbit{}), "");
  EXPECT_EQ(normal_word("2012", Orbit{}), "0212");
  EXPECT_EQ(normal_word("020", Orbit{}), "2");
  EXPECT_EQ(normal_word("0130", Orbit{}), normal_word("0103", Orbit{}));
  EXPECT_EQ(normal_word("10", Face), "");
  EXPECT_EQ(normal_word("21", Face), "2");
  EXPECT_EQ(normal_word("120", Face), "12");
  EXPECT_EQ(normal_word("210", Vertex), "210");
  std::mt19937 random(7);
  const auto bodies = {assets::row_of_cubes(2), assets::triangulated_grid(2, 2),
                       assets::random_sewing(2, 12, 4000)};
  for (int n = 0; n < 2000; ++n) {
    std::string word;
    for (auto k = random() % 7; k > 0; --k) word += static_cast<char>('0' + random() % 4);
    const Orbit orbit = std::array{Vertex, Edge, Face, Volume, FaceOfVolume, Orbit{}}[random() % 6];
    const std::string form = normal_word(word, orbit);
    EXPECT_LE(form.size(), word.size());
    EXPECT_EQ(normal_word(form, orbit), form);
    for (const auto& body : bodies) {
      const Dart d{static_cast<std::uint32_t>(random() % body->map().capacity())};
      if (!body->map().alive(d)) continue;
      EXPECT_TRUE(same_cell(body->map(), orbit, body->map().follow(d, word), body->map().follow(d, form)))
          << word << " and " << form;
    }
  }
}

TEST(RuleSymmetry, knows_what_two_sides_of_an_edge_have_in_common) {
  const auto edge = [](const char* position) {
    return Rule(RuleSettings{.name = "r",
                             .left = "a*(0,2) a|3",
                             .right = "a(_,2) c(1,2) a-0-c a|3 c|3",
                             .sets = {{.node = "c", .position = position}}});
  };
  for (const char* same :
       {"(mean(a, face) + mean(alpha(a, 2), face))/2",
        "if(free(a, 2), mean(a, edge), (2*mean(a, edge) + mean(a, face) + mean(alpha(a, 2), face))/4)",
        "(a + alpha(a, 0))/2",
        "(alpha(alpha(alpha(a, 2), 1), 0) + alpha(alpha(a, 1), 0) + "
        "alpha(alpha(alpha(a, 0), 1), 0) + alpha(alpha(alpha(alpha(a, 0), 2), 1), 0))/4"})
    EXPECT_NO_THROW(edge(same)) << same;
  for (const char* differs : {"mean(alpha(a, 2), face)", "(2*mean(a, face) + mean(alpha(a, 2), face))/3",
                              "alpha(a, 0)", "if(free(a, 1), mean(a, edge), a)", "along(a, edge, 0.5)",
                              "along(a, edge, x(a))", "(a + alpha(alpha(a, 1), 0))/2"})
    EXPECT_THROW(edge(differs), UserError) << differs;
}

// A step marks the faces that it has made; the next one takes those alone, and one after that the rest.
TEST(ScriptMarks, are_asked_for_by_later_steps_and_their_rules) {
  const Rule only_marked(RuleSettings{.name = "raise-marked",
                                      .left = "a*(1,2,3)",
                                      .right = "a(1,2,3)",
                                      .sets = {{.node = "a", .position = "a + point(0, 0, 1)"}},
                                      .whens = {{.test = "marked(a, made)", .at = RuleWhenSettings::At::Any}}});
  ScriptSettings settings{.name = "s", .hook = "a*(0,1,2,3)"};
  settings.steps = {
      {.each = "e*(0,1)", .test = "x(mean(e, face)) < 1", .apply = "star-face", .mark = "made"},
      {.each = "e*(1,2,3)",
       .test = "marked(e, made)",
       .at = RuleWhenSettings::At::Any,
       .apply = "move",
       .arguments = {{"v", "point(0, 0, 0.5)"}}},
      {.each = "e*(1,2,3)", .apply = "raise-marked", .at_least = ScriptStepSettings::AtLeast::None}};
  const Script made(settings, [&](const ScriptStepSettings& step) -> RuleOrScript {
    if (step.apply == "raise-marked")
      return {std::shared_ptr<const Rule>(std::shared_ptr<void>(), &only_marked)};
    return *find_house_rule_or_script(step.apply);
  });
  const auto body = assets::grid(3, 1); // three quads, from x = 0 to 3
  ScriptRunner runner(made);
  bool applied = false;
  body->edit([&](Edit& edit) { applied = runner.apply(edit, Dart{0u}); });
  ASSERT_TRUE(applied) << runner.reason();
  EXPECT_EQ(count_cells(body->map()).faces, 6u);
  for (Dart d : assets::all_darts(body->map())) {
    const Vec3 x = body->position_of(d);
    EXPECT_EQ(x.z(), x.x() <= 1 ? 1.5 : 0) << x.transpose();
  }
}

TEST(ScriptMarks, that_no_step_sets_are_refused) {
  ScriptSettings settings{.name = "s", .hook = "a*(0,1)"};
  settings.steps = {{.each = "e*(0,1)", .test = "marked(e, mad)", .apply = "star-face", .mark = "made"}};
  try {
    const Script made(settings,
                      [&](const ScriptStepSettings& step) { return *find_house_rule_or_script(step.apply); });
    FAIL();
  } catch (const UserError& error) {
    EXPECT_NE(std::string(error.what()).find("no step sets the mark 'mad'"), std::string::npos) << error.what();
    EXPECT_NE(error.hint.find("did you mean 'made'?"), std::string::npos);
  }
}

} // namespace
} // namespace rend::rule_language_test
