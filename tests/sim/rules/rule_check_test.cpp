// Rules that are refused, and why: every condition of rule_check.h, in every dimension; and what else a user
// may write. Each refusal is a UserError with code 65 that blames one attribute.
#include "sim/rules/rule_check.h"

#include "sim/base/error.h"
#include "sim/house_rules/house_rules.h"
#include "tests/sim/assets.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <chrono>

namespace rend::rule_check_test {
namespace {

struct Refusal {
  Exit code = Exit::Done;
  std::string what;
  std::string blamed; // "left", "set position", "when test", "rule" (as a whole)
};

SettingsSource source_of(const std::string& element) {
  SettingsSource source;
  source.place_of = [element](std::string_view attribute) {
    return Place{element.empty() && attribute.empty() ? "rule" : element + std::string(attribute), 1, 1};
  };
  source.is_given = [](std::string_view) { return true; };
  return source;
}

// Anything but a UserError is thrown on, and fails the test.
Refusal refusal(RuleSettings settings) {
  if (settings.name.empty()) settings.name = "R";
  settings.source = source_of("");
  for (auto& set : settings.sets) set.source = source_of("set ");
  for (auto& when : settings.whens) when.source = source_of("when ");
  for (auto& where : settings.wheres) where.source = source_of("where ");
  try {
    const Rule rule(std::move(settings));
  } catch (const UserError& error) {
    const std::string what = error.what();
    const std::size_t end = what.find(":1:1: ");
    if (end == std::string::npos) return {error.code, what, "(no place)"};
    return {error.code, what.substr(end + 6), what.substr(0, end)};
  }
  return {};
}

struct Illegal {
  RuleSettings rule;
  const char* words;  // of the message
  const char* blamed; // attribute
};

void expect_refused(const std::vector<Illegal>& all) {
  for (const Illegal& each : all) {
    SCOPED_TRACE(fmt::format("left \"{}\" right \"{}\"", each.rule.left, each.rule.right));
    const Refusal found = refusal(each.rule);
    EXPECT_EQ(found.code, Exit::BadInput);
    EXPECT_EQ(found.blamed, each.blamed) << found.what;
    EXPECT_NE(found.what.find(each.words), std::string::npos) << found.what;
  }
}

using Sets = std::vector<RuleSetSettings>;

TEST(RuleCheck, hooks_and_labels) {
  expect_refused({
      // 1. One hook in every connected part of the left graph, none on the right.
      {{.left = "a(0,1) a|3", .right = "a(0,1) a|3"}, "no hook leads to node a", "left"},
      {{.left = "a*(0) b(0) c(0) a-2-b", .right = "a(0) b(0) c(0) a-2-b"}, "no hook leads to node c", "left"},
      {{.left = "a* b c d a-0-b c-0-d", .right = "a b c d a-0-b c-0-d"}, "no hook leads to node c", "left"},
      {{.left = "a*(0) b*(0) a-2-b", .right = "a(0) b(0) a-2-b"}, "two hooks lead to node a", "left"},
      {{.left = "a* b c* a-0-b b-3-c", .right = "a b c a-0-b b-3-c"}, "two hooks lead to node a", "left"},
      {{.left = "a*(0,1)", .right = "a*(0,1)"}, "node a of the right graph has a star", "right"},
      {{.left = "", .right = "a* a|0,1,2,3", .sets = {{.node = "a", .position = "point(0,0,0)"}}},
       "node a of the right graph has a star",
       "right"},
      // Labels are as long as the hook's, and the hook's have no gap.
      {{.left = "a*(0,1)", .right = "a(0)"},
       "the label of node a has 1 links, and that of hook a has 2",
       "right"},
      {{.left = "a*(0,1) b(0) a-3-b", .right = "a(0,1) b(0,1) a-3-b"},
       "the label of node b has 1 links",
       "left"},
      {{.left = "a*", .right = "a(2)"}, "the label of node a has 1 links, and that of hook a has 0", "right"},
      {{.left = "a*(0,1,2,3)", .right = "a(0,1,2,3) b"}, "the label of node b has 0 links", "right"},
      {{.left = "", .right = "a(0) a|1,2,3"}, "node a has a label, and there is no hook", "right"},
      {{.left = "a*(0) b*(0,1)", .right = "a(0) b(0,1)"}, "the label of node b has 2 links", "left"},
      {{.left = "a*(0,_,2)", .right = "a(0,_,2)"}, "the label of hook a drops a link", "left"},
      {{.left = "a*(0) b*(_) a|2 b|0", .right = "a(0) b(_) a|2 b|0"},
       "the label of hook b drops a link",
       "left"},
  });
}

TEST(RuleCheck, incident_arcs) {
  std::vector<Illegal> all;
  for (int i = 0; i < 4; ++i) { // in each dimension
    std::string others, loops;
    for (int j = 0; j < 4; ++j)
      if (j != i) others += (others.empty() ? "" : ",") + std::to_string(j);
    all.push_back({{.left = "a*", .right = fmt::format("a a|{}", i)},
                   i == 0   ? "node a is kept but gains α0"
                   : i == 1 ? "node a is kept but gains α1"
                   : i == 2 ? "node a is kept but gains α2"
                            : "node a is kept but gains α3",
                   "right"});
    all.push_back({{.left = fmt::format("a* a|{}", i), .right = "a"},
                   i == 0   ? "node a is kept but loses α0"
                   : i == 1 ? "node a is kept but loses α1"
                   : i == 2 ? "node a is kept but loses α2"
                            : "node a is kept but loses α3",
                   "right"});
    all.push_back({{.left = fmt::format("a* a|{}", others), .right = ""},
                   i == 0   ? "node a is removed, but what its α0 leads to is not matched"
                   : i == 1 ? "node a is removed, but what its α1 leads to is not matched"
                   : i == 2 ? "node a is removed, but what its α2 leads to is not matched"
                            : "node a is removed, but what its α3 leads to is not matched",
                   "left"});
    all.push_back({{.left = "",
                    .right = fmt::format("a a|{}", others),
                    .sets = {{.node = "a", .position = "point(0, 0, 0)"}}},
                   i == 0   ? "the new node a does not say what its α0 is"
                   : i == 1 ? "the new node a does not say what its α1 is"
                   : i == 2 ? "the new node a does not say what its α2 is"
                            : "the new node a does not say what its α3 is",
                   "right"});
  }
  all.insert(
      all.end(),
      {
          {{.left = "a*(0,1)", .right = "a(0,_)"}, "node a is kept but loses α1", "right"},
          {{.left = "a*(0,1)", .right = "a(0,2)"}, "node a is kept but loses α1", "right"},
          {{.left = "a*(0) b(0) a-2-b", .right = "a(0) a|2"}, "node b is removed, but what its α1", "left"},
          {{.left = "a*(0,1) b(0,_) a-2-b", .right = "a(0,1) a|2"}, "node b is removed", "left"},
          {{.left = "a*(0,1) a|3", .right = "a(0,1) b(0,1) a|3 b|3"}, "the new node b does not say", "right"},
      });
  expect_refused(all);
}

TEST(RuleCheck, cycles) {
  const auto at_middle = [](const char* node) {
    return Sets{{.node = node, .position = "mean(a, component)"}};
  };
  expect_refused({
      // Two explicit links whose square does not close, for each pair that commutes.
      {{.left = "a* b a-0-b a|2 b|2",
        .right = "a b c d a-0-b a-2-c b-2-d c|0,1,3 d|0,1,3",
        .sets = at_middle("c")},
       "at node a, α0α2 is no involution any more",
       "right"},
      {{.left = "a* b a-0-b a|3 b|3",
        .right = "a b c d a-0-b a-3-c b-3-d c|0,1,2 d|0,1,2",
        .sets = at_middle("c")},
       "at node a, α0α3 is no involution any more",
       "right"},
      {{.left = "a* b a-1-b a|0,3 b|0,3", .right = "a b c d a-1-b a|0 b|0 a-3-c b-3-d c|0,1,2 d|0,1,2"},
       "at node a, α1α3 is no involution any more",
       "right"},
      {{.left = "a* b a-0-b a|2 b|2", .right = "a b c d a-0-b a-2-c b-2-d c-1-d c|0,3 d|0,3"},
       "at node a, α0α2 is no involution any more",
       "right"},
      {{.left = "a* b a-2-b", .right = "a b a|2 b|2"}, "at node a, α0α2 is no involution any more", "right"},
      {{.left = "a*(0) b(0) a-3-b", .right = "a(0) b(0) a|3 b|3"},
       "at node a, α1α3 is no involution any more",
       "right"},
      {{.left = "a* a|3", .right = "a b a-3-b b|0,1,2"}, "at node a, α0α3 is no involution any more", "right"},
      {{.left = "a* a|1", .right = "a b a-1-b b|0,2,3"}, "at node a, α1α3 is no involution any more", "right"},
      {{.left = "a* a|0", .right = "a b a-0-b b|1,2,3"}, "at node a, α0α2 is no involution any more", "right"},
      // One explicit, one implicit: across the arc the link is at another position, dropped, or explicit.
      {{.left = "a*(0,2) a|3", .right = "a(0,2) b(2,0) a-3-b b|1", .sets = at_middle("b")},
       "at node a, α0α3 is no involution any more",
       "right"},
      {{.left = "a*(0) a|2", .right = "a(0) b(_) a-2-b b|0,1,3", .sets = at_middle("b")},
       "at node a, α0α2 is no involution any more",
       "right"},
      {{.left = "a*(0,1) a|3", .right = "a(0,1) b(0,_) a-3-b b|1,2"},
       "at node a, α1α3 is no involution any more",
       "right"},
      {{.left = "a*(0) a|3", .right = "a(0) b(1) a-3-b b|0,2"},
       "at node a, α0α3 is no involution any more",
       "right"},
      {{.left = "a*(0,1) a|3", .right = "a(0,1) b(1,0) a-3-b b|2"},
       "at node a, α0α3 is no involution any more",
       "right"},
      // Two implicit ones: the hook's links at their positions do not commute.
      {{.left = "a*(0,1)", .right = "a(0,1) b(0,2) b|1,3", .sets = at_middle("b")},
       "at node b, α0α2 is no involution any more",
       "right"},
      {{.left = "a*(0,1)", .right = "a(0,1) b(1,3) b|0,2", .sets = at_middle("b")},
       "at node b, α1α3 is no involution any more",
       "right"},
      {{.left = "a*(1,2)", .right = "a(1,2) b(0,3) b|1,2", .sets = at_middle("b")},
       "at node b, α0α3 is no involution any more",
       "right"},
      {{.left = "a*(2,3)", .right = "a(2,3) b(3,0) b|1,2", .sets = at_middle("b")},
       "at node b, α0α3 is no involution any more",
       "right"},
  });
}

TEST(RuleCheck, rules_that_may_fold_only_unlink) {
  expect_refused({
      {{.left = "a*(0) a|2", .right = "a(0) b(0) a-2-b b|1,3", .may_fold = true},
       "is linked by a rule that may fold",
       "right"},
      {{.left = "a*(0) a|3", .right = "a(0) a|3 b(0) b|1,2,3", .may_fold = true}, "node b is created", "right"},
      {{.left = "a*(0) b*(0) a|2 b|2", .right = "a(0) b(0) a-2-b", .may_fold = true},
       "α2 of node a is linked by a rule that may fold",
       "right"},
      {{.left = "a*(0,1) a|2,3", .right = "", .may_fold = true}, "node a is removed", "left"},
      {{.left = "a*(0,1,2) a|3", .right = "a(2,1,0) a|3", .may_fold = true},
       "α0 of node a is linked by a rule that may fold",
       "right"},
  });
}

TEST(RuleCheck, notation) {
  expect_refused({
      {{.left = "a*(0,1,2,3,0)", .right = ""}, "more than four links (character 12 of left)", "left"},
      {{.left = "a* a-2-a", .right = ""}, "an arc joins node a to itself by α2", "left"},
      {{.left = "a*(0) a-2-b", .right = "a(0)"}, "the left graph has no node 'b'", "left"},
      {{.left = "a*(0)", .right = "a(0) b-2-a"}, "the right graph has no node 'b'", "right"},
      {{.left = "a*(0) a", .right = "a(0)"}, "two nodes are called a", "left"},
      {{.left = "a*(0) a|0", .right = "a(0)"}, "node a says twice what its α0 is", "left"},
      {{.left = "a*(5)", .right = "a"}, "a link is 0, 1, 2 or 3", "left"},
      {{.left = "a*(0)", .right = "a(0"}, "the label of a is not closed", "right"},
      {{.left = std::string(10u << 20u, 'a'), .right = ""}, "the text is longer than 32768 characters", "left"},
      {{.left = "a*", .right = std::string(10u << 20u, '(')}, "the text is longer than", "right"},
      {{.left = std::string(10000, '('), .right = ""}, "'(' begins no node's name", "left"},
      {{.left = std::string("a*(0)\0b", 7), .right = "a(0)"}, "does not belong here", "left"},
      {{.left = std::string(60, 'a') + "*", .right = ""}, "the name of a node is longer than 50", "left"},
  });
}

TEST(RuleCheck, names_and_values_of_vertices) {
  const auto star = [](Sets sets) {
    return RuleSettings{.left = "a*(0,1) a|3",
                        .right = "a(0,_) b(_,2) c(1,2) a-1-b b-0-c a|3 b|3 c|3",
                        .sets = std::move(sets)};
  };
  const auto at = [&](const std::string& position) { return star({{.node = "c", .position = position}}); };
  expect_refused({
      {star({}), "the new vertex of node c has no position", "right"},
      {star({{.node = "c", .velocity = "point(0, 0, 1)"}}), "the new vertex of node c has no position",
       "right"},
      {star({{.node = "c"}}), "<set> sets nothing", "set "},
      {star({{.node = "d", .position = "a"}}), "the right graph has no node 'd'", "set node"},
      {star({{.position = "a"}}), "the right graph has no node ''", "set node"},
      {star({{.node = "c", .position = "mean(a, face)"}, {.node = "c", .position = "mean(a, face)"}}),
       "the vertex of node c is set twice", "set node"},
      {star({{.node = "c", .position = "mean(a, face)"},
             {.node = "a", .position = "a"},
             {.node = "b", .position = "a"}}),
       "the vertex of node b is set twice", "set node"},
      {at("means(a, face)"), "there is no function 'means'", "set position"},
      {at("mean(b, face)"), "the left graph has no node 'b'", "set position"},
      {at("copy(d)"), "the left graph has no node 'd'", "set position"},
      {at("mean(a, fase)"), "'fase' is no orbit", "set position"},
      {at("along(a, norm, 1)"), "'norm' is no direction", "set position"},
      {at("mean(a)"), "'mean' takes 2 arguments", "set position"},
      {at("d + mean(a, face)"), "there is no value 'd'", "set position"},
      {at("size(a, face)"), "the expression is a scalar, where a vector is wanted", "set position"},
      {at("mean(a, face) > 1"), "'>' takes two scalars", "set position"},
      {at("mean(a, face) +"), "ends where a value is expected", "set position"},
      {at("mean(a, face) * mean(a, face)"), "'*' takes", "set position"},
      {at("point(1/0, 0, 0)"), "1 / 0 is not a finite number", "set position"},
      {at("point(0, 0, sqrt(-1))"), "is not a finite number", "set position"},
      {at("point(0, 0, 1e999)"), "is too large", "set position"},
      {at(std::string(10000, '(') + "a" + std::string(10000, ')')), "the expression has 20001 characters",
       "set position"},
      {at(std::string(1500, '(') + "a" + std::string(1500, ')')), "more than 50 parentheses", "set position"},
      {at(std::string(1500, '-') + "a"), "more than 50 parentheses, signs", "set position"},
      {at(std::string(10u << 20u, 'a')), "the expression has 10485760 characters", "set position"},
      {star({{.node = "c", .position = "mean(a, face)", .rest = "nowhere"}}), "no value 'nowhere'", "set rest"},
      {star({{.node = "c", .position = "mean(a, face)", .velocity = "1"}}), "a vector is wanted",
       "set velocity"},
  });
  std::string endless = "a";
  while (endless.size() < 3900) endless += " + n" + std::to_string(endless.size());
  expect_refused({{at(endless), "there is no value 'n1'", "set position"}});
  std::string names = "a*(0,1)";
  for (int n = 0; n < 1200; ++n) names += " n" + std::to_string(n);
  expect_refused({{{.left = names, .right = ""}, "there are more than 1000 nodes", "left"}});
}

// Where the point of a vertex that was two would hang on the numbers of darts.
TEST(RuleCheck, vertices_that_become_one_need_a_position) {
  const auto sewn = [](Sets sets) {
    return RuleSettings{.left = "a*(0) b*(0) a|2 b|2", .right = "a(0) b(0) a-2-b", .sets = std::move(sets)};
  };
  // An edge shrinks to a vertex: α0 of its ends becomes α2, so that both are of one vertex.
  const auto shrunk = [](Sets sets) {
    return RuleSettings{.left = "a*(0) a|2,3", .right = "a(2) a|0,3", .sets = std::move(sets)};
  };
  const auto collapsed = [](Sets sets) {
    return RuleSettings{.left = "a*(0,1) a|2,3 b*(0,1) b|2,3",
                        .right = "a(0,_) b(0,_) a-1-b a|2,3 b|2,3",
                        .sets = std::move(sets)};
  };
  expect_refused({
      {sewn({}),
       "nodes a and b are of two vertices on the left and of one on the right, and no <set> says where that is",
       "right"},
      {sewn({{.node = "a", .rest = "a"}}), "nodes a and b are of two vertices on the left", "right"},
      {sewn({{.node = "b", .velocity = "point(0, 0, 0)"}}), "nodes a and b are of two vertices on the left",
       "right"},
      {shrunk({}), "the vertices of node a at both ends of the hook's α0 become one", "right"},
      {collapsed({}), "nodes a and b are of two vertices on the left", "right"},
  });
  const std::vector<RuleSettings> accepted{
      sewn({{.node = "a", .position = "a"}}),
      sewn({{.node = "b", .position = "lerp(a, b, 0.5)"}}),
      shrunk({{.node = "a", .position = "mean(a, edge)"}}),
      collapsed({{.node = "b", .position = "lerp(a, b, 0.5)"}}),
      // One vertex before: by the links of the left graph, or by three sides of a square of α0 and α2.
      {.left = "a*(3) c(3) b*(3) d(3) a-1-c b-1-d",
       .right = "a(3) c(3) b(3) d(3) e(3) f(3) g(3) h(3) a-1-e c-1-f b-1-g d-1-h e-0-g f-0-h e-2-f g-2-h"},
      {.left = "a* b c d a-0-b b-2-c c-0-d a|1,3 d|1,3", .right = "a b c d a-0-b b-2-c c-0-d a-1-d a|3 d|3"}};
  for (const RuleSettings& each : accepted) EXPECT_EQ(refusal(each).what, "") << each.right;
}

// Whatever the numbers of darts: two quads that do not touch are sewn halfway, from either of them.
TEST(RuleCheck, vertices_that_become_one_are_where_the_rule_says) {
  const Rule sew(RuleSettings{.name = "sew",
                              .left = "a*(0) b*(0) a|2 b|2",
                              .right = "a(0) b(0) a-2-b",
                              .sets = {{.node = "a", .position = "lerp(a, b, 0.25)"}}});
  for (bool first : {true, false}) {
    EmbeddedMap map(2);
    std::vector<Dart> one, other;
    map.edit([&](Edit& edit) {
      one = assets::create_polygon(edit, std::vector{assets::at(0, 0), assets::at(1, 0), assets::at(0, 1)});
      other =
          assets::create_polygon(edit, std::vector{assets::at(0, -4), assets::at(1, -4), assets::at(0, -8)});
    });
    const Hooks hooks = first ? Hooks{one[0], other[0]} : Hooks{other[0], one[0]};
    ASSERT_TRUE(apply(sew, map, hooks).ok);
    EXPECT_EQ(map.position_of(one[0]), Vec3(0, first ? -1 : -3, 0));
    EXPECT_EQ(map.position_of(one[1]), Vec3(1, first ? -1 : -3, 0));
    EXPECT_EQ(map.rest_of(other[1]), map.position_of(one[1]));
  }
}

TEST(RuleCheck, warns_of_cells_that_are_open_at_a_border) {
  const auto warnings = [](RuleSettings settings) {
    settings.name = "R";
    const Rule rule(std::move(settings));
    std::string all;
    for (const RuleWarning& each : rule.warnings) all += each.what + "\n";
    return all;
  };
  for (const Rule& rule : house_rules()) EXPECT_EQ(rule.warnings.size(), 0u) << rule.name();
  EXPECT_EQ(
      warnings({.left = "a*(0,1,2) a|3",
                .right = "a(0,1,2) b(_,_,0) a|3 b|1,2,3",
                .sets = {{.node = "b", .position = "mean(a, component)"}}}),
      "rule 'R': at the border of a sheet, α2 of the hook is free, and with it α0 of node b: a face is open "
      "there\n");
  EXPECT_EQ(warnings({.left = "a*(0,1,2) a|3",
                      .right = "a(0,1,2) b(_,_,0) a|3 b|1,2,3",
                      .sets = {{.node = "b", .position = "mean(a, component)"}},
                      .whens = {{.test = "not free(a, 2)", .at = RuleWhenSettings::At::All}}}),
            "");
  EXPECT_EQ(
      warnings({.left = "a*(3)",
                .right = "a(3) b(2) b|0,1,3",
                .sets = {{.node = "b", .position = "mean(a, component)"}}}),
      "rule 'R': on the hull of a solid, α3 of the hook is free, and with it α2 of node b: a volume is open "
      "there\n");
}

TEST(RuleCheck, values_that_differ_between_the_darts_of_a_vertex) {
  const auto edge = [](const char* position) {
    return RuleSettings{
        .left = "a*(0,2,3)", .right = "a(_,2,3) c(1,2,3) a-0-c", .sets = {{.node = "c", .position = position}}};
  };
  const auto volume = [](const char* position) {
    return RuleSettings{.left = "a*(0,1,2)",
                        .right = "a(0,1,_) b(0,_,3) c(_,2,3) d(1,2,3) a-2-b b-1-c c-0-d",
                        .sets = {{.node = "d", .position = position}}};
  };
  const char* differs = "is not the same at all darts of the vertex of node";
  expect_refused({
      {edge("a"), differs, "set position"},
      {edge("copy(a)"), differs, "set position"},
      {edge("lerp(a, mean(a, edge), 0.3)"), differs, "set position"},
      {edge("mean(a, edge) + 1e-3 * a"), differs, "set position"},
      {edge("mean(a, face)"), differs, "set position"},   // the faces around the edge
      {edge("mean(a, volume)"), differs, "set position"}, // and the volumes
      {edge("along(a, normal, 0.1)"), differs, "set position"},
      {edge("along(a, edge, length(a) / 2)"), differs, "set position"}, // equal but for rounding; not known
      {edge("mean(a, edge) * size(a, vertex)"), differs, "set position"},
      {edge("mean(a, edge) + point(area(a), 0, 0)"), differs, "set position"},
      {volume("mean(a, edge)"), differs, "set position"},
      {volume("mean(a, face)"), differs, "set position"},
      {volume("lerp(mean(a, volume), a, 0.001)"), differs, "set position"},
  });
  // A kept vertex that moves: all its darts must agree on where.
  expect_refused({
      {{.left = "a*(1,2,3)", .right = "a(1,2,3)", .sets = {{.node = "a", .position = "mean(a, edge)"}}},
       differs,
       "set position"},
      {{.left = "a*(1,2,3)", .right = "a(1,2,3)", .sets = {{.node = "a", .rest = "mean(a, face)"}}},
       differs,
       "set rest"},
      {{.left = "a*(0,1)", .right = "a(0,1)", .sets = {{.node = "a", .velocity = "mean(a, edge)"}}},
       differs,
       "set velocity"},
      // Of both sides of a face, the normals point away from each other.
      {{.left = "a*(0,1,3)", .right = "a(0,1,3)", .sets = {{.node = "a", .position = "along(a, face, 0.1)"}}},
       differs,
       "set position"},
  });
  for (const char* fine :
       {"mean(a, edge)", "mean(a, edge) * length(a)", "lerp(mean(a, edge), point(0, 0, 1), 0.3)",
        "mean(a, component)", "mean(a, edge) + point(size(a, edge), 0, 0)"})
    EXPECT_EQ(refusal(edge(fine)).what, "") << fine;
}

TEST(RuleCheck, conditions_and_arguments) {
  const auto when = [](const std::string& test) {
    return RuleSettings{.left = "a*(0,1)", .right = "a(0,1)", .whens = {{.test = test}}};
  };
  const auto where = [](const char* name, const char* value) {
    return RuleSettings{.left = "a*(0,1)", .right = "a(0,1)", .wheres = {{.name = name, .value = value}}};
  };
  expect_refused({
      {when("size(a, face)"), "is a scalar, where a condition is wanted", "when test"},
      {when("mean(a, face)"), "is a vector, where a condition is wanted", "when test"},
      {when("size(b, face) > 3"), "the left graph has no node 'b'", "when test"},
      {when("1/0 > 0"), "1 / 0 is not a finite number", "when test"},
      {when("1 < 2 < 3"), "'<' takes two scalars", "when test"},
      {when(""), "empty", "when test"},
      {when(std::string(10u << 20u, '(')), "the expression has 10485760 characters", "when test"},
      {{.left = "",
        .right = "a a|0,1,2,3",
        .sets = {{.node = "a", .position = "point(0, 0, 0)"}},
        .whens = {{.test = "1 < 2"}}},
       "a rule without a left graph has nothing to test",
       "when test"},
      {where("h", "1/0"), "1 / 0 is not a finite number", "where value"},
      {where("h", "a"), "a <where> knows no nodes, and 'a' speaks of one", "where value"},
      {where("h", "mean(a, face)"), "a <where> knows no nodes, and 'mean(a, face)' speaks of one",
       "where value"},
      {where("h", "mean(b, face)"), "there is no function 'mean'", "where value"},
      {where("h", "1 > 2"), "is a condition, where", "where value"},
      {where("a", "1"), "'a' is a node's name already", "where name"},
      {where("sin", "1"), "sin is a function of expressions", "where name"},
      {where("mean", "1"), "mean is a function of expressions", "where name"},
      {where("and", "1"), "and is a function of expressions", "where name"},
      {where("two words", "1"), "'two words' is no name", "where name"},
      {where("9", "1"), "'9' is no name", "where name"},
      {where("", "1"), "'' is no name", "where name"},
      {{.left = "a*(0)", .right = "a(0)", .wheres = {{.name = "h", .value = "1"}, {.name = "h", .value = "2"}}},
       "two arguments are called 'h'",
       "where name"},
      {{.left = "time*(0)", .right = "time(0)"},
       "time is a function of expressions, and no name of a node",
       "left"},
      {{.left = "a*(0) max*(0)", .right = "a(0) max(0)"}, "max is a function of expressions", "left"},
      {{.left = "or*", .right = "or"}, "or is a function of expressions", "left"},
      {{.left = "a*(0)",
        .right = "a(0)",
        .wheres = std::vector<RuleWhereSettings>(1001, {.name = "h", .value = "1"})},
       "more than 1000 expressions",
       "rule"},
  });
}

TEST(RuleCheck, a_message_holds_no_more_of_a_name_than_a_line) {
  RuleSettings settings{.name = std::string(1u << 20u, 'x') + "\n\x1b[31m", .left = "a", .right = ""};
  const Refusal found = refusal(settings);
  EXPECT_EQ(found.code, Exit::BadInput);
  EXPECT_LT(found.what.size(), 300u);
  EXPECT_EQ(found.what.find('\n'), std::string::npos);
}

// As many nodes, expressions and words as the bounds allow: it takes a moment, not minutes.
TEST(RuleCheck, the_largest_rule_that_is_read_is_checked_in_a_moment) {
  std::string nodes = "n0*(3)", chain;
  for (int n = 1; n < 1000; ++n) {
    nodes += fmt::format(" n{}(3)", n);
    chain += fmt::format(" n{}-{}-n{}", n - 1, 1 - n % 2, n);
  }
  RuleSettings settings{.left = nodes + chain, .right = "n0(3)" + nodes.substr(6) + chain};
  std::string words = "n0";
  while (words.size() < 3900) words += "+n9";
  for (int n = 0; n < 1000; ++n) settings.whens.push_back({.test = fmt::format("norm({}) > {}", words, n)});
  const auto begin = std::chrono::steady_clock::now();
  EXPECT_EQ(refusal(settings).what, "");
  EXPECT_LT(std::chrono::steady_clock::now() - begin, std::chrono::seconds(60));
}

TEST(RuleCheck, two_implicit_links_are_judged_by_the_hooks_names) {
  // α0 and α3 of the hook commute; renamed to α1 and α3 on a copy they still do.
  const Sets at_edge{{.node = "b", .position = "mean(a, edge)"}};
  EXPECT_EQ(refusal({.left = "a*(0,3)", .right = "a(0,3) b(1,3) b|0,2", .sets = at_edge}).what, "");
  EXPECT_NE(refusal({.left = "a*(0,1)", .right = "a(0,1) b(1,3) b|0,2", .sets = at_edge})
                .what.find("at node b, α1α3 is no involution any more"),
            std::string::npos);
  // The dual map: vertices and volumes of a closed surface exchanged.
  EXPECT_EQ(refusal({.left = "a*(0,1,2) a|3",
                     .right = "a(2,1,0) a|3",
                     .sets = {{.node = "a", .position = "mean(a, face)"}}})
                .what,
            "");
}

TEST(RuleCheck, a_link_that_the_rule_leaves_alone_needs_no_square) {
  // α0 of an edge end is unchanged although the rule does not mention α2, α3.
  EXPECT_EQ(refusal({.left = "a*(0) a|1,3", .right = "a(0) b(0) a-1-b a|3 b|2,3"}).what, "");
  EXPECT_EQ(refusal({.left = "a* b a-0-b", .right = "a b a-0-b"}).what, "");
  EXPECT_EQ(refusal({.left = "a*(0)", .right = "a(0)"}).what, "");
}

TEST(RuleCheck, what_is_legal_though_it_looks_odd) {
  for (const RuleSettings& each : std::vector<RuleSettings>{
           {.left = "", .right = ""},                                // does nothing
           {.left = "a*(0,1,2,3)", .right = ""},                     // removes a component
           {.left = "a*(0,1,2,3)", .right = "a(0,1,2,3)"},           // keeps it
           {.left = "a*(0) b*(0) c*(0)", .right = "a(0) b(0) c(0)"}, // three hooks
           {.left = "a*(3,1)", .right = "a(3,1)"},                   // an unusual order
           {.left = "a*(0,2) b(_,_) a-3-b a|1 b|0,1,2",
           .right = "a(0,2) b(_,_) a-3-b a|1 b|0,1,2"}, // matches nothing
           {.left = "and_*", .right = "and_"},
       })
    EXPECT_EQ(refusal(each).what, "") << each.left;
}

} // namespace
} // namespace rend::rule_check_test
