#include "sim/topology/rule_check.h"

#include "sim/base/check.h"

#include <gtest/gtest.h>

namespace rend {
namespace {

using namespace grammar;

// tests/sim/rules/illegal shows that each fault is a compile error; here are the messages.
std::string fault_of(const Rule& rule) {
  try {
    rule_check::all(rule);
  } catch (const InternalError& error) {
    return error.what();
  }
  return {};
}

TEST(RuleCheck, says_in_words_what_a_rule_breaks) {
  const Rule unfolded{"unfolded", left{hook('a'), node('b'), arc('a', 2, 'b')},
                      right{node('a'), node('b'), loop('a', 2), loop('b', 2)}};
  EXPECT_EQ(fault_of(unfolded), "a rule is malformed: at node a α0α2 is no involution any more");
  const Rule dangling{"dangling", left{hook('a', {0, 1}), loop('a', 3)}, right{}};
  EXPECT_EQ(fault_of(dangling),
            "a rule is malformed: node a is removed, but what its α2 leads to is not matched");
}

TEST(RuleCheck, two_implicit_links_are_judged_by_the_hooks_names) {
  // α0 and α3 of the hook commute; renamed to α1 and α3 on a copy they still do.
  const Rule fine{"copy", left{hook('a', {0, 3})},
                  right{node('a', {0, 3}), node('b', {1, 3}), loop('b', 0, 2), point('b', copy('a'))}};
  EXPECT_EQ(fault_of(fine), "");
  const Rule wrong{"copy", left{hook('a', {0, 1})},
                   right{node('a', {0, 1}), node('b', {1, 3}), loop('b', 0, 2), point('b', copy('a'))}};
  EXPECT_EQ(fault_of(wrong), "a rule is malformed: at node b α1α3 is no involution any more");
}

TEST(RuleCheck, a_link_that_the_rule_leaves_alone_needs_no_square) {
  // α0 of an edge end is unchanged although the rule does not mention α2, α3.
  const Rule fine{"fine", left{hook('a', {0}), loop('a', 1, 3)},
                  right{node('a', {0}), node('b', {0}), arc('a', 1, 'b'), loop('a', 3), loop('b', 2, 3)}};
  EXPECT_EQ(fault_of(fine), "");
}

} // namespace
} // namespace rend
