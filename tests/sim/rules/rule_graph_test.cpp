#include "sim/rules/rule_graph.h"

#include "sim/base/check.h"
#include "sim/base/error.h"
#include "sim/house_rules/house_rules.h"
#include "tests/sim/rules/rule_text.h"

#include <gtest/gtest.h>

namespace rend::rule_graph_test {
namespace {

using Kind = RuleLink::Kind;

void expect_equal(const RuleGraph& a, const RuleGraph& b) {
  ASSERT_EQ(a.size(), b.size());
  for (int n = 0; n < a.size(); ++n) {
    EXPECT_EQ(a[n].name, b[n].name);
    EXPECT_EQ(a[n].label, b[n].label);
    EXPECT_EQ(a[n].hook, b[n].hook);
    EXPECT_EQ(a[n].links, b[n].links);
  }
}

TEST(RuleGraph, reads_nodes_labels_arcs_and_free_links) {
  const RuleGraph graph = RuleGraph::parse(RuleSide::Left, "a*(0,_,3) b(_,1,_) a-2-b  a|1 b|3,0");
  ASSERT_EQ(graph.size(), 2);
  EXPECT_TRUE(graph[0].hook);
  EXPECT_FALSE(graph[1].hook);
  EXPECT_EQ(graph[0].label, (std::vector<int>{0, RuleNode::dropped, 3}));
  EXPECT_EQ(graph[1].label, (std::vector<int>{RuleNode::dropped, 1, RuleNode::dropped}));
  EXPECT_EQ(graph.link(0, 0), (RuleLink{Kind::Implicit, 0}));
  EXPECT_EQ(graph.link(0, 1), (RuleLink{Kind::Loop, 0}));
  EXPECT_EQ(graph.link(0, 2), (RuleLink{Kind::Arc, 1}));
  EXPECT_EQ(graph.link(0, 3), (RuleLink{Kind::Implicit, 2}));
  EXPECT_EQ(graph.link(1, 0), (RuleLink{Kind::Loop, 1}));
  EXPECT_EQ(graph.link(1, 1), (RuleLink{Kind::Implicit, 1}));
  EXPECT_EQ(graph.link(1, 2), (RuleLink{Kind::Arc, 0}));
  EXPECT_EQ(graph.link(1, 3), (RuleLink{Kind::Loop, 1}));
  EXPECT_EQ(graph[1].column, 11u);
  EXPECT_EQ(graph.find("b"), 1);
  EXPECT_EQ(graph.find("c"), -1);
}

TEST(RuleGraph, order_and_blanks_do_not_matter) {
  const RuleGraph one = RuleGraph::parse(RuleSide::Right, "first(0) b_2() c a-3-c b_2-1-c a"),
                  other = RuleGraph::parse(RuleSide::Right, "\n b_2-1-c\tfirst( 0 )  b_2 c\r\n a c-3-a ");
  EXPECT_NO_FATAL_FAILURE(expect_equal(one, other));
  EXPECT_EQ(RuleGraph::parse(RuleSide::Left, "").size(), 0);
  EXPECT_EQ(RuleGraph::parse(RuleSide::Left, " \n").size(), 0);
}

TEST(RuleGraph, is_reached_by_arcs_of_the_allowed_links_alone) {
  const RuleGraph graph = RuleGraph::parse(RuleSide::Right, "a(1) b(1) c d a-0-b b-2-c c-3-d d|2");
  EXPECT_EQ(graph.reach(1, Vertex), (std::vector<bool>{false, true, true, true}));
  EXPECT_EQ(graph.reach(1, Orbit{0}), (std::vector<bool>{true, true, false, false}));
  EXPECT_EQ(graph.reach(3, Orbit{}), (std::vector<bool>{false, false, false, true}));
}

TEST(RuleGraph, of_every_house_rule_is_printed_and_read_back_equal) {
  for (const Rule& each : house_rules()) {
    SCOPED_TRACE(each.name());
    EXPECT_NO_FATAL_FAILURE(expect_equal(each.left, RuleGraph::parse(RuleSide::Left, each.left.print())));
    EXPECT_NO_FATAL_FAILURE(expect_equal(each.right, RuleGraph::parse(RuleSide::Right, each.right.print())));
  }
}

void expect_equal(const Rule& a, const Rule& b) {
  EXPECT_EQ(a.print(), b.print());
  EXPECT_EQ(a.name(), b.name());
  EXPECT_EQ(a.settings.about, b.settings.about);
  EXPECT_EQ(a.settings.may_fold, b.settings.may_fold);
  expect_equal(a.left, b.left);
  expect_equal(a.right, b.right);
  EXPECT_EQ(a.before, b.before);
  EXPECT_EQ(a.vertex_set, b.vertex_set);
  ASSERT_EQ(a.sets.size(), b.sets.size());
  for (std::size_t n = 0; n < a.sets.size(); ++n) {
    EXPECT_EQ(a.sets[n].node, b.sets[n].node);
    EXPECT_EQ(a.sets[n].position.has_value(), b.sets[n].position.has_value());
    EXPECT_EQ(a.sets[n].rest.has_value(), b.sets[n].rest.has_value());
    EXPECT_EQ(a.sets[n].velocity.has_value(), b.sets[n].velocity.has_value());
  }
  ASSERT_EQ(a.wheres.size(), b.wheres.size());
  for (std::size_t n = 0; n < a.wheres.size(); ++n) {
    EXPECT_EQ(a.wheres[n].name, b.wheres[n].name);
    EXPECT_EQ(a.wheres[n].type, b.wheres[n].type);
    EXPECT_EQ(a.wheres[n].value.number, b.wheres[n].value.number);
  }
  ASSERT_EQ(a.whens.size(), b.whens.size());
  for (std::size_t n = 0; n < a.whens.size(); ++n) {
    EXPECT_EQ(a.whens[n].at, b.whens[n].at);
    EXPECT_EQ(a.whens[n].otherwise, b.whens[n].otherwise);
  }
}

TEST(RulePrint, every_house_rule_is_printed_and_read_back_equal) {
  for (const Rule& each : house_rules()) {
    SCOPED_TRACE(each.print());
    EXPECT_NO_FATAL_FAILURE(expect_equal(each, Rule(rule_text::read(each.print()))));
  }
}

TEST(RulePrint, keeps_conditions_values_and_characters_that_markup_reserves) {
  RuleSettings settings = star_face();
  settings.about = "a \"b\" <c> & d's";
  settings.sets[0] = {.node = "c",
                      .position = "lerp(mean(a, face), mean(a, volume), 0.25)",
                      .rest = "mean(a,face)*(1-0.5)^2",
                      .velocity = "point(0, 0, h)"};
  settings.wheres = {{.name = "h", .value = "2 / 3"}, {.name = "v", .value = "point(0, 1, 2) / 3"}};
  settings.whens = {{.test = "size(a, face) > 3 and not (h < 0)", .otherwise = "too \"small\" & <few>"},
                    {.test = "1 < 2", .at = RuleWhenSettings::At::All},
                    {.test = "dot(v, v) >= 0", .at = RuleWhenSettings::At::Any}};
  const Rule made(settings);
  EXPECT_NO_FATAL_FAILURE(expect_equal(made, Rule(rule_text::read(made.print()))));
}

struct Bad {
  const char* text;
  std::size_t column;
  const char* words; // of the message
};

TEST(RuleGraph, says_where_the_notation_is_broken) {
  const Bad cases[] = {
      {"a*(0,1) 5", 9, "'5' begins no node's name"},
      {"_a", 1, "'_' begins no node's name"},
      {"a(0) (1)", 6, "'(' begins no node's name"},
      {"a-", 3, "a link is 0, 1, 2 or 3"},
      {"a-4-b", 3, "a link is 0, 1, 2 or 3"},
      {"a-b", 3, "a link is 0, 1, 2 or 3"},
      {"a b a-0b", 8, "the arc from a lacks its second '-'"},
      {"a b a-0", 8, "the arc from a lacks its second '-'"},
      {"a b a-0-", 9, "a node's name is missing at the end"},
      {"a b a-0-?", 9, "'?' begins no node's name"},
      {"a a|", 5, "a link is 0, 1, 2 or 3"},
      {"a a|4", 5, "a link is 0, 1, 2 or 3"},
      {"a a|1,", 7, "a link is 0, 1, 2 or 3"},
      {"a a|1;2", 6, "';' does not belong here"},
      {"a**", 3, "'*' does not belong here"},
      {"a(0", 4, "the label of a is not closed"},
      {"a(0 1)", 5, "the label of a is not closed"},
      {"a(", 3, "a link is 0, 1, 2 or 3"},
      {"a(0,)", 5, "a link is 0, 1, 2 or 3"},
      {"a(7)", 3, "a link is 0, 1, 2 or 3"},
      {"a(0)b", 5, "'b' does not belong here"},
      {"a(0)(1)", 5, "'(' does not belong here"},
      {"a(0,1,2,3,_)", 11, "more than four links"},
      {"a(_,_,_,_,_)", 11, "more than four links"},
      {"a(0,1,0)", 7, "node a says twice what its α0 is"},
      {"a(0) b a", 8, "two nodes are called a"},
      {"a b a-0-b a-0-b", 11, "node a says twice what its α0 is"},
      {"a b c a-0-b c-0-b", 17, "node b says twice what its α0 is"},
      {"a(2) a|2", 6, "node a says twice what its α2 is"},
      {"a a|1,1", 3, "node a says twice what its α1 is"},
      {"a a-2-a", 3, "an arc joins node a to itself by α2"},
      {"a a-2-b", 7, "has no node 'b'"},
      {"a b-2-a", 3, "has no node 'b'"},
      {"a b|3", 3, "has no node 'b'"},
      {"a\vb", 2, "does not belong here"},
      {"\xce\xb1", 1, "begins no node's name"},
  };
  for (const Bad& bad : cases) {
    SCOPED_TRACE(bad.text);
    try {
      RuleGraph::parse(RuleSide::Right, bad.text);
      ADD_FAILURE() << "it is read";
    } catch (const RuleFault& fault) {
      EXPECT_EQ(fault.side, RuleSide::Right);
      EXPECT_EQ(fault.column, bad.column);
      EXPECT_NE(std::string(fault.what()).find(bad.words), std::string::npos) << fault.what();
    }
  }
}

TEST(RuleGraph, suggests_the_name_that_was_meant) {
  try {
    RuleGraph::parse(RuleSide::Left, "corner*(0,1) corners(0,1) corner-2-cornres");
    ADD_FAILURE();
  } catch (const RuleFault& fault) {
    EXPECT_EQ(std::string(fault.what()), "the left graph has no node 'cornres'");
    EXPECT_NE(fault.hint.find("corner"), std::string::npos) << fault.hint;
  }
}

TEST(RuleGraph, bounds_its_text_its_nodes_and_their_names) {
  const auto refused = [](const std::string& text) {
    try {
      RuleGraph::parse(RuleSide::Left, text);
    } catch (const RuleFault& fault) {
      return std::string(fault.what()).substr(0, 200);
    }
    return std::string();
  };
  std::string many;
  for (std::size_t n = 0; n < RuleGraph::most_nodes; ++n) many += "n" + std::to_string(n) + " ";
  EXPECT_EQ(refused(many), "");
  EXPECT_EQ(refused(many + "more"), "there are more than 1000 nodes");
  EXPECT_EQ(refused(std::string(RuleGraph::longest, ' ')), "");
  EXPECT_EQ(refused(std::string(RuleGraph::longest + 1, ' ')), "the text is longer than 32768 characters");
  EXPECT_EQ(refused(std::string(50, 'a')), "");
  EXPECT_EQ(refused(std::string(51, 'a')), "the name of a node is longer than 50 characters");
}

} // namespace
} // namespace rend::rule_graph_test
