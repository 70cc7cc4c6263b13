// Scripts that are refused before anything runs, and why: a UserError with code 65 and the place of one
// attribute.
#include "sim/build/rule_book.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

namespace rend::script_check_test {
namespace {

struct IllegalScript {
  const char* text;  // of a file of rules; what is blamed stands first on line 2
  const char* words; // of the message
};

TEST(ScriptCheck, refuses_with_place_and_reason) {
  const IllegalScript all[] = {
      // hooks
      {"<script name='s' hook=\n'a(0,1)'><for each='e*(0)' apply='unsew-edge'/></script>",
       "'a(0,1)' is not one node with a star and its orbit"},
      {"<script name='s' hook=\n'a*(0,_)'><for each='e*(0)' apply='unsew-edge'/></script>",
       "is not one node with a star and its orbit"},
      {"<script name='s' hook=\n'a*(0) b*(0)'><for each='e*(0)' apply='unsew-edge'/></script>",
       "is not one node with a star and its orbit"},
      {"<script name='s' hook=\n'a*(0,1) a|3'><for each='e*(0)' apply='unsew-edge'/></script>",
       "is not one node with a star and its orbit"},
      {"<script name='s' hook=\n'a*(0,4)'><for each='e*(0)' apply='unsew-edge'/></script>",
       "a link is 0, 1, 2 or 3 (character 6)"},
      {"<script name='s' hook=\n'a*(0,0)'><for each='e*(0)' apply='unsew-edge'/></script>",
       "node a says twice what its α0 is"},
      {"<script name='s' hook=\n'mean*(0,1)'><for each='e*(0)' apply='unsew-edge'/></script>",
       "mean is a function of expressions"},
      // cells
      {"<script name='s' hook='a*(0,1)'><for each=\n'face' apply='star-face'/></script>",
       "'face' is not one node with a star and its orbit"},
      {"<script name='s' hook='a*(0,1)'><for each=\n'' apply='star-face'/></script>", ""},
      {"<script name='s' hook='a*(0,1)'><for each=\n'a*(0)' apply='unsew-edge'/></script>",
       "a is the name of the hook already"},
      {"<script name='s' hook='a*(0,1)'><for each=\n'length*(0)' apply='unsew-edge'/></script>",
       "length is a function of expressions"},
      {"<script name='s' hook='a*(0,1)'><for apply=\n'unsew-edge'/></script>",
       "rule 'unsew-edge' has a hook, and the step has no cells for it"},
      {"<script name='s' hook='a*(0,1)'><for each=\n'e*(0)' apply='create-vertex'/></script>",
       "rule 'create-vertex' creates out of nothing"},
      // what is applied
      {"<script name='s' hook='a*(0,1)'><for each='e*(0)' apply=\n'unsew-egde'/></script>",
       "there is no rule 'unsew-egde'"},
      {"<script name='s' hook='a*(0,1)'><for each='e*(0,2)' apply=\n'star-face'/></script>",
       "the hook of rule 'star-face' stands for <0,1>, which is no part of a cell <0,2>"},
      {"<script name='s' hook='a*(0,1)'><for each='e*(0)' apply=\n'delete-face'/></script>",
       "the hook of script 'delete-face' stands for <0,1>"},
      {"<rule name='three' left='a* b* c*' right='a b c'/><script name='s' hook='a*(0,1)'><for each='e*(0)' "
       "apply="
       "\n'three'/></script>",
       "rule 'three' has 3 hooks"},
      {"<script name='s' hook='a*(0,1)'><for each='e*(0,1)' apply=\n's'/></script>",
       "it would go on for ever: 's' applies 's'"},
      {"<script name='s' hook='a*(0,1)'><for each='e*(0,1)' apply='t'/></script>"
       "<script name='t' hook='a*(0,1)'><for each='e*(0,1)' apply='u'/></script>"
       "<script name='u' hook='a*(0,1)'><for each='e*(0,1)' apply=\n's'/></script>",
       "script 'u': it would go on for ever: 's' applies 't' applies 'u' applies 's'"},
      // expressions
      {"<script name='s' hook='a*(0,1)'><for each='e*(0)' where=\n'length(f) > 1' "
       "apply='unsew-edge'/></script>",
       "the left graph has no node 'f'"},
      {"<script name='s' hook='a*(0,1)'><for each='e*(0)' where=\n'length(e)' apply='unsew-edge'/></script>",
       "script 's': "},
      {"<script name='s' hook='a*(0,1)'><for each='e*(0)' where=\n'length(e) > ' apply='unsew-edge'/></script>",
       "script 's': "},
      {"<script name='s' hook='a*(0,1)'><for each='e*(0)' where=\n'1/0 > 1' apply='unsew-edge'/></script>",
       "script 's': "},
      {"<script name='s' hook='a*(0,1)'><when test=\n'size(e, face) > 3'/><for each='e*(0)' "
       "apply='unsew-edge'/></script>",
       "the left graph has no node 'e'"},
      {"<script name='s'><when test=\n'time > 3'/><for apply='create-vertex'/></script>",
       "a rule without a left graph has nothing to test"},
      // arguments
      {"<script name='s' hook='a*(0,1)'><for each='e*(0)' apply='unsew-edge' v=\n'1'/></script>",
       "rule 'unsew-edge' has no argument 'v'"},
      {"<script name='s' hook='a*(0,1)'><for each='e*(1,2,3)' apply='move' v=\n'1'/></script>",
       "(character 1 of '1')"},
      {"<script name='s' hook='a*(0,1)'><for each='e*(1,2,3)' apply='move' v=\n'w'/></script>", "'w'"},
      {"<script name='s' hook='a*(0,1)'><where name=\n'a' value='1'/><for each='e*(0)' "
       "apply='unsew-edge'/></script>",
       "'a' is a node's name already"},
      {"<script name='s' hook='a*(0,1)'><where name='e' value='1'/><for each=\n'e*(0)' "
       "apply='unsew-edge'/></script>",
       "'e' is a node's name already"},
      {"<script name='s' hook='a*(0,1)'><where name='t' value=\n'a'/><for each='e*(0)' "
       "apply='unsew-edge'/></script>",
       "'a'"},
      // words, names and numbers of elements
      {"<script name='s' hook='a*(0,1)'><for each='e*(0)' apply='unsew-edge' at-least=\n'two'/></script>",
       "at-least"},
      {"<script name='s' hook='a*(0,1)'><for each='e*(0)' apply='unsew-edge' which=\n'older'/></script>",
       "which"},
      {"<script name=\n'delete-face' hook='a*(0,1)'><for each='e*(0)' apply='unsew-edge'/></script>",
       "'delete-face' is the name of a built-in rule"},
      {"<rule name='s' left='a*' right='a'/><script name=\n's' hook='a*(0,1)'><for each='e*(0)' "
       "apply='unsew-edge'/>"
       "</script>",
       "two rules are called 's'"},
      {"<rule name='r' left='a*' right='b'/><script name='s' hook='a*(0)'><for each='e*(0)' "
       "apply='r'/></script>",
       "node a is removed"},
  };
  int count = 0;
  for (const IllegalScript& each : all) {
    SCOPED_TRACE(each.text);
    const std::string blamed_on_2 = std::string(each.text).find('\n') != std::string::npos ? ":2:" : ":1:";
    try {
      read_rules_text(fmt::format("<rules>{}</rules>", each.text), "test.xml");
      ADD_FAILURE() << "it was accepted";
    } catch (const UserError& error) {
      const std::string what = error.what();
      EXPECT_EQ(error.code, Exit::BadInput);
      EXPECT_EQ(what.find("test.xml" + blamed_on_2), 0u) << what;
      EXPECT_NE(what.find(each.words), std::string::npos) << what;
    }
    ++count;
  }
  EXPECT_GE(count, 20);
}

// Scripts s0, s1 ... each of which applies the one before `times` times; in that order or the reverse.
std::string chain(int count, int times, bool reversed) {
  std::string text;
  for (int n = 0; n < count; ++n) {
    std::string one = fmt::format("<script name='s{}' hook='a*(0)'>", n);
    for (int t = 0; t < times; ++t)
      one += fmt::format("<for each='e*(0)' apply='{}'/>", n == 0 ? "unsew-edge" : fmt::format("s{}", n - 1));
    one += "</script>";
    text = reversed ? one + text : text + one;
  }
  return "<rules>" + text + "</rules>";
}

std::string refusal_of(const std::string& text) {
  try {
    read_rules_text(text, "test.xml");
  } catch (const UserError& error) {
    return error.what();
  }
  return "none";
}

TEST(ScriptCheck, bounds_how_deep_scripts_apply_each_other) {
  for (const bool reversed : {false, true}) {
    EXPECT_EQ(refusal_of(chain(Script::deepest, 1, reversed)), "none");
    EXPECT_NE(refusal_of(chain(Script::deepest + 1, 1, reversed)).find("more than 20 deep"), std::string::npos);
    EXPECT_NE(refusal_of(chain(2000, 1, reversed)).find("more than 20 deep"), std::string::npos);
  }
}

TEST(ScriptCheck, bounds_how_many_scripts_apply_each_other) {
  EXPECT_EQ(refusal_of(chain(8, 3, true)), "none");
  EXPECT_NE(refusal_of(chain(18, 3, true)).find("more than 10000 scripts"), std::string::npos);
}

// What stands later may be applied, and what applies something refused is refused, too.
TEST(ScriptCheck, tells_all_that_is_refused) {
  RuleFaults faults;
  const RuleBook book = read_rules_text(R"xml(<rules>
      <script name="first" hook="a*(0)"><for each="e*(0)" apply="later"/></script>
      <rule name="bad" left="a*(0,1)" right="b"/>
      <script name="on-bad" hook="a*(0)"><for each="e*(0)" apply="bad"/></script>
      <rule name="good" left="a*(0)" right="a(0)"/>
      <script name="lost" hook="a*(0)"><for each="e*(0)" apply="nowhere"/></script>
      <script name="later" hook="a*(0)"><for each="e*(0)" apply="good"/></script>
      <script name="round" hook="a*(0)"><for each="e*(0)" apply="about"/></script>
      <script name="about" hook="a*(0)"><for each="e*(0)" apply="round"/></script></rules>)xml",
                                        "test.xml", &faults);
  std::vector<std::string> names;
  for (const RuleOrScript& each : book) names.push_back(each.name());
  EXPECT_EQ(names, (std::vector<std::string>{"first", "good", "later"}));
  std::string all;
  for (const UserError& fault : faults) all += std::string(fault.what()) + "\n";
  for (const char* words : {"rule 'bad'", "script 'on-bad': it applies 'bad', which is refused",
                            "there is no rule 'nowhere'", "'round' applies 'about' applies 'round'"})
    EXPECT_NE(all.find(words), std::string::npos) << all;
}

TEST(ScriptCheck, a_file_may_be_one_rule_or_one_script) {
  EXPECT_EQ(read_rules_text("<!-- --><rule name='r' left='a*(0)' right='a(0)'/>", "test.xml").size(), 1u);
  EXPECT_EQ(read_rules_text("<script name='s' hook='a*(0)'><for each='e*(0)' apply='unsew-edge'/></script>",
                            "test.xml")
                .front()
                .script->name(),
            "s");
}

} // namespace
} // namespace rend::script_check_test
