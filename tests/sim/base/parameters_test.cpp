#include "sim/base/parameters.h"

#include "sim/base/check.h"

#include <clocale>
#include <gtest/gtest.h>

namespace rend::parameters_test {
namespace {

const ElementType leaf{"leaf", "A leaf.", {number("area", "m2", "its area").above(0).is_required()}, {}};
const ElementType bud{"bud", "A bud.", {integer("petals", "how many").otherwise("5")}, {}};
const ElementType twig{
    "twig",
    "A twig, to try every kind of value on.",
    {number("length", "m", "its length").at_least(0).at_most(10), numbers("tip", 3, "m", "where it ends"),
     numbers("knots", 0, "m", "where it is thick").at_least(0), integer("count", "how many").at_least(1),
     integers("cells", 2, "how many each way").at_least(1),
     word("kind", {"hazel", "birch", "willow"}, "of which tree").otherwise("birch"),
     words_of("show", {"none", "bark", "sap"}, "what to show"), flag("dead", "whether it is dead"),
     text("name", "what it is called"),
     number_or("step", {"auto"}, "s", "how it grows").above(0).otherwise("auto")},
    {{&leaf, 1, 2}, {&bud, 0, -1}}};

const Place somewhere{"tree.xml", 3, 14};

PresetNode with(std::string_view attribute, const std::string& value) {
  PresetNode node(twig, {"tree.xml", 3, 1});
  node.set(*twig.find(attribute), value, somewhere);
  return node;
}

// Runs `act`, which must throw a UserError (BadInput) at `place`; returns its message and hint.
template <class Act> std::string refusal(Act act, const std::string& place = "tree.xml:3:14") {
  try {
    act();
  } catch (const UserError& error) {
    EXPECT_EQ(error.code, Exit::BadInput);
    const std::string what = error.what();
    EXPECT_EQ(what.substr(0, place.size() + 2), place + ": ");
    return what.substr(std::min(what.size(), place.size() + 2)) +
           (error.hint.empty() ? "" : " | " + error.hint);
  }
  ADD_FAILURE() << "it was not refused";
  return {};
}

std::string refused(std::string_view attribute, const std::string& value) {
  return refusal([&] { with(attribute, value); });
}

TEST(Parameters, ReadsANumber) {
  EXPECT_EQ(with("length", "1.5").number("length"), 1.5);
  EXPECT_EQ(with("length", "+.5").number("length"), 0.5);
  EXPECT_EQ(with("length", "1e-3").number("length"), 1e-3);
  EXPECT_EQ(with("length", " 2. \n").number("length"), 2);
  EXPECT_EQ(with("length", "0").number("length"), 0);
  EXPECT_EQ(with("length", "10").number("length"), 10);
}

TEST(Parameters, RefusesWhatIsNotWhollyANumber) {
  EXPECT_EQ(refused("length", "12abc"),
            "length of <twig> is '12abc', which is not a number; expected a number from 0 to 10 [m]");
  for (const std::string text :
       {"0x10", "1e", "--1", "+-1", "++1", "+", "-", ".", "e5", "1 2", "one", "1_0", "1f"})
    EXPECT_NE(refused("length", text).find("not a number"), std::string::npos) << text;
  EXPECT_NE(refused("length", "").find("which is empty"), std::string::npos);
  EXPECT_NE(refused("length", " \t ").find("which is empty"), std::string::npos);
}

TEST(Parameters, RefusesNumbersThatAreNotFinite) {
  for (const std::string text : {"nan", "-nan", "inf", "-inf", "+inf", "infinity", "NaN", "nan(1)"})
    EXPECT_NE(refused("length", text).find("expected a number"), std::string::npos) << text;
  EXPECT_NE(refused("length", "1e999").find("too large or too small"), std::string::npos);
  EXPECT_NE(refused("length", "-1e999").find("too large or too small"), std::string::npos);
  EXPECT_NE(refused("length", "1e-400").find("too large or too small"), std::string::npos);
}

TEST(Parameters, HintsAtTheDecimalPoint) {
  EXPECT_NE(refused("length", "0,5").find("| the decimal point is '.'"), std::string::npos);
}

TEST(Parameters, ReadsNumbersInAnyLocale) {
  // may not be installed: then this is not tested
  const char* german = std::setlocale(LC_NUMERIC, "de_DE.UTF-8");
  EXPECT_EQ(with("length", "1.5").number("length"), 1.5);
  if (german) std::setlocale(LC_NUMERIC, "C");
}

TEST(Parameters, RefusesNumbersOutOfBounds) {
  EXPECT_EQ(refused("length", "-1"),
            "length of <twig> is '-1', which is below 0; expected a number from 0 to 10 [m]");
  EXPECT_EQ(refused("length", "10.5"),
            "length of <twig> is '10.5', which is above 10; expected a number from 0 to 10 [m]");
  EXPECT_EQ(refused("step", "0"),
            "step of <twig> is '0', which is not above 0; expected auto, or a number above 0 [s]");
  EXPECT_EQ(refused("knots", "1 -2 3"),
            "knots of <twig> is '1 -2 3', where '-2' is below 0; expected one or more "
            "numbers, each of at least 0 [m]");
}

TEST(Parameters, ReadsListsOfNumbers) {
  EXPECT_EQ(with("tip", "1 -2\t3e1").vector("tip"), Eigen::Vector3d(1, -2, 30));
  EXPECT_EQ(with("knots", "1 2 3 4").numbers("knots"), (std::vector<double>{1, 2, 3, 4}));
  EXPECT_EQ(with("knots", "1").numbers("knots"), std::vector<double>{1});
}

TEST(Parameters, SaysHowManyNumbersThereAre) {
  EXPECT_EQ(refused("tip", "1 2"), "tip of <twig> is '1 2', which has 2 numbers; expected 3 numbers [m]");
  EXPECT_EQ(refused("tip", "1"), "tip of <twig> is '1', which has 1 number; expected 3 numbers [m]");
  EXPECT_EQ(refused("cells", "1 2 3"),
            "cells of <twig> is '1 2 3', which has 3 numbers; expected 2 whole numbers, each of at least 1");
  EXPECT_EQ(refused("tip", "1 x 3"),
            "tip of <twig> is '1 x 3', where 'x' is not a number; expected 3 numbers [m]");
  EXPECT_NE(refused("tip", "0,0,1").find("separated by spaces"), std::string::npos);
}

TEST(Parameters, ReadsWholeNumbers) {
  EXPECT_EQ(with("count", "2147483647").integer("count"), 2147483647);
  EXPECT_EQ(with("cells", "3 +4").integers("cells"), (std::vector<double>{3, 4}));
}

TEST(Parameters, RefusesWhatIsNotAWholeNumber) {
  EXPECT_EQ(refused("count", "2.0"),
            "count of <twig> is '2.0', which is not a whole number; expected a whole number of at least 1");
  EXPECT_NE(refused("count", "1e3").find("not a whole number"), std::string::npos);
  EXPECT_NE(refused("count", "2147483648").find("beyond the range"), std::string::npos);
  EXPECT_NE(refused("count", "99999999999999999999").find("beyond the range"), std::string::npos);
  EXPECT_NE(refused("count", "0").find("which is below 1"), std::string::npos);
  EXPECT_NE(refused("cells", "2 0").find("where '0' is below 1"), std::string::npos);
}

TEST(Parameters, ReadsWords) {
  EXPECT_EQ(with("kind", " hazel ").text("kind"), "hazel");
  EXPECT_EQ(with("show", "sap  bark").words("show"), (std::vector<std::string>{"sap", "bark"}));
  EXPECT_TRUE(with("dead", "yes").flag("dead"));
  EXPECT_FALSE(with("dead", "no").flag("dead"));
  EXPECT_EQ(with("name", " any <text> ").text("name"), " any <text> ");
}

TEST(Parameters, RefusesWordsThatAreUnknown) {
  EXPECT_EQ(refused("kind", "brich"),
            "kind of <twig> is 'brich', which is not known here; expected one of hazel, "
            "birch, willow | did you mean 'birch'?");
  EXPECT_EQ(refused("show", "sap bork"),
            "show of <twig> is 'sap bork', where 'bork' is not known here; expected any "
            "of none, bark, sap, separated by spaces | did you mean 'bark'?");
  EXPECT_EQ(refused("dead", "true"),
            "dead of <twig> is 'true', which is neither yes nor no; expected yes or no");
  EXPECT_NE(refused("show", "").find("which is empty"), std::string::npos);
  EXPECT_NE(refused("kind", "hazel birch").find("not known"), std::string::npos);
}

TEST(Parameters, TakesANumberOrAWord) {
  EXPECT_TRUE(with("step", "auto").is_word("step"));
  EXPECT_EQ(with("step", "auto").text("step"), "auto");
  EXPECT_FALSE(with("step", "1e-3").is_word("step"));
  EXPECT_EQ(with("step", "1e-3").number("step"), 1e-3);
  EXPECT_NE(refused("step", "auot").find("did you mean 'auto'?"), std::string::npos);
  EXPECT_NE(refused("step", "1x").find("not a number"), std::string::npos);
}

TEST(Parameters, DefaultsFillWhatThePresetLeavesOut) {
  PresetNode node(twig, somewhere);
  node.set(*twig.find("step"), "2", somewhere);
  PresetNode& child = node.add(std::make_unique<PresetNode>(bud, somewhere));
  node.fill_defaults();
  EXPECT_EQ(node.text("kind"), "birch");
  EXPECT_EQ(node.number("step"), 2);
  EXPECT_EQ(child.integer("petals"), 5);
  EXPECT_TRUE(node.has("kind"));
  EXPECT_FALSE(node.given("kind"));
  EXPECT_TRUE(node.given("step"));
  EXPECT_FALSE(node.has("length")); // has no default
}

TEST(Parameters, ADefaultThatDoesNotFitIsOurOwnSlip) {
  const ElementType wrong{"wrong", "", {number("k", "N/m", "stiffness").above(0).otherwise("0")}, {}};
  PresetNode node(wrong, somewhere);
  EXPECT_THROW(node.fill_defaults(), InternalError);
}

TEST(Parameters, APlaceIsThatOfTheValueOrElseOfTheElement) {
  PresetNode node = with("step", "1");
  node.fill_defaults();
  EXPECT_EQ(node.place("step").text(), "tree.xml:3:14");
  EXPECT_EQ(node.place("kind").text(), "tree.xml:3:1"); // a default
  EXPECT_EQ(node.place("length").text(), "tree.xml:3:1");
  EXPECT_EQ(refusal([&] { node.fail("step", "too long for this twig", "use 0.1"); }),
            "too long for this twig | use 0.1");
}

TEST(Parameters, RefusesANodeWithoutWhatItNeeds) {
  PresetNode node(twig, somewhere);
  EXPECT_EQ(refusal([&] { node.check_complete(); }),
            "<twig> needs a <leaf> and has none | add <leaf>: A leaf.");
  PresetNode& first = node.add(std::make_unique<PresetNode>(leaf, Place{"tree.xml", 4, 5}));
  EXPECT_EQ(refusal([&] { node.check_complete(); }, "tree.xml:4:5"),
            "<leaf> needs area | area: its area; expected a number above 0 [m2]");
  first.set(leaf.attributes[0], "1", somewhere);
  EXPECT_NO_THROW(node.check_complete());
}

TEST(Parameters, RefusesMoreChildrenThanMayStand) {
  PresetNode node(twig, somewhere);
  for (int line = 4; line < 7; ++line) {
    node.add(std::make_unique<PresetNode>(leaf, Place{"tree.xml", line, 5}))
        .set(leaf.attributes[0], "1", somewhere);
    node.add(std::make_unique<PresetNode>(bud, Place{"tree.xml", line, 9}));
  }
  EXPECT_EQ(refusal([&] { node.check_complete(); }, "tree.xml:6:5"),
            "<twig> may hold only 2 <leaf> | the first is at tree.xml:4:5");
}

TEST(Parameters, ChildrenAreFoundByTheirNames) {
  PresetNode node(twig, somewhere);
  node.add(std::make_unique<PresetNode>(bud, somewhere));
  const PresetNode& second = node.add(std::make_unique<PresetNode>(leaf, somewhere));
  node.add(std::make_unique<PresetNode>(bud, somewhere));
  EXPECT_EQ(node.child("leaf"), &second);
  EXPECT_EQ(node.child("root"), nullptr);
  EXPECT_EQ(node.all("bud").size(), 2U);
  EXPECT_EQ(node.children().size(), 3U);
}

TEST(Parameters, AskingForTheWrongKindIsOurOwnSlip) {
  const PresetNode node = with("step", "auto");
  EXPECT_THROW(node.number("step"), InternalError);   // the attribute is a keyword
  EXPECT_THROW(node.integer("step"), InternalError);  // the attribute is a real number
  EXPECT_THROW(node.number("length"), InternalError); // no value
  EXPECT_THROW(node.number("lenght"), InternalError); // not in the table
  EXPECT_THROW(node.has("lenght"), InternalError);
  EXPECT_THROW(with("knots", "1 2").vector("knots"), InternalError);
  PresetNode other(bud, somewhere);
  EXPECT_THROW(other.set(*twig.find("kind"), "hazel", somewhere), InternalError);
  EXPECT_THROW(other.add(std::make_unique<PresetNode>(leaf, somewhere)), InternalError);
}

TEST(Parameters, SaysWhatIsExpected) {
  EXPECT_EQ(expected(number("k", "N/m", "")), "a number [N/m]");
  EXPECT_EQ(expected(number("k", "", "").at_least(0)), "a number of at least 0");
  EXPECT_EQ(expected(number("k", "", "").above(0).at_most(0.5)), "a number above 0 and at most 0.5");
  EXPECT_EQ(expected(number("k", "", "").at_most(1e-9)), "a number of at most 1e-09");
  EXPECT_EQ(expected(numbers("k", 1, "m", "").above(0)), "1 number above 0 [m]");
  EXPECT_EQ(expected(word("v", {"1"}, "")), "1");
}

} // namespace
} // namespace rend::parameters_test
